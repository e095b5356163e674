// SPDX-License-Identifier: MIT
// A tessellation for the report's view in three dimensions.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/reproduction/base64.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/bounding_box.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/frame.h"
#include "reference/stam.h"
#include "verify/audit/lattice.h"

namespace limitcheck::bench {

nlohmann::ordered_json model() {
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  fast::DepthOptions depth;
  depth.strategy = fast::Strategy::kCombined;
  depth.cull = false;
  const auto frame = frame_seen(mesh, depth);

  const verify::Lattice lattice(mesh, 5);
  const reference::StamEvaluator<double> surface(mesh);
  const auto scale = static_cast<double>(lattice.scale());
  const double diagonal = data::box_diagonal(mesh);

  std::vector<float> positions, normals, position_error, normal_error;
  std::vector<int> depths, kinds;
  float worst_position = 0, worst_normal = 0;
  for (const fast::Draw& draw : frame.draws) {
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      double l1 = 0, l2 = 0;
      fast::Point3 flat{}, mean{};
      const std::int32_t face = draw.face_of(t);
      for (const std::int32_t v : draw.triangle(t)) {
        const auto at = static_cast<std::size_t>(draw.first + v);
        const auto& vertex = frame.vertices[at];
        const auto& from = frame.provenance[at];
        const auto place = lattice.in_face(lattice.id({from.face, from.i, from.j, from.denominator}), face);
        l1 += static_cast<double>(place->i) / scale / 3;
        l2 += static_cast<double>(place->j) / scale / 3;
        const fast::Point3 p{vertex.position.x, vertex.position.y, vertex.position.z},
            n{vertex.normal.x, vertex.normal.y, vertex.normal.z};
        flat = flat + (1. / 3) * p, mean = mean + n;
        positions.insert(positions.end(), {vertex.position.x, vertex.position.y, vertex.position.z});
        normals.insert(normals.end(), {vertex.normal.x, vertex.normal.y, vertex.normal.z});
      }
      // In the middle: the drawn point and the interpolated normal against the exact ones.
      const auto exact = surface.evaluate(static_cast<std::size_t>(face), l1, l2);
      const fast::Point3 p{exact.position.x, exact.position.y, exact.position.z},
          n{exact.normal.x, exact.normal.y, exact.normal.z};
      const double angle = std::atan2(length(cross(n, mean)), dot(n, mean)) * 180 / std::numbers::pi;
      position_error.push_back(static_cast<float>(length(flat - p) / diagonal));
      normal_error.push_back(static_cast<float>(angle));
      worst_position = std::max(worst_position, position_error.back());
      worst_normal = std::max(worst_normal, normal_error.back());
      depths.push_back(draw.depth);
      kinds.push_back(static_cast<int>(draw.kind));
    }
  }
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
