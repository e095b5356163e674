// SPDX-License-Identifier: MIT
// Evaluates one control face of Catmull-Clark's scheme: windows, borders and centre, as it is displayed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "fast/frame/quad_patch.h"
#include "fast/window/quad_edge.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast {

/// What a thread reuses from face to face.
template <class Real>
struct QuadWorker {
  QuadWorker(int max_depth, int max_valence)
      : window(std::max(max_depth, 1), max_valence), edge(max_depth, max_valence) {}

  QuadWindow<Real> window;
  QuadEdge<Real> edge;
  QuadBorder<Real> border;
  FacePoints<Real> points;

  std::int64_t zero_normals() const { return window.zero_normals() + edge.zero_normals(); }
};

/// Side c of a face at a depth of its own.
template <class Real>
void evaluate_side(const PreparedQuads<Real>& mesh, const QuadFaces& faces, std::int32_t c, int depth,
                   QuadEdge<Real>& edge, std::vector<SurfaceVertex<Real>>& out) {
  out.resize((std::size_t{1} << depth) + 1);
  if (!faces.cut()) {
    edge.evaluate(mesh, c, depth, out.data());
  } else if (depth == 0) {
    out = {mesh.limit(faces.vertex(c)), mesh.limit(faces.vertex(faces.next(c)))};
  } else {
    edge.evaluate(mesh, faces.first_half(c), depth - 1, out.data());
    edge.evaluate(mesh, faces.second_half(c), depth - 1, out.data() + (std::size_t{1} << (depth - 1)));
  }
}

/// The centre of a face: the limit point in its middle, or the mean of its corners, with the normal of the
/// limit.
template <class Real>
SurfaceVertex<Real> quad_centre(const PreparedQuads<Real>& mesh, const QuadFaces& faces, std::int32_t f,
                                FanCentre centre, QuadWindow<Real>& window) {
  const auto first = static_cast<std::int32_t>(faces.first[f]);
  SurfaceVertex<Real> middle;
  if (faces.cut()) {
    middle = mesh.limit(mesh.mesh().adjacency.corner(first, 2));
  } else {
    window.run(mesh, f, 1, [&](int row, const SurfaceVertex<Real>* strip) {
      if (row == 0) middle = strip[3];
    });
  }
  if (centre == FanCentre::kLimit) return middle;
  Vec3<double> sum{};
  for (int k = 0; k < faces.sides(f); ++k) {
    const std::int32_t v = faces.vertex(first + k);
    sum = sum + widen<Real>(centre == FanCentre::kFlatControl ? mesh.position(v) : mesh.limit(v).position);
  }
  middle.position = narrow<Real>(1. / faces.sides(f) * sum);
  return middle;
}

/// Evaluates one face and hands every piece to the writer.
template <class Real, class Writer>
void evaluate(const PreparedQuads<Real>& mesh, const QuadPatch& patch, const QuadFaces& faces,
              const CrackPlan& plan, FanCentre centre, QuadWorker<Real>& worker, Writer& writer) {
  using Vertex = SurfaceVertex<Real>;
  const std::int32_t f = patch.face;
  const auto first = static_cast<std::int32_t>(faces.first[f]);
  const int m = faces.part_size(patch.depth), part_depth = patch.depth - (faces.cut() ? 1 : 0);
  if (corners_only(patch, faces)) {
    writer.corners([&](int k) -> const Vertex& { return mesh.limit(faces.vertex(first + k)); });
    return;
  }
  if (patch.display == Display::kStrips) {
    for (int part = 0; part < faces.parts(f); ++part)
      worker.window.run(mesh, faces.quad(f, part), part_depth, [&](int row, const Vertex* strip) {
        writer.strip(part, row, [&](int q) -> const Vertex& { return strip[q]; });
      });
    return;
  }
  worker.border.resize(static_cast<std::size_t>(faces.sides(f)));
  for (int side = 0; side < faces.sides(f); ++side)
    evaluate_side(mesh, faces, first + side, plan.edge_depth[first + side], worker.edge, worker.border[side]);
  if (patch.display == Display::kFan) {
    writer.fan(quad_centre(mesh, faces, f, centre, worker.window), worker.border);
    return;
  }
  worker.points.resize(faces.parts(f), m);
  for (int part = 0; part < faces.parts(f); ++part) {
    worker.window.run(mesh, faces.quad(f, part), part_depth, [&](int row, const Vertex* strip) {
      for (int i = 0; i <= m; ++i) {
        worker.points.at({part, i, m - row}) = strip[2 * i];
        worker.points.at({part, i, m - row - 1}) = strip[2 * i + 1];
      }
    });
  }
  writer.stitch(worker.points, worker.border);
}

}  // namespace limitcheck::fast
