// SPDX-License-Identifier: MIT
// A heat map of errors beside the control mesh that it belongs to.
#include <array>
#include <cmath>
#include <map>

#include "bench/reproduction/studio.h"
#include "bench/reproduction/triangle_errors.h"
#include "data/bounding_box.h"

namespace limitcheck::bench {

namespace {

/// The control mesh itself as triangles with normals of their own.
fast::DrawList<float> control_triangles(const data::ControlMesh& mesh) {
  fast::DrawList<float> list;
  for (const auto& t : triangles_of(mesh)) {
    std::array<fast::Point3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = fast::to_point(mesh.positions[t[k]]);
    fast::Point3 n = cross(p[1] - p[0], p[2] - p[0]);
    n = (1 / length(n)) * n;
    for (const auto& q : p)
      list.vertices.push_back({{static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)},
                               {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)}});
  }
  list.draws.push_back(
      {0, static_cast<std::int32_t>(list.vertices.size()), 0, 0, 0, fast::DrawMode::kTriangles});
  return list;
}

}  // namespace

Image error_beside_control_mesh() {
  Studio studio = bumpy(200);
  const fast::Camera front = camera_at(20, 4.3);
  fast::TessellatorOptions options;
  options.provenance = true;
  fast::Tessellator<float> engine(studio.mesh(), options);
  fast::DrawList<float> frame, painted;
  engine.frame(verify::uniform(2), front, frame);
  // A draw for each triangle, so that each has its colour; logarithmic, four decades down from 1 % of the
  // diagonal.
  std::map<std::int64_t, Colour> colour;
  const double most = .01 * data::box_diagonal(studio.mesh());
  each_triangle_error(studio.mesh(), frame, [&](const TriangleError& error) {
    const auto first = static_cast<std::int64_t>(painted.vertices.size());
    for (const std::int32_t v : error.draw->triangle(error.triangle))
      painted.vertices.push_back(frame.vertices[error.draw->first + v]);
    painted.draws.push_back(
        {first, 3, 1, error.draw->face_of(error.triangle), -1, fast::DrawMode::kTriangles});
    colour[first] = heat(1 + std::log10(std::max(error.position, 1e-12) / most) / 2);
  });
  Appearance control, map;
  control.wireframe = true;
  map.wireframe = true;
  map.colour = [&](const fast::Draw& draw) { return colour.at(draw.first); };
  return beside(
      {studio.shot(control_triangles(studio.mesh()), front, control), studio.shot(painted, front, map)});
}

}  // namespace limitcheck::bench
