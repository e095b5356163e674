// SPDX-License-Identifier: MIT
// What becomes of one control face of Catmull-Clark's scheme in a frame, and the room it takes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fast/frame/crack_stitch.h"
#include "fast/frame/frame_engine.h"
#include "fast/plan/quad_faces.h"

namespace limitcheck::fast {

/// A face that is displayed.
struct QuadPatch {
  std::int32_t face = -1;
  int depth = 0;
  Display display = Display::kNothing;
};

/// The corners of a face by themselves: what a face that was cut shows at depth 0.
inline bool corners_only(const QuadPatch& patch, const QuadFaces& faces) {
  return patch.display == Display::kStrips && faces.part_size(patch.depth) == 0;
}

/// The border of a repaired face: limit vertices along each of its sides, from corner to corner.
template <class Real>
using QuadBorder = std::vector<std::vector<SurfaceVertex<Real>>>;

/// All points of a face: part by part, row by row from v = 0.
template <class Real>
struct FacePoints {
  std::vector<SurfaceVertex<Real>> points;
  int size = 0;  // cells along a side of a part

  void resize(int parts, int cells) {
    size = cells;
    points.resize(static_cast<std::size_t>(parts) * static_cast<std::size_t>((cells + 1) * (cells + 1)));
  }
  SurfaceVertex<Real>& at(PartPoint p) {
    return points[static_cast<std::size_t>((p.part * (size + 1) + p.j) * (size + 1) + p.i)];
  }
  const SurfaceVertex<Real>& at(PartPoint p) const {
    return points[static_cast<std::size_t>((p.part * (size + 1) + p.j) * (size + 1) + p.i)];
  }
};

/// The cells of a stitched face that are displayed by themselves: of each part `from` to `to` in both
/// directions. The outer ring is left out.
struct InnerCells {
  InnerCells(const QuadPatch& patch, const QuadFaces& faces)
      : from(1), to(faces.part_size(patch.depth) - (faces.cut() ? 0 : 1)) {}
  int count() const { return to - from; }
  int from, to;
};

/// Points on the border of a repaired face.
inline std::int64_t border_points(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  std::int64_t border = 0;
  for (std::size_t c = faces.first[patch.face]; c < faces.first[patch.face + 1]; ++c)
    border += std::int64_t{1} << plan.edge_depth[c];
  return border;
}

/// Triangles of a face, and the room that it takes in a draw list.
inline DrawSize quad_draw_size(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  const std::int64_t parts = faces.parts(patch.face), m = faces.part_size(patch.depth),
                     sides = faces.sides(patch.face);
  if (corners_only(patch, faces)) return {sides, 1, sides - 2};
  const std::int64_t border = border_points(patch, faces, plan);
  switch (patch.display) {
    case Display::kStrips:
      return {parts * m * 2 * (m + 1), parts * m, parts * 2 * m * m};
    case Display::kFan:
      return {border + 2, 1, border};
    case Display::kStitch: {
      const std::int64_t inner = InnerCells(patch, faces).count(),
                         ring = border + sides * ((std::int64_t{1} << patch.depth) - 2);
      return {parts * inner * 2 * (inner + 1) + 3 * ring, parts * inner + 1,
              parts * 2 * inner * inner + ring};
    }
    default:
      return {};
  }
}

/// The number of limit points evaluated for a face: rows, each once, the border of a repaired face, its
/// centre.
inline std::int64_t quad_limit_points(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan) {
  const std::int64_t parts = faces.parts(patch.face), m = faces.part_size(patch.depth);
  if (corners_only(patch, faces)) return 0;
  std::int64_t points = 0;
  if (patch.display != Display::kFan) points += parts * (m + 1) * (m + 1);
  if (patch.display != Display::kStrips) points += border_points(patch, faces, plan);
  return points + (patch.display == Display::kFan ? 1 : 0);
}

}  // namespace limitcheck::fast
