// SPDX-License-Identifier: MIT
// Where the numbers of one batch of grids or quads lie: shared by the gatherer, which fills them, and the kernels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "fast/mesh/vec3.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast::row_stream {

/// What row streaming delivers; and one from its six numbers.
using Vertex = SurfaceVertex<float>;
inline Vertex vertex_from(const float* x) {
  return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

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
///   A: SE E NE NW W    C: NW W SW SE E    B: NE NW W SW    D: SW SE E NE   (seen from the corner)
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
  static constexpr int kWindow = 14;       // window_width entries
};

/// From a depth on every control edge and every grid has an origin of its own, near it: differences of points
/// are then formed from small numbers, and normals gain what the mesh is larger than an edge. The edges'
/// points come from strips along them, which both faces compute alike. Below depth 4 the strips would cost
/// more than normals need, but for low triangles: see LocalOrigins.
inline constexpr int kLocalFrom = 4;

/// What can have an origin of its own: the sides of a grid or quad, the diagonal of a grid, and the inside. If anything
/// in a batch has one, its input says of each part which lanes have it, by 1 or 0. An origin at 0 changes no bit: so
/// what neither needs is the same in a batch that has none.
enum Part { kAB = 0, kBC = 1, kCD = 2, kDA = 3, kAC = 4, kInside = 5 };
inline constexpr int kParts = 6;

constexpr int corner_block_size(int depth) {
  return CornerBlock::kWindow + 3 * window_width(kA, depth);
}
constexpr int parts_offset(int depth) {
  return 4 * corner_block_size(depth);
}

/// An edge is regular if the four vertices of its two triangles are interior and have six triangles each, a grid if its five
/// edges are. From kLocalFrom on the points of a regular edge come from the polynomials that the surface is along it, and
/// those inside a regular grid from the two that it is there. (The two ends would do for an edge: but then the many edges
/// of an irregular mesh that have such ends would lie in batches of others, which have to evaluate both.)
///
/// The input of a batch of regular grids is that of a batch of this depth, whose windows hold the ring of a regular
/// vertex.
inline constexpr int kPatchWindow = 1;

/// Of each edge of a grid, by Part, 1 in the lanes in which it is regular; read where only some are.
constexpr int regular_offset(int depth) {
  return parts_offset(depth) + kParts;
}
constexpr int input_size(int depth) {
  return regular_offset(depth) + kInside;
}

/// Where an edge of a grid has its ends: corners, and where in their windows the edge's own begin, counted from the core.
struct EdgeEnds {
  int p, p_first, q, q_first;
};
inline constexpr EdgeEnds kEdgeEnds[kInside] = {
    {kA, 0, kB, 1}, {kB, 0, kC, 2}, {kD, 1, kC, 0}, {kA, 2, kD, 0}, {kA, 1, kC, 1}};

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
/// three; then whether it has an origin of its own, and whether it is regular.
constexpr int edge_window_width(int depth) {
  return 3 + 2 * depth;
}
constexpr int edge_block_size(int depth) {
  return CornerBlock::kWindow + 3 * edge_window_width(depth);
}
constexpr int edge_part_offset(int depth) {
  return 2 * edge_block_size(depth);
}
constexpr int edge_input_size(int depth) {
  return edge_part_offset(depth) + 2;
}
constexpr int edge_output_size(int depth) {
  return 6 * ((1 << depth) + 1);  // NOLINT(clang-analyzer-core.UndefinedBinaryOperatorResult): 0..10
}
/// Where an edge has its ends: their corner blocks, and where in their windows those of the edge begin; the lanes in which
/// it has an origin of its own, and in which it is regular: in some of them, in all.
template <class T>
struct EdgeInput {
  const T* p;
  int p_first;
  const T* q;
  int q_first;
  const T *own, *regular;
  bool some_regular, all_regular;
};
/// Points and one of their tangents; one coordinate of three rows and two windows.
constexpr int edge_work_size(int depth) {
  return 2 * edge_output_size(depth) + 2 * edge_window_width(depth);
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

/// The coordinates of a batch of grids or edges, and whether some part of it has an origin of its own; and the edges, by
/// Part, that are to be polynomials in some lane, and in all.
template <class T>
struct BatchPlacement : Placement<T> {
  bool local = false;
  unsigned some_regular = 0, all_regular = 0;
};

/// Of a batch of edges.
template <class T>
EdgeInput<T> edge_input(const T* input, int depth, int lanes, const BatchPlacement<T>& placement) {
  const T* own = input + edge_part_offset(depth) * lanes;
  return {input,
          0,
          input + edge_block_size(depth) * lanes,
          0,
          own,
          own + lanes,
          placement.some_regular != 0,
          placement.all_regular != 0};
}

/// The unit of limit points of a depth, which the rules leave 12 * 8^depth times too large. Exact where T
/// divides exactly.
template <class T>
T limit_unit(T unit, int depth) {
  if constexpr (std::is_floating_point_v<T>)
    return static_cast<T>(std::ldexp(static_cast<double>(unit) / 12, -3 * depth));
  else
    return unit / static_cast<T>(std::ldexp(12., 3 * depth));
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

/// A quad on its lattice, N = 2^depth, corners in the face's own order. The neighbourhood of a corner is seen
/// in a frame of its own, turned by as many quarters as the corner's number: x along the side that begins
/// there.
///
///        D (0,N) ---- C (N,N)          f' -- e' -- f         e = e_k, f = f_k, e' = e_{k+1}, f' = f_{k+1},
///          |            |              |     |     |         e'' = e_{k+2}, e- = e_{k-1}, f- = f_{k-1}:
///          |            |              e'' - c --- e         entries of the ring from the corner's own k
///          |            |                    |     |         on
///        A (0,0) ---- B (N,0)                e- -- f-
///
/// Rows -1 and N+1, columns -1 and N+1 are the points across the border. The point diagonally beyond a corner
/// is never read: it does not exist unless four quads meet there. Side k, see Part, begins at corner k.

/// Points that a level takes from the ring of each corner: c, then seven entries from e- on.
constexpr int kQuadCore = 7;
constexpr int kQuadBorder = 3 * (1 + kQuadCore);
enum RingPoint { kHub = 0, kEBefore, kFBefore, kE, kF, kEAfter, kFAfter, kEBeyond };

/// Each level loses an e and an f at either end of a window.
constexpr int quad_window_width(int depth) {
  return kQuadCore + 4 * depth;
}

/// Input of a batch at a corner, in units of `lanes` numbers. With De the sum of the differences from c to
/// the e (on a boundary: to the two ends of the ring), Df of those to the f,
///   c' = 4 c + k0 De + k1 Df, De' = k2 De + k3 Df, Df' = k2 De + k4 Df,     all times 4 per level.
struct QuadCornerBlock {
  static constexpr int kWeights = 0;  // k0 .. k4
  static constexpr int kCentre = 5;   // c
  static constexpr int kEdges = 8;    // De
  static constexpr int kFaces = 11;   // Df
  static constexpr int kLimit = 14;   // limit position and unit normal, in the caller's coordinates
  static constexpr int kHead = 20;    // so much is the vertex' own
  static constexpr int kEnds = 20;    // which entries of the window are the ends of an open ring
  static constexpr int kWindow = 22;  // entries e f e f .. e
};
constexpr int quad_block_size(int depth) {
  return QuadCornerBlock::kWindow + 3 * quad_window_width(depth);
}

/// Of quads that are streamed: four corner blocks, then per side 1 where it is sharp (a boundary or one side
/// of a cut), then per side 1 where it is a polynomial, then per corner 1 where it is a dart, and for each
/// level from 1 on how far its centre has moved since the level before; then the parts.
constexpr int quad_sharp_offset(int depth) {
  return 4 * quad_block_size(depth);
}
constexpr int quad_polynomial_offset(int depth) {
  return quad_sharp_offset(depth) + 4;
}
constexpr int quad_dart_size(int depth) {
  return 1 + 3 * depth;
}
constexpr int quad_dart_offset(int depth) {
  return quad_polynomial_offset(depth) + 4;
}
/// Of regular quads: 4 x 4 points, the row below A B first, then the limits of the four corners.
constexpr int kPatchLimits = 48;
constexpr int kPatchSize = kPatchLimits + 24;

constexpr int quad_parts_offset(int depth) {
  return quad_dart_offset(depth) + 4 * quad_dart_size(depth);
}
constexpr int quad_input_size(int depth) {
  return std::max(quad_parts_offset(depth) + kParts, kPatchSize);
}

/// A batch of quads of one depth, in a form in which the lanes differ in numbers alone. Bits: corner or
/// side k.
template <class T>
struct QuadBatch {
  T* input;
  int depth;
  std::array<int, 4>
      period;          // entries of the ring at a corner, if all lanes have as many and the window would
                       // be longer; the window is the ring then, from e- on. Else 0.
  unsigned open = 0;   // corners where some lane's ring is open
  unsigned darts = 0;  // corners that are darts in some lane
  unsigned sharp = 0;  // sides that are sharp in some lane
  unsigned some_polynomial = 0, all_polynomial = 0;  // sides that are polynomials in some lane, in all
  bool local = false;                                // some part has an origin of its own
};

/// Along a side between two interior vertices of four quads the surface is a polynomial of the 12 points
/// around it: from an origin near the side, numbers of three coordinates.
struct QuadCurve {
  static constexpr int kPoints = 0;   // 4 points of the curve, times 6
  static constexpr int kAlong = 12;   // their 3 differences
  static constexpr int kAcross = 21;  // 4 derivatives across, to the left
  static constexpr int kOrigin = 33;  // in the caller's coordinates
  static constexpr int kSize = 36;
};

/// From this depth on the limits inside a quad come from the level before the last, whose points make the
/// last level's: half the memory, and fewer operations. Rows and columns next to the sides are as ever. A number
/// with a member kNeverFused does without.
constexpr int kFusedFrom = 5;

/// Working memory of a kernel, in units of `lanes` numbers: four rows of each level from 1 on, or, before the
/// rows begin, what a side needs by itself (what its levels take from two corners, its points with two tangents, and a
/// coordinate of three rows of two levels in turn); what the levels take from the corners; the curves of the sides.
constexpr int quad_row_size(int level) {
  return 3 * ((1 << level) + 3);  // NOLINT(clang-analyzer-core.UndefinedBinaryOperatorResult): 0..10
}
constexpr int quad_rows_offset(int level) {
  int offset = 0;
  for (int l = 1; l < level; ++l) offset += 4 * quad_row_size(l);
  return offset;
}
constexpr int quad_side_work_size(int depth) {
  return 2 * kQuadBorder * depth + 9 * (1 << depth) + 6 * ((1 << depth) + 1);
}
constexpr int quad_border_offset(int depth) {
  return std::max(quad_rows_offset(depth + 1), quad_side_work_size(depth));
}
constexpr int quad_curves_offset(int depth) {
  return quad_border_offset(depth) + 4 * kQuadBorder * (depth + 1);
}
constexpr int quad_patch_offset(int depth) {
  return quad_curves_offset(depth) + 4 * QuadCurve::kSize;
}
constexpr int kPatchWork = 48 + 24;  // coefficients of the patch, and of a row
/// Points of sides that have origins of their own: of B C, C D and D A, for those of A B leave first.
constexpr int quad_strips_offset(int depth) {
  return quad_patch_offset(depth) + kPatchWork;
}
constexpr int quad_work_size(int depth) {
  return quad_strips_offset(depth) + 3 * edge_output_size(depth);
}

/// The unit of limit points of a depth, which the rules leave 36 * 4^depth times too large.
template <class T>
T quad_unit(T unit, int depth) {
  if constexpr (std::is_floating_point_v<T>)
    return static_cast<T>(std::ldexp(static_cast<double>(unit) / 36, -2 * depth));
  else
    return unit / static_cast<T>(std::ldexp(36., 2 * depth));
}

/// Where the vertices of a batch go: vertex i of row j of the quad in lane k, position then unit normal,
/// starts at lane[k] + (j & row_mask) * row_stride + 6 * i, in numbers: row_mask 0 reuses one row, 1 two in
/// turn. Several lanes may go to the same place if they are the same quad. `row` is called, if set, after
/// each row.
template <class T>
struct QuadTarget {
  T* const* lane = nullptr;
  std::ptrdiff_t row_stride = 0;
  void (*row)(void* context, int j) = nullptr;
  void* context = nullptr;
  int row_mask = kEveryRow;

  std::ptrdiff_t row_offset(int j) const { return (j & row_mask) * row_stride; }
};

}  // namespace limitcheck::fast::row_stream
