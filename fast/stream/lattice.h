// SPDX-License-Identifier: MIT
// From a grid's lattice to its two faces' own parameters.
#pragma once

#include <array>
#include <cstdint>

#include "fast/plan/pairing.h"

namespace limitcheck::fast::row_stream {

/// A lattice point of a control face: l1 = i / 2^depth, l2 = j / 2^depth. face = -1: of a singleton's dummy.
struct FacePoint {
  std::int32_t face;
  int i, j;
};

/// Point (column, row) of a grid of 2^depth = size, on the
/// upper left member if row >= column, else the other.
///   face0   corners edge0 = A (0, 0), edge0 + 1 = C (size, size), edge0 + 2 = D (0, size)
///   face1   corners edge1 = C, edge1 + 1 = A, edge1 + 2 = B (size, 0)
inline FacePoint face_point(const Grid& grid, int size, int column, int row, bool upper) {
  std::array<int, 3> l;  // barycentric, from corner edge0 or edge1 on
  if (upper) {
    l = {size - row, column, row - column};
  } else {
    l = {row, size - column, column - row};
  }
  const int first = upper ? (grid.edge0 < 0 ? 0 : grid.edge0) : grid.edge1;
  const auto at = [&](int corner) { return l[static_cast<std::size_t>((corner - first + 3) % 3)]; };
  return {upper ? grid.face0 : grid.face1, at(1), at(2)};
}

}  // namespace limitcheck::fast::row_stream
