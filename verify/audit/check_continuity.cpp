// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>

#include "verify/audit/bounds.h"
#include "verify/audit/checks.h"
#include "verify/audit/confirm.h"
#include "verify/audit/statistics.h"

namespace limitcheck::verify {

// Across control edges: what several faces say about a shared point, whatever the truth is. In units of
// twice the bound of one result, the larger of position and normal.
std::vector<Result> check_continuity(const Evidence& e) {
  Result r = e.result("continuity");
  const Tessellation& t = e.tessellation;
  r.unit = "bounds";
  r.bound = 1;
  const double position =
      2 * position_bound(e.capabilities.precision, e.lattice.depth(), e.magnitude, e.diagonal);
  const bool normals = e.capabilities.normals && t.has_normals() && e.capabilities.points == LC_POINTS_LIMIT;
  std::unordered_map<Lattice::Id, std::int64_t> first;
  const auto jump_in_position = [&](std::int64_t v) {
    return norm(t.position(v) - t.position(first.at(e.point[v]))) / e.diagonal / position;
  };
  std::vector<double> jump(t.vertex_count(), -1);
  std::int64_t not_finite = 0;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    if (id == Lattice::kNone || !e.lattice.is_shared(id)) continue;
    if (!is_finite(t, v)) {
      ++not_finite;
      continue;
    }
    const auto [at, is_new] = first.emplace(id, v);
    if (is_new) continue;
    jump[v] = jump_in_position(v);
    if (normals && e.reference.has_normal(id))
      jump[v] =
          std::max(jump[v], angle_degrees(t.normal(v), t.normal(at->second)) / (2 * e.normal_bound_at(id)));
  }
  // Where the surface turns out to have no normal, the normals may jump.
  const Confirmation confirmation = confirm(
      e, jump, [](std::size_t) { return 1.0; },
      [&](std::size_t v, const ExactPoint& exact) {
        return exact.has_normal ? jump[v] : jump_in_position(static_cast<std::int64_t>(v));
      });
  const Statistics s = summarise(jump, 1);
  take(r, s);
  if (s.of == 0) {
    r.message = "every shared point is delivered once";
    if (t.vertex_count() > 0 && not_finite == 0) r.status = Status::kHeld;
  }
  say(r, confirmation.message);
  say_left_out(r, not_finite, "points");
  if (s.worst_at >= 0) {
    const Vector got = t.position(s.worst_at), expected = t.position(first[e.point[s.worst_at]]);
    r.witness = e.at_vertex(s.worst_at);
    r.witness->expected = {expected.begin(), expected.end()};
    r.witness->got = {got.begin(), got.end()};
  }
  return {r};
}

}  // namespace limitcheck::verify
