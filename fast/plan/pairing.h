// SPDX-License-Identifier: MIT
// A place on a control face; grids of points over two neighbouring faces; and the partition of the faces into
// such pairs. [mueller2000, 4.2; C35-C42]
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fast/mesh/adjacency.h"

namespace limitcheck::fast {

/// Where a vertex lies on `face`: l1 = i / denominator, l2 = j / denominator, or (u, v) likewise on a quad.
/// Lattice points of depth d have denominator 2^d, the centre of a triangle's fan i = j = 1 and denominator
/// 3. A face of Catmull-Clark's scheme that is no quad has a quad at each `corner`, with a (u, v) of its own
/// whose denominator is 2^(d-1), at least 1.
struct LatticePoint {
  std::int32_t face = -1;
  std::uint32_t i = 0, j = 0;
  std::uint32_t denominator = 1;
  std::int32_t corner = 0;
  friend constexpr bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

/// (2^depth + 1)^2 points with corners A B C D over two neighbouring faces, which share the diagonal A C; or
/// a face alone (a singleton), which has the upper left half of the points.
///
///        D ------- C             face0 = A C D: half-edge 3 face0 + edge0 runs from A to C
///        | face0 / |             face1 = C A B: half-edge 3 face1 + edge1, its twin, runs from C to A
///        |     /   |
///        |   / face1
///        | /       |
///        A ------- B
/// Singleton: face1 = -1. Its dummy partner, read only and never displayed, is the face across edge0, namely
/// twin(3 face0 + edge0) / 3; edge0 = edge1 = -1 if it has no neighbour at all.
struct Grid {
  std::int32_t face0 = -1;
  std::int32_t face1 = -1;
  std::int32_t edge0 = -1;
  std::int32_t edge1 = -1;
  int depth = 0;

  bool singleton() const { return face1 < 0; }
  friend bool operator==(const Grid&, const Grid&) = default;
};

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
