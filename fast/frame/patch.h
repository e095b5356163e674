// SPDX-License-Identifier: MIT
// Where the points of a grid lie on its faces, and how each face is displayed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "fast/frame/sink.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/crack.h"
#include "fast/plan/grid.h"

namespace limitcheck::fast {

/// One of the two triangles of a grid, in a frame of rows and columns of its own: (row, column) has weight
/// `row` at corner `edge`, `column` at the next and k - row - column at the last. The upper left face uses
/// the rows and columns of the window, the lower right one counts them from the other side (k - row, k -
/// column), which turns it onto the first.
///
///        (0, 0) --- (0, k)
///           |      /
///           |    /           half-edge 3 face + edge runs from (k, 0) to (0, k)
///           |  /
///        (k, 0)
struct Half {
  std::int32_t face = -1;
  std::int32_t edge = 0;
  Display display = Display::kNothing;

  std::array<int, 3> weights(int k, int row, int column) const {
    std::array<int, 3> w{};
    w[edge] = row;
    w[(edge + 1) % 3] = column;
    w[(edge + 2) % 3] = k - row - column;
    return w;
  }
  LatticePoint lattice(int k, int row, int column) const {
    const auto w = weights(k, row, column);
    return {face, static_cast<std::uint32_t>(w[1]), static_cast<std::uint32_t>(w[2]),
            static_cast<std::uint32_t>(k)};
  }
  bool uses_window() const { return display == Display::kStrips || display == Display::kStitch; }
  /// Whether its border points come from its edges one by one.
  bool repaired() const { return display == Display::kFan || display == Display::kStitch; }
};

/// What becomes of one grid of a frame. half[0] is the upper left face; half[1].face = -1 if there is
/// none, not even a dummy.
struct Patch {
  Half half[2];
  int depth = 0;
  Kind kind = Kind::kPair;

  bool full() const { return half[0].display == Display::kStrips && half[1].display == Display::kStrips; }

  static Patch of(const Adjacency& adjacency, const Grid& grid, const CrackPlan& plan) {
    Patch patch;
    patch.depth = grid.depth;
    patch.kind = grid.singleton() ? Kind::kSingleton : Kind::kPair;
    patch.half[0] = {grid.face0, grid.edge0 < 0 ? 0 : grid.edge0, plan.display[grid.face0]};
    if (grid.singleton()) {
      const std::int32_t dummy = grid.edge0 < 0 ? -1 : adjacency.twin(3 * grid.face0 + grid.edge0);
      patch.half[1] = {dummy < 0 ? -1 : dummy / 3, dummy < 0 ? 0 : dummy % 3, Display::kNothing};
    } else {
      patch.half[1] = {grid.face1, grid.edge1, plan.display[grid.face1]};
    }
    return patch;
  }
};

/// Interior lattice points of a face at 2^depth = k, and the number of those in the rows before `row`.
inline std::int64_t interior_points(std::int64_t k) {
  return k < 3 ? 0 : (k - 1) * (k - 2) / 2;
}
inline std::int64_t interior_before(std::int64_t k, std::int64_t row) {
  return (row - 1) * (k - 1) - (row - 1) * row / 2;
}

}  // namespace limitcheck::fast

namespace limitcheck::fast::row_stream {

/// Point (column, row) of a grid with 2^depth = size, as a point of face0 (`upper`, row >= column) or of
/// face1, which is -1 for the points of a singleton's dummy.
inline LatticePoint face_point(const Grid& grid, int size, int column, int row, bool upper) {
  return upper ? Half{grid.face0, std::max(grid.edge0, 0)}.lattice(size, size - row, column)
               : Half{grid.face1, std::max(grid.edge1, 0)}.lattice(size, row, size - column);
}

}  // namespace limitcheck::fast::row_stream
