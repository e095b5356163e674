// SPDX-License-Identifier: MIT
#include "verify/audit/at_point.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>

#include "data/error.h"
#include "verify/evidence/evidence.h"
#include "verify/row/bounds.h"
#include "verify/subject/weights_option.h"

namespace limitcheck::verify {

bool AtPoint::held() const {
  return !vertices.empty() && same_bits && std::all_of(vertices.begin(), vertices.end(), [&](const auto& v) {
    return v.distance <= bound && (!v.normal || v.angle <= v.angle_bound);
  });
}

AtPoint look_at(const AuditSubject& subject, const AuditMesh& mesh, const Place& place, int threads) {
  const std::vector<std::int32_t> asked = asked_depths(mesh, mesh.depth);
  Session session(*subject.subject, mesh.mesh, subject.options, Session::Input::kValid, mesh.scheme());
  warm_up(session, mesh, mesh.depth, threads);
  const Tessellation tessellation = session.tessellate(asked, threads);
  const lc_capabilities& capabilities = session.capabilities();
  ReferenceSurface truth(session.mesh(), mesh.scheme(), mesh.depth, capabilities.points,
                         family(capabilities.weights), points_anywhere(capabilities, tessellation));
  const Lattice::Id id = truth.lattice().id(place);
  if (id == Lattice::kNone && capabilities.points_anywhere != 0)
    throw data::ArgumentError("the point is none that the subject delivers");
  if (id == Lattice::kNone)
    throw data::ArgumentError(
        fmt::format("the point is none that a subject delivers at depth {}: U and V are multiples of 1/{}",
                    mesh.depth, truth.lattice().n()));
  truth.prepare(std::array{id});
  const Evidence e = gather(subject, mesh, session, session.mesh(), asked, tessellation, truth);

  AtPoint result;
  result.refined = capabilities.points == LC_POINTS_REFINED;
  result.in_float = capabilities.precision == LC_FLOAT32;
  result.bound = e.position_bound_at(id);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Sides::Id first_side = Lattice::kNone;
  for (const Use& use : e.uses) {
    if (use.side == Lattice::kNone || truth.sides().point(use.side) != id) continue;
    VertexAtPoint& v = result.vertices.emplace_back();
    const ExactPoint* exact = result.refined ? nullptr : truth.certified(use.side);
    v.vertex = use.vertex;
    v.position = tessellation.position(use.vertex);
    v.expected = exact != nullptr ? exact->position : truth.position(id);
    v.distance = is_finite(v.position) ? norm(v.position - v.expected) / e.diagonal : kNaN;
    const std::int64_t first = result.vertices.front().vertex;
    const auto same = [](auto a, auto b) { return std::equal(a.begin(), a.end(), b.begin()); };
    result.same_bits =
        result.same_bits && same(tessellation.position_bits(first), tessellation.position_bits(use.vertex));
    if (!tessellation.has_normals() || result.refined) continue;
    v.normal = tessellation.normal(use.vertex);
    if (result.vertices.size() == 1) first_side = use.side;
    if (use.side == first_side)
      result.same_bits =
          result.same_bits && same(tessellation.normal_bits(first), tessellation.normal_bits(use.vertex));
    const bool has_normal = exact != nullptr ? exact->has_normal : truth.has_normal(use.side);
    v.angle_bound = e.normal_bound_at(use.side);
    if (has_normal) {
      v.expected_normal = exact != nullptr ? exact->normal : truth.normal(use.side);
      v.angle = angle_degrees(*v.normal, *v.expected_normal);
    }
    const double length = norm(*v.normal);
    if (!is_finite(*v.normal) || !(std::abs(length - 1) <= length_bound(capabilities.precision)))
      v.angle = kNaN;
  }
  session.close();
  return result;
}

}  // namespace limitcheck::verify
