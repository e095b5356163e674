// SPDX-License-Identifier: MIT
// What becomes of one control face of Catmull-Clark's scheme in a frame, and the room it takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/rules/masks.h"

namespace limitcheck::fast {

/// A face with its parts: row r of a part is the one at j = m - r, m = part_size(depth).
inline ShownFace shown_face(const QuadFaces& faces, std::int32_t f, int depth, Display display) {
  const bool cut = faces.cut();
  return {f, display, false, cut, false, 1 << depth, cut && depth == 0 ? 0 : faces.parts(f)};
}
inline std::int64_t inner_points(const QuadFaces& /*faces*/, const ShownFace& shown) {
  const std::int64_t m = shown.block().k;
  if (!shown.cut) return (m - 1) * (m - 1);
  return m > 0 ? 1 + shown.parts * m * (m - 1) : 0;
}

/// What becomes of a face that is displayed. Its parts are those of the face.
struct QuadPatch {
  ShownFace face;
  int depth = 0;
  Kind kind = Kind::kPair;

  /// The corners of a face by themselves: what a face that was cut shows at depth 0.
  bool corners_only() const { return face.display == Display::kStrips && face.parts == 0; }
  RowBlock block(int /*part*/) const { return face.block(); }
  std::int32_t last_face() const { return face.face; }
  static constexpr int faces() { return 1; }
  static int shown_of(int /*part*/) { return 0; }
  static int first_part(int /*s*/) { return 0; }
  std::int32_t face_of(int /*part*/) const { return face.face; }
  static int edge_of(int /*s*/) { return -1; }
  const ShownFace& shown(int /*s*/) const { return face; }
  std::int64_t window_points() const {
    return face.display == Display::kFan ? 0 : std::int64_t{face.parts} * face.block().size();
  }

  LatticePoint lattice(const QuadFaces& faces, PatchPoint p) const {
    return faces.lattice(face.face, depth, {p.part, p.column, face.block().k - p.row});
  }
  PatchPoint beside(const QuadFaces& faces, int /*s*/, int side, int t) const {
    const PartPoint p = faces.beside(face.face, depth, side, t);
    return {p.part, face.block().k - p.j, p.i};
  }
  [[gnu::always_inline]] OnSide side_of(PatchPoint p) const {
    const int m = face.block().k, i = p.column, j = m - p.row;
    if (face.cut) {
      if (j == 0) return {p.part, i};
      if (i == 0) return {(p.part == 0 ? face.parts : p.part) - 1, 2 * m - j};
      return {-1, 0};
    }
    if (j == 0) return {0, i};
    if (i == m) return {1, j};
    if (j == m) return {2, m - i};
    if (i == 0) return {3, m - j};
    return {-1, 0};
  }
  /// Of a face that was cut: its centre, then part by part those with i = 1 .. m and j = 1 .. m - 1, row by row. Those
  /// with j = m are points i = m of the part before.
  std::int64_t inside(PatchPoint p) const {
    const std::int64_t m = face.block().k;
    std::int64_t part = p.part, i = p.column, j = m - p.row;
    if (!face.cut) return (j - 1) * (m - 1) + i - 1;
    if (i == m && j == m) return 0;
    if (j == m) part = (part + face.parts - 1) % face.parts, j = i, i = m;
    return 1 + (part * (m - 1) + j - 1) * m + i - 1;
  }
  bool repeats(PatchPoint p) const {
    return face.cut && p.row == 0 && (p.column < face.block().k || p.part > 0);
  }
  std::size_t in_grid(PatchPoint p) const {
    const int m = face.block().k;
    return static_cast<std::size_t>((p.part * (m + 1) + m - p.row) * (m + 1) + p.column);
  }
};

inline QuadPatch patch_of(const QuadFaces& faces, const Grid& grid, const CrackPlan& plan) {
  return {shown_face(faces, grid.face0, grid.depth, plan.display[grid.face0]), grid.depth};
}

/// The border of a repaired face: limit vertices along its sides, from corner to corner.
template <class Real>
using QuadBorder = std::vector<std::vector<SurfaceVertex<Real>>>;

/// Evaluates a face that is not shown as strips, and hands it to the writer.
///   points   knows position(v) and limit(v) of a vertex of the mesh of quads, edge(h, depth, out) of a half-edge,
///            middle(quad) of a quad, and grid(patch), the points of a patch; see in_grid()
template <class Real, class Points, class Writer>
void show_repaired(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan, FanCentre centre,
                   const Points& points, QuadBorder<Real>& border, Writer& writer) {
  const std::int32_t f = patch.face.face, first = faces.first_side(f);
  if (patch.corners_only())
    return writer.corners([&](int k) { return points.limit(faces.vertex(first + k)); });
  border.resize(static_cast<std::size_t>(faces.sides(f)));
  for (int side = 0; side < faces.sides(f); ++side) {
    const std::int32_t c = first + side;
    const int depth = plan.edge_depth[c];
    auto& out = border[static_cast<std::size_t>(side)];
    out.resize((std::size_t{1} << depth) + 1);
    if (!faces.cut()) {
      points.edge(c, depth, out.data());
    } else if (depth == 0) {
      out[0] = points.limit(faces.vertex(c)), out[1] = points.limit(faces.vertex(faces.next(c)));
    } else {
      points.edge(faces.first_half(c), depth - 1, out.data());
      points.edge(faces.second_half(c), depth - 1, out.data() + (std::size_t{1} << (depth - 1)));
    }
  }
  if (patch.face.display == Display::kStitch) {
    const SurfaceVertex<Real>* grid = points.grid(patch);
    inner_strips(patch, 0, grid, writer);
    return writer.ring(0, grid, border);
  }
  // The limit point in the middle, or the mean of the corners with the normal of the limit.
  SurfaceVertex<Real> middle =
      faces.cut() ? points.limit(faces.mesh->adjacency.corner(first, 2)) : points.middle(f);
  if (centre != FanCentre::kLimit) {
    Vec3<double> sum{};
    for (int k = 0; k < faces.sides(f); ++k) {
      const std::int32_t v = faces.vertex(first + k);
      sum = sum +
            widen<Real>(centre == FanCentre::kFlatControl ? points.position(v) : points.limit(v).position);
    }
    middle.position = narrow<Real>(1. / faces.sides(f) * sum);
  }
  writer.fan(0, middle, border);
}

}  // namespace limitcheck::fast
