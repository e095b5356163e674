// SPDX-License-Identifier: MIT
// From the lattice of a grid to the parameters of its two faces.
#pragma once

#include <algorithm>

#include "fast/frame/patch.h"
#include "fast/plan/grid.h"

namespace limitcheck::fast::row_stream {

/// Point (column, row) of a grid with 2^depth = size, as a point of face0 (`upper`, row >= column) or of
/// face1, which is -1 for the points of a singleton's dummy.
inline LatticePoint face_point(const Grid& grid, int size, int column, int row, bool upper) {
  return upper ? Half{grid.face0, std::max(grid.edge0, 0)}.lattice(size, size - row, column)
               : Half{grid.face1, std::max(grid.edge1, 0)}.lattice(size, row, size - column);
}

}  // namespace limitcheck::fast::row_stream
