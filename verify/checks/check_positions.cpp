// SPDX-License-Identifier: MIT
#include <tbb/parallel_for.h>

#include "verify/checks/checks.h"
#include "verify/checks/confirm.h"
#include "verify/evidence/place_counts.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
std::vector<Result> check_positions(const Evidence& e) {
  const bool limit = e.capabilities.points == LC_POINTS_LIMIT;
  std::vector<Result> results;
  if (!limit) {
    results.push_back(e.result("positions"));
    results.back().status = Status::kNotSupported;
    results.back().message = "delivers vertices of the refined control mesh, no limit points";
  }
  results.push_back(e.result(limit ? "positions" : "refined-positions"));
  Result& r = results.back();

  const Tessellation& t = e.tessellation;
  std::vector<double> error(t.vertex_count(), -1);
  const auto off = [&](std::size_t v, const Vector& exact) {
    return norm(t.position(static_cast<std::int64_t>(v)) - exact) / e.diagonal;
  };
  tbb::parallel_for(std::size_t{0}, error.size(), [&](std::size_t v) {
    if (e.point[v] == Lattice::kNone || !is_finite(t.position(static_cast<std::int64_t>(v)))) return;
    error[v] = off(v, e.reference.position(e.point[v]));
  });
  r.bound = position_bound(e.capabilities.precision, e.reference.steps(), e.magnitude, e.diagonal);
  r.unit = "diagonal";
  // Refined points are means of control points, for which double is as good as any arithmetic.
  const Confirmation confirmation =
      limit ? confirm(
                  e, error, [&](std::size_t v) { return e.point[v]; }, [&](std::size_t) { return *r.bound; },
                  [&](std::size_t v, const ExactPoint& exact) { return off(v, exact.position); })
            : Confirmation{};
  const Statistics s = summarise(error, *r.bound);
  take(r, s);
  r.decades = decades(error);
  count_places(
      r, e.lattice, error.size(), [&](std::size_t v) { return e.point[v]; },
      [&](std::size_t v) { return error[v] < 0 ? -1 : static_cast<int>(!(error[v] <= *r.bound)); });
  say(r, confirmation.message);
  std::int64_t not_finite = 0;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) not_finite += !is_finite(t.position(v));
  say_left_out(r, not_finite, "positions");
  if (s.worst_at >= 0) {
    Vector expected = e.reference.position(e.point[s.worst_at]);
    const Vector got = t.position(s.worst_at);
    r.witness = e.at_vertex(s.worst_at);
    if (const ExactPoint* exact =
            limit && is_bad(r) ? e.reference.certified().at(e.point[s.worst_at]) : nullptr) {
      expected = exact->position;
      r.witness->expected_digits = exact->position_digits;
    }
    r.witness->expected = {expected.begin(), expected.end()};
    r.witness->got = {got.begin(), got.end()};
    if (s.worst) {
      r.worst_absolute = *s.worst * e.diagonal;
      r.worst_ulps = largest(got - expected) / ulp_at(largest(expected), e.capabilities.precision);
    }
  }
  return results;
}

}  // namespace limitcheck::verify
