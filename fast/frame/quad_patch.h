// SPDX-License-Identifier: MIT
// What becomes of one control face of Catmull-Clark's scheme in a frame, and the room it takes.
#pragma once

#include <cstdint>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/rules/masks.h"

namespace limitcheck::fast {

/// A face that is displayed.
struct QuadPatch {
  std::int32_t face = -1;
  int depth = 0;
  Display display = Display::kNothing;
};

inline QuadPatch patch_of(const QuadFaces& /*faces*/, const Grid& grid, const CrackPlan& plan) {
  return {grid.face0, grid.depth, plan.display[grid.face0]};
}

/// The corners of a face by themselves: what a face that was cut shows at depth 0.
inline bool corners_only(const QuadPatch& patch, const QuadFaces& faces) {
  return patch.display == Display::kStrips && faces.part_size(patch.depth) == 0;
}

/// All points of a face: part by part, row by row from v = 0.
template <class Real>
struct FacePoints {
  std::vector<SurfaceVertex<Real>> points;
  int size = 0;  // cells along a side of a part

  void resize(int parts, int cells) {
    size = cells;
    points.resize(static_cast<std::size_t>(parts) * static_cast<std::size_t>((cells + 1) * (cells + 1)));
  }
  std::size_t index(PartPoint p) const {
    return static_cast<std::size_t>((p.part * (size + 1) + p.j) * (size + 1) + p.i);
  }
  SurfaceVertex<Real>& at(PartPoint p) { return points[index(p)]; }
  const SurfaceVertex<Real>& at(PartPoint p) const { return points[index(p)]; }
};

/// Side c of a face at a depth of its own, 2^depth + 1 points.
///   limit(v)                of a vertex of the mesh of quads
///   edge(h, depth, out)     evaluates a half-edge of that mesh
template <class Real, class Limit, class Edge>
void evaluate_side(const QuadFaces& faces, std::int32_t c, int depth, Limit&& limit, Edge&& edge,
                   std::vector<SurfaceVertex<Real>>& out) {
  out.resize((std::size_t{1} << depth) + 1);
  if (!faces.cut()) {
    edge(c, depth, out.data());
  } else if (depth == 0) {
    out[0] = limit(faces.vertex(c)), out[1] = limit(faces.vertex(faces.next(c)));
  } else {
    edge(faces.first_half(c), depth - 1, out.data());
    edge(faces.second_half(c), depth - 1, out.data() + (std::size_t{1} << (depth - 1)));
  }
}

/// The centre of a face: the limit point in its middle, or the mean of its corners, with the normal of the
/// limit.
///   position(v), limit(v)   of a vertex of the mesh of quads
///   middle_of_quad()        of a face that is a quad itself
template <class Real, class Position, class Limit, class Middle>
SurfaceVertex<Real> face_centre(const QuadFaces& faces, std::int32_t f, FanCentre centre, Position&& position,
                                Limit&& limit, Middle&& middle_of_quad) {
  const std::int32_t first = faces.first_side(f);
  SurfaceVertex<Real> middle = faces.cut() ? limit(faces.mesh->adjacency.corner(first, 2)) : middle_of_quad();
  if (centre == FanCentre::kLimit) return middle;
  Vec3<double> sum{};
  for (int k = 0; k < faces.sides(f); ++k) {
    const std::int32_t v = faces.vertex(first + k);
    sum = sum + widen<Real>(centre == FanCentre::kFlatControl ? position(v) : limit(v).position);
  }
  middle.position = narrow<Real>(1. / faces.sides(f) * sum);
  return middle;
}

/// The cells of a stitched face that are displayed by themselves: of each part `from` to `to` in both
/// directions. The outer ring is left out.
struct InnerCells {
  InnerCells(const QuadPatch& patch, const QuadFaces& faces)
      : from(1), to(faces.part_size(patch.depth) - (faces.cut() ? 0 : 1)) {}
  int count() const { return to - from; }
  int from, to;
};

/// Triangles of a face, and the room that it takes in a draw list.
inline DrawSize draw_size(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  const std::int64_t parts = faces.parts(patch.face), m = faces.part_size(patch.depth),
                     sides = faces.sides(patch.face);
  if (corners_only(patch, faces)) return {sides, 1, sides - 2};
  const FaceInRepair<QuadFaces> face{faces, plan, patch.face};
  switch (patch.display) {
    case Display::kStrips:
      return {parts * m * 2 * (m + 1), parts * m, parts * 2 * m * m};
    case Display::kFan:
      return {face.border() + 2, 1, face.border()};
    case Display::kStitch: {
      const std::int64_t inner = InnerCells(patch, faces).count(),
                         ring = face.ring_triangles(std::int64_t{1} << patch.depth);
      return {parts * inner * 2 * (inner + 1) + 3 * ring, parts * inner + 1,
              parts * 2 * inner * inner + ring};
    }
    default:
      return {};
  }
}

/// The number of limit points evaluated for a face: rows, each once, the border of a repaired face, its
/// centre.
inline std::int64_t limit_points(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  const std::int64_t parts = faces.parts(patch.face), m = faces.part_size(patch.depth);
  if (corners_only(patch, faces)) return 0;
  std::int64_t points = 0;
  if (patch.display != Display::kFan) points += parts * (m + 1) * (m + 1);
  if (patch.display != Display::kStrips) points += FaceInRepair<QuadFaces>{faces, plan, patch.face}.border();
  return points + (patch.display == Display::kFan ? 1 : 0);
}

inline std::int64_t strips_of(const QuadPatch& patch, const QuadFaces& faces, const DrawSize& size) {
  return size.draws - (patch.display == Display::kStrips && !corners_only(patch, faces) ? 0 : 1);
}

inline FaceSize face_size(const QuadFaces& faces, std::int32_t f, int depth, const CrackPlan& plan) {
  const std::int64_t m = faces.part_size(depth);
  const std::int64_t points = plan.display[f] == Display::kFan ? 1
                              : !faces.cut()                   ? (m - 1) * (m - 1)
                              : m > 0                          ? 1 + faces.parts(f) * m * (m - 1)
                                                               : 0;
  return {points, draw_size(QuadPatch{f, depth, plan.display[f]}, faces, plan).triangles};
}

}  // namespace limitcheck::fast
