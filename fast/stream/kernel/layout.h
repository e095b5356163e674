// SPDX-License-Identifier: MIT
// Where the numbers of one batch of grids lie: shared by the gatherer, which fills them, and the kernels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "fast/mesh/placement.h"

namespace limitcheck::fast::row_stream {

inline constexpr int kMaxDepth = 10;
inline constexpr int kMaxLanes = 16;

/// A grid on its lattice, N = 2^depth. Neighbours of (i, j): E (i+1, j), NE (i+1, j+1), NW (i, j+1), W, SW,
/// SE.
///
///        D (0,N) ---- C (N,N)      Upper left triangle A C D: face0 of the Grid; corner edge0 is A.
///          |        /   |          Lower right triangle C A B: face1.
///          |      /     |
///          |    /       |          Rows -1 and N+1, columns -1 and N+1: the points across the grid's border,
///          |  /         |          those that a border point has for neighbours.
///        A (0,0) ---- B (N,0)
enum Corner { kA = 0, kB = 1, kC = 2, kD = 3 };

/// Ring entries that the grid's own faces and their neighbours take at a corner, counter-clockwise:
/// flap, (2 faces: 3 points | 1 face: 2 points), flap. Index -1 is the first.
///   A: SE E NE NW W    C: NW W SW SE E    B: NE NW W SW    D: W SE E NE   (seen from the corner)
constexpr int core_width(int corner) {
  return corner % 2 == 0 ? 5 : 4;
}
/// Each level loses one entry at either end of the window.
constexpr int window_width(int corner, int depth) {
  return core_width(corner) + 2 * depth;
}

/// Input of a batch, in units of `lanes` numbers, three coordinates each unless said otherwise. With d the
/// sum of the differences from the corner c to its ring, c' = 8 c + k0 d and d' = k1 d, both times 8 per
/// level: nothing is lost to cancellation, and moving the origin moves c alone.
struct CornerBlock {
  static constexpr int kCoefficients = 0;  // k0 k1
  static constexpr int kCentre = 2;        // c
  static constexpr int kDifference = 5;    // d
  static constexpr int kLimit = 8;         // limit position and unit normal, in the caller's coordinates
  static constexpr int kWindow = 14;       // window_width entries, less c with local origins; overwritten
};

/// From a depth on every control edge and every grid has an origin of its own, near it: differences of points
/// are then formed from small numbers, and normals gain what the mesh is larger than an edge. The edges'
/// points come from strips along them, which both faces compute alike. Below depth 4 the strips would cost
/// more than normals need, but for meshes with low triangles: see local_origins_from.
inline constexpr int kLocalFrom = 4;

constexpr int corner_block_size(int depth) {
  return CornerBlock::kWindow + 3 * window_width(kA, depth);
}
constexpr int input_size(int depth) {
  return 4 * corner_block_size(depth);
}

/// Working memory of a kernel, in units of `lanes` numbers.
constexpr int row_size(int level) {
  return 3 * ((1 << level) + 4);
}
constexpr int rows_offset(int level) {
  int offset = 0;
  for (int l = 0; l < level; ++l) offset += 3 * row_size(l);
  return offset;
}
constexpr int kBorderSize = 9;  // centre, first and last core entry

/// Likewise for a control edge: two corner blocks, whose windows have the edge in the middle of a core of
/// three.
constexpr int edge_window_width(int depth) {
  return 3 + 2 * depth;
}
constexpr int edge_block_size(int depth) {
  return CornerBlock::kWindow + 3 * edge_window_width(depth);
}
constexpr int edge_input_size(int depth) {
  return 2 * edge_block_size(depth);
}
constexpr int edge_work_size(int depth) {
  return 2 * 3 * 3 * ((1 << depth) + 2) + 6 + edge_input_size(depth);
}
constexpr int edge_output_size(int depth) {
  return 6 * ((1 << depth) + 1);  // NOLINT(clang-analyzer-core.UndefinedBinaryOperatorResult): 0..10
}

/// The strips are done before the rows begin, and work where those will be.
constexpr int border_offset(int depth) {
  return std::max(rows_offset(depth + 1), edge_work_size(depth));
}

/// Of the five edges of a grid, those whose points are kept: A D, B C and A C, which cross the rows, and D C,
/// the last row.
inline constexpr int kKeptEdges = 4;
constexpr int strips_offset(int depth) {
  return border_offset(depth) + 4 * kBorderSize * (depth + 1);
}
constexpr int work_size(int depth) {
  return strips_offset(depth) + kKeptEdges * edge_output_size(depth);
}

/// The kernel's coordinates, and from which depth on edges and grids have origins of their own.
template <class T>
struct KernelPlacement : Placement<T> {
  int local_from = kLocalFrom;  // 1 at least

  bool has_local_origin(int depth) const { return depth >= local_from; }
};

/// The placement of limit points of a depth, which the rules leave 12 * 8^depth times too large. Exact where
/// T divides exactly.
template <class T>
KernelPlacement<T> scaled(KernelPlacement<T> placement, int depth) {
  if constexpr (std::is_floating_point_v<T>)
    placement.unit = static_cast<T>(std::ldexp(static_cast<double>(placement.unit) / 12, -3 * depth));
  else
    placement.unit = placement.unit / static_cast<T>(std::ldexp(12., 3 * depth));
  return placement;
}

inline constexpr int kEveryRow = -1;

/// Where the vertices of a batch go: vertex i of row j of the grid in lane k, position then unit normal,
/// starts at base + k * lane_stride + (j & row_mask) * row_stride + 6 * i, in numbers. row_mask 0 reuses one
/// row, 1 two in turn. `row` is called, if set, after each row.
template <class T>
struct Target {
  T* base = nullptr;
  std::ptrdiff_t lane_stride = 0;
  std::ptrdiff_t row_stride = 0;
  void (*row)(void* context, int j) = nullptr;
  void* context = nullptr;
  int row_mask = kEveryRow;

  std::ptrdiff_t row_offset(int j) const { return (j & row_mask) * row_stride; }
};

}  // namespace limitcheck::fast::row_stream
