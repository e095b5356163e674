// SPDX-License-Identifier: MIT
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "verify/audit/bounds.h"
#include "verify/audit/checks.h"
#include "verify/audit/statistics.h"

namespace limitcheck::verify {
namespace {

// The spacing of numbers of this precision at the largest coordinate of a point.
double ulp_at(const Vector& point, lc_precision precision) {
  const int exponent = largest(point) > 0 ? std::ilogb(largest(point)) : -126;
  return std::ldexp(1.0, exponent - (precision == LC_FLOAT32 ? 23 : 52));
}

}  // namespace

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
  std::vector<double> error(static_cast<std::size_t>(t.vertex_count()), -1);
  tbb::parallel_for(std::size_t{0}, error.size(), [&](std::size_t v) {
    if (e.point[v] == Lattice::kNone) return;
    const Vector got = t.position(static_cast<std::int64_t>(v));
    error[v] = is_finite(got) ? norm(got - e.reference.position(e.point[v])) / e.diagonal
                              : std::numeric_limits<double>::infinity();
  });
  r.bound = position_bound(e.capabilities.precision, e.lattice.depth(), e.magnitude, e.diagonal);
  r.unit = "diagonal";
  const Statistics s = summarise(error, *r.bound);
  take(r, s);
  if (s.worst_at >= 0) {
    const Vector expected = e.reference.position(e.point[s.worst_at]), got = t.position(s.worst_at);
    r.witness = e.at_vertex(s.worst_at);
    r.witness->expected = {expected.begin(), expected.end()};
    r.witness->got = {got.begin(), got.end()};
    if (s.worst) {
      r.worst_absolute = *s.worst * e.diagonal;
      r.worst_ulps = largest(got - expected) / ulp_at(expected, e.capabilities.precision);
    }
  }
  return results;
}

}  // namespace limitcheck::verify
