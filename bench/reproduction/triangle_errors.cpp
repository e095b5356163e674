// SPDX-License-Identifier: MIT
#include "bench/reproduction/triangle_errors.h"

#include <cmath>
#include <numbers>

#include "fast/mesh/vec3.h"
#include "reference/loop/stam.h"
#include "verify/evidence/lattice.h"

namespace limitcheck::bench {

void each_triangle_error(const data::ControlMesh& mesh, const fast::DrawList<float>& frame,
                         const std::function<void(const TriangleError&)>& with) {
  const verify::Lattice lattice(mesh, 5);
  const reference::StamEvaluator<double> surface(mesh);
  const auto scale = static_cast<double>(lattice.scale());
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
      }
      const auto exact = surface.evaluate(static_cast<std::size_t>(face), l1, l2);
      const fast::Point3 p{exact.position.x, exact.position.y, exact.position.z},
          n{exact.normal.x, exact.normal.y, exact.normal.z};
      const double angle = std::atan2(length(cross(n, mean)), dot(n, mean)) * 180 / std::numbers::pi;
      with({&draw, t, length(flat - p), angle});
    }
  }
}

}  // namespace limitcheck::bench
