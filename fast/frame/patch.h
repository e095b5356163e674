// SPDX-License-Identifier: MIT
// What becomes of the faces of a patch in a frame, of either scheme: how they are shown, where the points lie, and the
// room that they take; how the border of a face in repair is joined to its inside; and the patches of Loop's scheme.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "fast/frame/sink.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/crack.h"
#include "fast/plan/faces.h"
#include "fast/plan/pairing.h"

namespace limitcheck::fast {

/// What a patch takes in a draw list, or where it begins.
struct DrawSize {
  std::int64_t vertices = 0, draws = 0, triangles = 0;

  friend DrawSize operator+(const DrawSize& a, const DrawSize& b) {
    return {a.vertices + b.vertices, a.draws + b.draws, a.triangles + b.triangles};
  }
  friend DrawSize operator*(std::int64_t n, const DrawSize& a) {
    return {n * a.vertices, n * a.draws, n * a.triangles};
  }
};

/// Rows of points in a block of vertices, the last column of each first: those of a square of k cells along a side, or
/// of the half of it in which row r ends at column k - r.
struct RowBlock {
  int k = 0;
  bool triangle = false;

  int last(int row) const { return triangle ? k - row : k; }
  std::uint32_t at(int row, int column) const {
    const int before = row * (k + 1) - (triangle ? row * (row - 1) / 2 : 0);
    return static_cast<std::uint32_t>(before + last(row) - column);
  }
  std::int32_t size() const { return (k + 1) * (triangle ? k + 2 : 2 * k + 2) / 2; }
  /// The points of the strip between a row and the next: q in row + q % 2, column q / 2.
  int strip_points(int row) const { return last(row) + last(row + 1) + 2; }
  /// All strips.
  DrawSize strips() const {
    const std::int64_t n = k;
    return triangle ? DrawSize{n * n + 2 * n, n, n * n} : DrawSize{2 * n * (n + 1), n, 2 * n * n};
  }
};

/// A point of a part of a patch, by the rows and columns of the part's block.
struct PatchPoint {
  int part, row, column;
};

/// The side of a face that a point lies on, and how far along it; side = -1: none.
struct OnSide {
  int side, t;
};

/// A face of a patch as it is shown, with its parts: those of a face that was cut, else one.
struct ShownFace {
  std::int32_t face = -1;
  Display display = Display::kNothing;
  bool triangle = false, cut = false;
  bool both_halves = false;  // of a grid of Loop's, in one block
  int cells = 0;             // along a side of the face: 2^depth
  int parts = 1;             // 0: the corners by themselves

  /// Whether its border points come from its edges one by one.
  bool repaired() const { return display == Display::kFan || display == Display::kStitch; }
  /// Of each part.
  RowBlock block() const { return {cut ? cells / 2 : cells, triangle}; }
  /// Of each part of a stitched face: what is left without the outer ring, and where it begins.
  RowBlock inner() const { return {block().k - (triangle ? 3 : cut ? 1 : 2), triangle}; }
  PatchPoint first_inner(int part) const { return {part, cut ? 0 : 1, 1}; }
};

/// A point of the border of a side, or of the inner points next to it.
struct StitchPoint {
  std::int64_t t;
  bool inner;
};

/// Joins the border points 0 .. 2^edge_depth of a side to the inner points 0 .. k - shorter of the row of lattice
/// points next to it (k = 2^depth >= 4), without T-vertices. Inner point j lies over (j + shorter / 2) / k: shorter is
/// 3 of a triangle, 2 of a quad or larger face. The shorter way goes first: segments are taken in the order of their
/// midpoints along the side.
///   triangle(a, b, c)   counter-clockwise
template <class Triangle>
void stitch_rows(int k, int edge_depth, int shorter, Triangle&& triangle) {
  const std::int64_t outer_count = std::int64_t{1} << edge_depth, inner_count = k - shorter;
  std::int64_t outer = 0, inner = 0;
  while (outer < outer_count || inner < inner_count) {
    const bool take_outer =
        inner == inner_count ||
        (outer < outer_count && (2 * outer + 1) * k <= (2 * inner + shorter + 1) * outer_count);
    const StitchPoint from{outer, false}, over{inner, true};
    triangle(from, take_outer ? StitchPoint{++outer, false} : StitchPoint{++inner, true}, over);
  }
}

/// A face in repair, with its border points side by side: 2^depth(s) of side s but for its end.
template <class Faces>
struct FaceInRepair {
  const Faces& faces;
  const CrackPlan& plan;
  std::int32_t face;

  int sides() const { return faces.sides(face); }
  int depth(int side) const { return plan.edge_depth[faces.first_side(face) + side]; }
  int points(int side) const { return 1 << depth(side); }
  LatticePoint on_side(int side, int t) const { return faces.on_side(face, side, t, points(side)); }
  LatticePoint centre() const { return faces.centre(face); }
  std::int32_t border() const {
    std::int32_t sum = 0;
    for (int s = 0; s < sides(); ++s) sum += points(s);
    return sum;
  }
  /// Of the outer ring of triangles, where the lattice has k cells along a side.
  std::int64_t ring_triangles(std::int64_t k) const {
    return border() + sides() * (k - Faces::kRowIsShorter);
  }
  template <class Triangle>
  void stitch(int k, int side, Triangle&& triangle) const {
    stitch_rows(k, depth(side), Faces::kRowIsShorter, triangle);
  }
};

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
  /// Row and column of point t of the row next to side e of the face: weights k - t - 2, t + 1, 1 at corners e, e + 1,
  /// e + 2.
  std::array<int, 2> beside(int k, int e, int t) const {
    const int w[3] = {k - t - 2, t + 1, 1};
    return {w[(edge - e + 3) % 3], w[(edge - e + 4) % 3]};
  }
  bool uses_window() const { return display == Display::kStrips || display == Display::kStitch; }
  bool repaired() const { return display == Display::kFan || display == Display::kStitch; }
};

/// Point (column, row) of a grid with 2^depth = size, as a point of face0 (`upper`, row >= column) or of
/// face1, which is -1 for the points of a singleton's dummy.
inline LatticePoint face_point(const Grid& grid, int size, int column, int row, bool upper) {
  return upper ? Half{grid.face0, std::max(grid.edge0, 0)}.lattice(size, size - row, column)
               : Half{grid.face1, std::max(grid.edge1, 0)}.lattice(size, row, size - column);
}

/// What becomes of one grid of a frame. half[0] is the upper left face; half[1].face = -1 if there is
/// none, not even a dummy. A half is a part; what is shown as a whole is one more, with the rows and columns of half[0].
struct LoopPatch {
  static constexpr int kWhole = 2;

  Half half[2];
  int depth = 0;
  Kind kind = Kind::kPair;

  int k() const { return 1 << depth; }
  bool full() const { return half[0].display == Display::kStrips && half[1].display == Display::kStrips; }
  RowBlock block(int part) const { return {k(), part != kWhole}; }
  std::int32_t last_face() const { return half[1].face; }
  /// How many faces are shown() apart.
  int faces() const { return full() ? 1 : 2; }
  /// Which of the faces a part belongs to, or begins with; and its first part.
  static int shown_of(int part) { return part == 1 ? 1 : 0; }
  static int first_part(int s) { return s; }
  std::int32_t face_of(int part) const { return half[shown_of(part)].face; }
  int edge_of(int s) const { return half[s].edge; }
  ShownFace shown(int s) const {
    const bool whole = full();
    return {half[s].face, half[s].display, !whole, false, whole, k()};
  }
  /// The number of points of its window or lattice.
  std::int64_t window_points() const {
    const std::int64_t n = k();
    if (half[1].face < 0) return half[0].uses_window() ? n * (n + 2) : 0;  // both rows of every strip
    return half[0].uses_window() || half[1].uses_window() ? (n + 1) * (n + 1) : 0;
  }

  LatticePoint lattice(const LoopFaces& /*faces*/, PatchPoint p) const {
    if (p.part < 2) return half[p.part].lattice(k(), p.row, p.column);
    return p.row + p.column <= k() ? half[0].lattice(k(), p.row, p.column)
                                   : half[1].lattice(k(), k() - p.row, k() - p.column);
  }
  PatchPoint beside(const LoopFaces& /*faces*/, int s, int side, int t) const {
    const std::array<int, 2> at = half[s].beside(k(), side, t);
    return {s, at[0], at[1]};
  }
  [[gnu::always_inline]] OnSide side_of(PatchPoint p) const {
    const int edge = half[p.part].edge;
    if (p.row + p.column == k()) return {edge, p.column};
    if (p.row == 0) return {(edge + 1) % 3, k() - p.column};
    if (p.column == 0) return {(edge + 2) % 3, p.row};
    return {-1, 0};
  }
  /// Of the points inside a face, in their order.
  std::int64_t inside(PatchPoint p) const {
    return std::int64_t{p.row - 1} * (k() - 1) - std::int64_t{p.row - 1} * p.row / 2 + p.column - 1;
  }
  /// Whether it is a point of another part as well, which has it.
  static bool repeats(PatchPoint /*p*/) { return false; }
  /// Where it lies among all points of the grid, row by row from A.
  std::size_t in_grid(PatchPoint p) const {
    const int n = k() + 1;
    return static_cast<std::size_t>(p.part == 1 ? p.row * n + k() - p.column : (k() - p.row) * n + p.column);
  }
};

inline LoopPatch patch_of(const LoopFaces& faces, const Grid& grid, const CrackPlan& plan) {
  LoopPatch patch;
  patch.depth = grid.depth;
  patch.kind = grid.singleton() ? Kind::kSingleton : Kind::kPair;
  patch.half[0] = {grid.face0, grid.edge0 < 0 ? 0 : grid.edge0, plan.display[grid.face0]};
  if (grid.singleton()) {
    const std::int32_t dummy = grid.edge0 < 0 ? -1 : faces.twin(3 * grid.face0 + grid.edge0);
    patch.half[1] = {dummy < 0 ? -1 : dummy / 3, dummy < 0 ? 0 : dummy % 3, Display::kNothing};
  } else {
    patch.half[1] = {grid.face1, grid.edge1, plan.display[grid.face1]};
  }
  return patch;
}

/// The points inside a face of Loop's.
inline std::int64_t inner_points(const LoopFaces& /*faces*/, const ShownFace& shown) {
  const std::int64_t k = shown.cells;
  return k < 3 ? 0 : (k - 1) * (k - 2) / 2;
}
inline ShownFace shown_face(const LoopFaces& /*faces*/, std::int32_t f, int depth, Display display) {
  return LoopPatch{{{f, 0, display}, {}}, depth}.shown(0);
}

/// The room that a face takes in a draw list.
template <class Faces>
inline DrawSize draw_size(const ShownFace& shown, const Faces& faces, const CrackPlan& plan) {
  const FaceInRepair<Faces> face{faces, plan, shown.face};
  switch (shown.display) {
    case Display::kStrips:
      return shown.parts == 0 ? DrawSize{face.sides(), 1, face.sides() - 2}
                              : shown.parts * shown.block().strips();
    case Display::kFan:
      return {face.border() + 2, 1, face.border()};
    case Display::kStitch: {
      const std::int64_t ring = face.ring_triangles(shown.cells);
      return shown.parts * shown.inner().strips() + DrawSize{3 * ring, 1, ring};
    }
    default:
      return {};
  }
}

/// The strips inside the outer ring of a stitched face.
template <class Patch, class Vertex, class Writer>
void inner_strips(const Patch& patch, int s, const Vertex* grid, Writer& writer) {
  const ShownFace shown = patch.shown(s);
  for (int part = Patch::first_part(s), k = 0; k < shown.parts; ++part, ++k)
    for (int row = 0, rows = shown.inner().k; row < rows; ++row) writer.inner_strip(part, row, grid);
}

/// What a frame counts of a patch.
struct PatchCounts {
  DrawSize size;
  std::int64_t strips = 0;        // of the draws
  std::int64_t limit_points = 0;  // evaluated: rows, each once, the borders of repaired faces, centres
};
template <class Patch, class Faces>
inline PatchCounts count(const Patch& patch, const Faces& faces, const CrackPlan& plan) {
  PatchCounts counts{{}, 0, patch.window_points()};
  for (int s = 0, end = patch.faces(); s < end; ++s) {
    const ShownFace shown = patch.shown(s);
    const DrawSize size = draw_size(shown, faces, plan);
    counts.size = counts.size + size;
    counts.strips += size.draws - (shown.repaired() || shown.parts == 0 ? 1 : 0);
    if (shown.repaired())
      counts.limit_points +=
          FaceInRepair<Faces>{faces, plan, shown.face}.border() + (shown.display == Display::kFan ? 1 : 0);
  }
  return counts;
}

/// The room that a patch takes in a draw list.
template <class Patch, class Faces>
inline DrawSize draw_size(const Patch& patch, const Faces& faces, const CrackPlan& plan) {
  DrawSize size;
  for (int s = 0, end = patch.faces(); s < end; ++s) size = size + draw_size(patch.shown(s), faces, plan);
  return size;
}

}  // namespace limitcheck::fast
