// SPDX-License-Identifier: MIT
// What a kernel evaluates at a time: a square grid of points over two neighbouring faces.
#pragma once

#include <cstdint>

namespace limitcheck::fast {

/// (2^depth + 1)^2 points with corners A B C D over two neighbouring faces, which share the diagonal A C; or a
/// face alone (a singleton), which has the upper left half of the points.
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

}  // namespace limitcheck::fast
