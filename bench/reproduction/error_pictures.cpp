// SPDX-License-Identifier: MIT
// Cracks and what becomes of them, the centres of fans, and a heat map of errors beside its control mesh.
#include <algorithm>
#include <cmath>
#include <map>

#include "bench/reproduction/studio.h"
#include "data/bounding_box.h"
#include "data/shapes.h"

namespace limitcheck::bench {

namespace {

Image cracks_close_up(fast::Repair repair) {
  Studio studio = bumpy(200);
  fast::Camera close = camera_at(58, 2.3);
  close.target = {.45, .2, .35};
  const fast::DepthOptions unequal{.strategy = fast::Strategy::kCustom,
                                   .custom = [](std::int32_t face) { return face % 3 == 0 ? 4 : 1; }};
  return studio.shot(studio.frame(unequal, close, {.repair = repair}), close, with_inside());
}

}  // namespace

Image cracks_and_repair() {
  return beside({cracks_close_up(fast::Repair::kNone), cracks_close_up(fast::Repair::kFan)});
}

Image fan_centres() {
  Studio studio(data::icosahedron());
  // Two faces of depth 1, which become a pair, amid depth 3: two fans.
  const data::Faces& faces = studio.mesh().faces;
  const auto common = [&](std::int32_t face) {
    int corners = 0;
    for (const std::int32_t v : faces[face])
      corners += static_cast<int>(std::count(faces[0].begin(), faces[0].end(), v));
    return corners;
  };
  std::int32_t other = 1;
  while (common(other) != 2) ++other;
  const auto depth = [other](std::int32_t face) { return face == 0 || face == other ? 1 : 3; };
  const fast::DepthOptions one{.strategy = fast::Strategy::kCustom, .custom = depth};
  fast::Point3 middle{};
  for (const std::int32_t v : faces[0])
    middle = middle + (1. / 3) * fast::to_point(studio.mesh().positions[v]);
  const fast::Point3 outward = (1 / length(middle)) * middle;
  const fast::Point3 side = [&] {
    const fast::Point3 s = cross(fast::Point3{0, 1, 0}, outward);
    return (1 / length(s)) * s;
  }();
  fast::Camera near = camera_at(0, 1);
  near.target = .85 * middle;
  near.eye = near.target + .9 * outward + .9 * side;
  const auto with = [&](fast::FanCentre centre) {
    Appearance appearance = by_depth(true);
    appearance.flat = true;
    return studio.shot(studio.frame(one, near, {.centre = centre}), near, appearance);
  };
  return beside({with(fast::FanCentre::kFlatLimit), with(fast::FanCentre::kLimit)});
}

Image error_beside_control_mesh() {
  Studio studio = bumpy(200);
  const fast::Camera front = camera_at(20, 4.3);
  const fast::DrawList<float> frame = frame_seen(studio.mesh(), verify::uniform(2), front);
  fast::DrawList<float> map;
  // A draw for each triangle, so that each has its colour; logarithmic, four decades down from 1 % of the
  // diagonal.
  std::map<std::int64_t, Colour> colour;
  const double most = .01 * data::box_diagonal(studio.mesh());
  each_triangle_error(studio.mesh(), frame, [&](const TriangleError& error) {
    const auto first = static_cast<std::int64_t>(map.vertices.size());
    for (const std::int32_t v : error.draw->triangle(error.triangle))
      map.vertices.push_back(frame.vertices[error.draw->first + v]);
    map.draws.push_back({first, 3, 1, error.draw->face_of(error.triangle), -1, fast::DrawMode::kTriangles});
    colour[first] = heat(1 + std::log10(std::max(error.position, 1e-12) / most) / 2);
  });
  return beside({studio.shot(flat_faces(studio.mesh()), front, {.wireframe = true}),
                 studio.shot(map, front, {.colour = painted(colour), .wireframe = true})});
}

}  // namespace limitcheck::bench
