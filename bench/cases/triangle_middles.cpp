// SPDX-License-Identifier: MIT
#include "bench/cases/triangle_middles.h"

#include "reference/surface/surface.h"
#include "verify/evidence/lattice.h"

namespace limitcheck::bench {

void each_triangle_middle(const data::ControlMesh& mesh, data::Scheme scheme,
                          const fast::DrawList<float>& frame, reference::Derivatives order,
                          const std::function<void(const TriangleMiddle&)>& with) {
  const verify::Lattice lattice(mesh, scheme, 5);
  const reference::Surface surface(mesh, scheme);
  const double thirds = 1 / (3 * static_cast<double>(lattice.scale()));
  for (const fast::Draw& draw : frame.draws) {
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      TriangleMiddle middle{&draw, t, {}, {}, {}};
      double first = 0, second = 0;
      const std::int32_t face = draw.face_of(t);
      for (const std::int32_t v : draw.triangle(t)) {
        const auto at = static_cast<std::size_t>(draw.first + v);
        const auto& [p, n] = frame.vertices[at];
        const auto& from = frame.provenance[at];
        const auto place = lattice.in_face(
            lattice.id(verify::Place{from.face, from.i, from.j, from.denominator, from.corner}), face);
        first += thirds * static_cast<double>(place->i);
        second += thirds * static_cast<double>(place->j);
        middle.position = middle.position + (1. / 3) * fast::Point3{p.x, p.y, p.z};
        middle.normal = middle.normal + fast::Point3{n.x, n.y, n.z};
      }
      middle.exact = surface.evaluate(face, 0, first, second, order);
      with(middle);
    }
  }
}

}  // namespace limitcheck::bench
