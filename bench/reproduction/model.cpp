// SPDX-License-Identifier: MIT
// A tessellation for the report's view in three dimensions.
#include <algorithm>
#include <vector>

#include "bench/reproduction/base64.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "bench/reproduction/triangle_errors.h"
#include "data/bounding_box.h"
#include "data/generators/bumpy_sphere.h"

namespace limitcheck::bench {

nlohmann::ordered_json model() {
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  fast::DepthOptions depth;
  depth.strategy = fast::Strategy::kCombined;
  depth.cull = false;
  const auto frame = frame_seen(mesh, depth);

  const double diagonal = data::box_diagonal(mesh);

  std::vector<float> positions, normals, position_error, normal_error;
  std::vector<int> depths, kinds;
  float worst_position = 0, worst_normal = 0;
  each_triangle_error(mesh, frame, [&](const TriangleError& error) {
    for (const std::int32_t v : error.draw->triangle(error.triangle)) {
      const auto& vertex = frame.vertices[error.draw->first + v];
      positions.insert(positions.end(), {vertex.position.x, vertex.position.y, vertex.position.z});
      normals.insert(normals.end(), {vertex.normal.x, vertex.normal.y, vertex.normal.z});
    }
    position_error.push_back(static_cast<float>(error.position / diagonal));
    normal_error.push_back(static_cast<float>(error.normal));
    worst_position = std::max(worst_position, position_error.back());
    worst_normal = std::max(worst_normal, normal_error.back());
    depths.push_back(error.draw->depth);
    kinds.push_back(static_cast<int>(error.draw->kind));
  });
  return {{"positions", base64(positions)},
          {"normals", base64(normals)},
          {"position_error", base64(position_error)},
          {"normal_error", base64(normal_error)},
          {"worst_position", worst_position},
          {"worst_normal", worst_normal},
          {"depth", depths},
          {"kind", kinds}};
}

}  // namespace limitcheck::bench
