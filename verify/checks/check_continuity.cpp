// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>

#include "verify/checks/checks.h"
#include "verify/checks/confirm.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

// Across control edges: what several faces say about a shared point, whatever the truth is. In units of
// twice the bound of one result, the larger of position and normal.
std::vector<Result> check_continuity(const Evidence& e) {
  Result r = e.result("continuity");
  const Tessellation& t = e.tessellation;
  r.unit = "bounds";
  r.bound = 1;
  const double position =
      2 * position_bound(e.capabilities.precision, e.reference.steps(), e.magnitude, e.diagonal);
  const bool normals = e.capabilities.normals && t.has_normals() && e.capabilities.points == LC_POINTS_LIMIT;
  // The first vertex at each point, and of each side.
  std::unordered_map<Lattice::Id, std::int64_t> at_point;
  std::unordered_map<Sides::Id, std::int64_t> of_side;
  const auto jump_in_position = [&](const Use& use) {
    const std::int64_t first = at_point.at(e.reference.sides().point(use.side));
    if (first == use.vertex) return -1.0;
    const double distance = norm(t.position(use.vertex) - t.position(first));
    return distance > 0 ? distance / e.diagonal / position
                        : distance;  // of a mesh that is the origin the bound is 0
  };
  std::vector<double> jump(e.uses.size(), -1);
  for (std::size_t k = 0; k < e.uses.size(); ++k) {
    const auto& [vertex, side] = e.uses[k];
    const Lattice::Id point = side == Lattice::kNone ? side : e.reference.sides().point(side);
    if (point == Lattice::kNone || !e.lattice.is_shared(point) || !is_finite(t, vertex)) continue;
    at_point.emplace(point, vertex);
    const std::int64_t first = of_side.emplace(side, vertex).first->second;
    jump[k] = jump_in_position(e.uses[k]);
    if (first != vertex && normals && e.reference.has_normal(side))
      jump[k] =
          std::max(jump[k], angle_degrees(t.normal(vertex), t.normal(first)) / (2 * e.normal_bound_at(side)));
  }
  // Where the surface turns out to have no normal, the normals may jump.
  const Confirmation confirmation = confirm(
      e, jump, [&](std::size_t k) { return e.uses[k].side; }, [](std::size_t) { return 1.0; },
      [&](std::size_t k, const ExactPoint& exact) {
        return exact.has_normal ? jump[k] : jump_in_position(e.uses[k]);
      });
  std::int64_t lost = 0;  // of the vertices that count
  for (std::int64_t v = 0; v < t.vertex_count(); ++v)
    lost += e.point[v] != Lattice::kNone && e.lattice.is_shared(e.point[v]) && !is_finite(t, v);
  const Statistics s = summarise(jump, 1);
  take(r, s);
  if (s.of == 0) {
    r.message = "every shared point is delivered once";
    if (t.vertex_count() > 0 && lost == 0) r.status = Status::kHeld;
  }
  say(r, confirmation.message);
  say_left_out(r, lost, "points");
  if (s.worst_at >= 0) {
    const Use& use = e.uses[s.worst_at];
    const Vector got = t.position(use.vertex),
                 expected = t.position(at_point.at(e.reference.sides().point(use.side)));
    r.witness = e.at_use(use);
    r.witness->expected = {expected.begin(), expected.end()};
    r.witness->got = {got.begin(), got.end()};
  }
  return {r};
}

}  // namespace limitcheck::verify
