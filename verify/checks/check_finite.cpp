// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include "verify/checks/checks.h"
#include "verify/evidence/place_counts.h"
#include "verify/evidence/vector.h"

namespace limitcheck::verify {

std::vector<Result> check_finite(const Evidence& e) {
  Result r = e.result("finite");
  r.unit = "vectors";
  r.bound = 0;
  const Tessellation& t = e.tessellation;
  std::int64_t positions = 0, normals = 0;
  const auto look = [&](std::int64_t v, const Vector& value, std::int64_t& count) {
    if (is_finite(value)) return;
    ++count;
    if (r.witness) return;
    r.witness = e.at_vertex(v);
    r.witness->got = {value.begin(), value.end()};
  };
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    if (!t.position_unwritten(v)) look(v, t.position(v), positions);
    if (t.has_normals() && !t.normal_unwritten(v)) look(v, t.normal(v), normals);
  }
  r.of = t.vertex_count() * (t.has_normals() ? 2 : 1);
  r.bad = positions + normals;
  if (r.of == 0) r.status = Status::kNotRun;
  if (r.bad > 0) {
    r.status = Status::kFinding;
    r.message = fmt::format("{} positions and {} normals are NaN or infinite", positions, normals);
  }
  count_places(
      r, e.lattice, e.point.size(), [&](std::size_t v) { return e.point[v]; },
      [&](std::size_t v) { return static_cast<int>(!is_finite(t, static_cast<std::int64_t>(v))); });
  return {r};
}

}  // namespace limitcheck::verify
