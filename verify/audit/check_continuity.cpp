// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "verify/audit/bounds.h"
#include "verify/audit/checks.h"
#include "verify/audit/statistics.h"

namespace limitcheck::verify {

// Across control edges: what several faces say about a shared point, whatever the truth is. In units of
// twice the bound of one result, the larger of position and normal.
std::vector<Result> check_continuity(const Evidence& e) {
  Result r = e.result("continuity");
  const Tessellation& t = e.tessellation;
  r.unit = "bounds";
  r.bound = 1;
  const int depth = e.lattice.depth();
  const double position = 2 * position_bound(e.capabilities.precision, depth, e.magnitude, e.diagonal);
  const double normal = 2 * normal_bound(e.capabilities.precision, depth);
  const bool normals = e.capabilities.normals && t.has_normals() && e.capabilities.points == LC_POINTS_LIMIT;
  std::unordered_map<Lattice::Id, std::int64_t> first;
  std::vector<double> jump(static_cast<std::size_t>(t.vertex_count()), -1);
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    if (id == Lattice::kNone || !e.lattice.is_shared(id)) continue;
    const auto [at, is_new] = first.emplace(id, v);
    if (is_new) continue;
    double& j = jump[v];
    j = norm(t.position(v) - t.position(at->second)) / e.diagonal / position;
    if (normals && e.reference.has_normal(id)) {
      const double angle = angle_degrees(t.normal(v), t.normal(at->second)) / normal;
      j = std::max(j, angle);
    }
    if (std::isnan(j)) j = std::numeric_limits<double>::infinity();
  }
  const Statistics s = summarise(jump, 1);
  take(r, s);
  if (s.of == 0) {
    r.message = "every shared point is delivered once";
    if (t.vertex_count() > 0) r.status = Status::kHeld;
  }
  if (s.worst_at >= 0) {
    const Vector got = t.position(s.worst_at), expected = t.position(first[e.point[s.worst_at]]);
    r.witness = e.at_vertex(s.worst_at);
    r.witness->expected = {expected.begin(), expected.end()};
    r.witness->got = {got.begin(), got.end()};
  }
  return {r};
}

}  // namespace limitcheck::verify
