// SPDX-License-Identifier: MIT
// What becomes of the faces of one grid of Loop's scheme in a frame, where its points lie on them, and the room it
// takes; and how the border of a face in repair, of either scheme, is joined to its inside.
#pragma once

#include <array>
#include <cstdint>

#include "fast/frame/sink.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/crack.h"
#include "fast/plan/faces.h"
#include "fast/plan/grid.h"

namespace limitcheck::fast {

/// What a patch takes in a draw list, or where it begins.
struct DrawSize {
  std::int64_t vertices = 0, draws = 0, triangles = 0;
};

/// Joins the border points 0 .. 2^edge_depth of a side to the inner points 0 .. k - shorter of the row of lattice
/// points next to it (k = 2^depth >= 4), without T-vertices. Inner point j lies over (j + shorter / 2) / k: shorter is
/// 3 of a triangle, 2 of a quad or larger face. The shorter way goes first: segments are taken in the order of their
/// midpoints along the side.
///   triangle(a, a_inner, b, b_inner, c, c_inner)   counter-clockwise; a_inner says whether a is an index of
///                                                  the inner row
template <class Triangle>
void stitch_rows(int k, int edge_depth, int shorter, Triangle&& triangle) {
  const std::int64_t outer_count = std::int64_t{1} << edge_depth, inner_count = k - shorter;
  std::int64_t outer = 0, inner = 0;
  while (outer < outer_count || inner < inner_count) {
    const bool take_outer =
        inner == inner_count ||
        (outer < outer_count && (2 * outer + 1) * k <= (2 * inner + shorter + 1) * outer_count);
    if (take_outer) {
      triangle(outer, false, outer + 1, false, inner, true);
      ++outer;
    } else {
      triangle(outer, false, inner + 1, true, inner, true);
      ++inner;
    }
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
  /// Whether its border points come from its edges one by one.
  bool repaired() const { return display == Display::kFan || display == Display::kStitch; }
};

/// Point (column, row) of a grid with 2^depth = size, as a point of face0 (`upper`, row >= column) or of
/// face1, which is -1 for the points of a singleton's dummy.
inline LatticePoint face_point(const Grid& grid, int size, int column, int row, bool upper) {
  return upper ? Half{grid.face0, std::max(grid.edge0, 0)}.lattice(size, size - row, column)
               : Half{grid.face1, std::max(grid.edge1, 0)}.lattice(size, row, size - column);
}

/// What becomes of one grid of a frame. half[0] is the upper left face; half[1].face = -1 if there is
/// none, not even a dummy.
struct LoopPatch {
  Half half[2];
  int depth = 0;
  Kind kind = Kind::kPair;

  bool full() const { return half[0].display == Display::kStrips && half[1].display == Display::kStrips; }
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

/// Interior lattice points of a face at 2^depth = k, and the number of those in the rows before `row`.
inline std::int64_t interior_points(std::int64_t k) {
  return k < 3 ? 0 : (k - 1) * (k - 2) / 2;
}
inline std::int64_t interior_before(std::int64_t k, std::int64_t row) {
  return (row - 1) * (k - 1) - (row - 1) * row / 2;
}

/// The number of limit points evaluated for a patch: rows, each once, the borders of repaired faces, centres.
inline std::int64_t limit_points(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan) {
  const std::int64_t k = std::int64_t{1} << patch.depth;
  std::int64_t points = 0;
  if (patch.half[1].face < 0)
    points = patch.half[0].uses_window() ? k * (k + 2) : 0;  // both rows of every strip
  else if (patch.half[0].uses_window() || patch.half[1].uses_window())
    points = (k + 1) * (k + 1);
  for (const Half& half : patch.half) {
    if (!half.repaired()) continue;
    points +=
        FaceInRepair<LoopFaces>{faces, plan, half.face}.border() + (half.display == Display::kFan ? 1 : 0);
  }
  return points;
}

/// The room that a patch takes in a draw list.
inline DrawSize draw_size(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan) {
  const std::int64_t k = std::int64_t{1} << patch.depth;
  if (patch.full()) return {2 * k * (k + 1), k, 2 * k * k};
  DrawSize size;
  const auto add = [&](std::int64_t vertices, std::int64_t draws, std::int64_t triangles) {
    size.vertices += vertices, size.draws += draws, size.triangles += triangles;
  };
  for (const Half& half : patch.half) {
    const FaceInRepair<LoopFaces> face{faces, plan, half.face};
    if (half.display == Display::kStrips) add(k * k + 2 * k, k, k * k);
    if (half.display == Display::kFan) add(face.border() + 2, 1, face.border());
    if (half.display == Display::kStitch) {
      const std::int64_t ring = face.ring_triangles(k);
      add((k - 1) * (k - 3) + 3 * ring, k - 3 + 1, (k - 3) * (k - 3) + ring);
    }
  }
  return size;
}

/// How many of the draws of a patch are strips.
inline std::int64_t strips_of(const LoopPatch& patch, const LoopFaces& /*faces*/, const DrawSize& size) {
  return size.draws - (patch.half[0].repaired() ? 1 : 0) - (patch.half[1].repaired() ? 1 : 0);
}

/// The points inside a face that is displayed (or its centre), and its triangles.
struct FaceSize {
  std::int64_t points, triangles;
};
inline FaceSize face_size(const LoopFaces& faces, std::int32_t f, int depth, const CrackPlan& plan) {
  const std::int64_t k = std::int64_t{1} << depth;
  const FaceInRepair<LoopFaces> face{faces, plan, f};
  if (plan.display[f] == Display::kFan) return {1, face.border()};
  return {interior_points(k),
          plan.display[f] == Display::kStitch ? (k - 3) * (k - 3) + face.ring_triangles(k) : k * k};
}

}  // namespace limitcheck::fast
