// SPDX-License-Identifier: MIT
// Partition of the faces into pairs of neighbours, a grid each. [mueller2000, 4.2; C35-C42]
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fast/mesh/adjacency.h"
#include "fast/plan/grid.h"

namespace limitcheck::fast {

/// Every face that is not culled is in exactly one of the grids.
struct PairingResult {
  std::vector<Grid> grids;          // pairs and singletons in the order they were found
  std::vector<std::int32_t> depth;  // per face, both members raised to the larger; -1 culled
  std::int64_t pair_count = 0;      // pairs of two
  std::int64_t singletons = 0;
  std::int64_t culled = 0;
};

/// Greedy pairing with the priority sets S0 .. S3, each a queue in the order of arrival, filled by face id.
/// Deterministic, O(faces).
///   depth    one entry per face, -1 = culled: such a face takes no part, though it may serve as a dummy
///   order    a partner in S0 goes first, then one of equal depth, then one of higher priority, then the
///            smaller face id
///   throws   data::ArgumentError: not one depth per face, or one below -1
PairingResult pair_faces(const Adjacency& adjacency, std::span<const std::int32_t> depth);

}  // namespace limitcheck::fast
