// SPDX-License-Identifier: MIT
// Partition of the faces into pairs of neighbours, for the sliding window. [mueller2000, 4.2; C35-C42]
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fast/mesh/adjacency.h"

namespace limitcheck::fast {

/// Two neighbouring faces, or a singleton.
///
///         x                face1: edge1 is its corner index of the shared edge,
///       /   \                     twin(3 face0 + edge0) = 3 face1 + edge1
///      /  1  \             .
///     a ----- b            face0: edge0 likewise; corner edge0 is a, corner edge0 + 1 is b
///      \  0  /
///       \   /
///         y
/// Singleton: face1 = -1. Its dummy partner, read only and never displayed, is the face across edge0, namely
/// twin(3 face0 + edge0) / 3; edge0 = edge1 = -1 if it has no neighbour at all.
struct Pair {
  std::int32_t face0 = -1;
  std::int32_t face1 = -1;
  std::int32_t edge0 = -1;
  std::int32_t edge1 = -1;
  int depth = 0;

  bool singleton() const { return face1 < 0; }
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// Every face that is not culled is in exactly one of the pairs.
struct PairingResult {
  std::vector<Pair> pairs;          // pairs and singletons in the order they were found
  std::vector<std::int32_t> depth;  // per face, both members raised to the larger; -1 culled
  std::int64_t pair_count = 0;      // pairs of two
  std::int64_t singletons = 0;
  std::int64_t culled = 0;
};

/// How faces move between the priority sets.
enum class PairingRule {
  kCorrected,  // step 3 as in erratum 6: what falls to one free neighbour goes to S0, then S3 -> S2, then S2
               // -> S1
  kPrinted  // step 3 in the printed order: S3 -> S2 first, so that the next line carries the same faces on to
            // S0  [C39]
};

/// How partners are chosen.
struct PairingOptions {
  PairingRule rule = PairingRule::kCorrected;
  bool prefer_equal_depth = true;  // false: the neighbour of highest priority whatever its depth      [C42]
};

/// Greedy pairing with the priority sets S0 .. S3, each a queue in the order of arrival, filled by face id;
/// of equal partners the smaller face id. Deterministic, O(faces).
///   depth    one entry per face, -1 = culled: such a face takes no part, though it may serve as a dummy
///   order    S0 first; among S0 an equal depth first; then an equal depth, then the highest priority
///   throws   std::invalid_argument: not one depth per face, or one below -1
PairingResult pair_faces(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                         const PairingOptions& options = {});

}  // namespace limitcheck::fast
