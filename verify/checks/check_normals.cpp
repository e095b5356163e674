// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "verify/checks/checks.h"
#include "verify/checks/confirm.h"
#include "verify/evidence/place_counts.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {

std::vector<Result> check_normals(const Evidence& e) {
  Result angle = e.result("normals"), length = e.result("normal-length");
  const Tessellation& t = e.tessellation;
  if (!e.capabilities.normals) {
    for (Result* r : {&angle, &length}) {
      r->status = Status::kNotSupported;
      r->message = "delivers no limit normals";
    }
    return {angle, length};
  }
  if (!t.has_normals()) {
    angle.status = length.status = Status::kNotRun;
    return {angle, length};
  }

  const std::size_t count = static_cast<std::size_t>(t.vertex_count());
  std::vector<double> angles(e.uses.size(), -1), undefined(e.uses.size(), -1), lengths(count, -1);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
    const Vector got = t.normal(static_cast<std::int64_t>(v));
    if (is_finite(got)) lengths[v] = std::abs(norm(got) - 1);
  });
  tbb::parallel_for(std::size_t{0}, e.uses.size(), [&](std::size_t k) {
    const auto [vertex, side] = e.uses[k];
    const Vector got = t.normal(vertex);
    if (!is_finite(got) || side == Lattice::kNone || e.capabilities.points != LC_POINTS_LIMIT) return;
    (e.reference.has_normal(side) ? angles : undefined)[k] = angle_degrees(got, e.reference.normal(side));
  });

  angle.unit = "degrees";
  const std::int64_t at = judge_angles(
      e, angles,
      [&](std::size_t k, const ExactPoint& exact) {
        const double off = angle_degrees(t.normal(e.uses[k].vertex), exact.normal);
        if (exact.has_normal) return off;
        undefined[k] = off;
        return -1.0;
      },
      angle);
  angle.decades = decades(angles);
  const auto point_of = [&](std::size_t k) {
    const Sides::Id side = e.uses[k].side;
    return side == Lattice::kNone ? side : e.reference.sides().point(side);
  };
  count_places(angle, e.lattice, angles.size(), point_of, [&](std::size_t k) {
    return angles[k] < 0 ? -1 : static_cast<int>(!(angles[k] <= e.normal_bound_at(e.uses[k].side)));
  });
  if (at >= 0) {
    const auto [vertex, side] = e.uses[at];
    const Vector got = t.normal(vertex);
    Vector expected = e.reference.normal(side);
    angle.witness = e.at_use(e.uses[at]);
    if (const ExactPoint* exact = is_bad(angle) ? e.reference.certified().at(side) : nullptr) {
      expected = exact->normal;
      angle.witness->expected_digits = exact->normal_digits;
    }
    angle.witness->expected = {expected.begin(), expected.end()};
    angle.witness->got = {got.begin(), got.end()};
  }
  // Where the surface has no normal any unit vector is accepted; the row says at how many points.
  const Statistics without = summarise(undefined, std::numeric_limits<double>::infinity());
  if (without.of > 0)
    say(angle,
        fmt::format("{} more where the surface has no normal, up to {} degrees from the reference's choice",
                    without.of, without.worst ? fmt::format("{:.3g}", *without.worst) : "infinitely many"));

  length.unit = "|n| - 1";
  length.bound = length_bound(e.capabilities.precision);
  const Statistics l = summarise(lengths, *length.bound);
  take(length, l);
  if (l.worst_at >= 0) {
    const Vector got = t.normal(l.worst_at);
    length.witness = e.at_vertex(l.worst_at);
    length.witness->got = {got.begin(), got.end()};
  }
  const auto not_finite = std::count_if(lengths.begin(), lengths.end(), [](double x) { return x < 0; });
  for (Result* r : {&angle, &length}) say_left_out(*r, not_finite, "normals");
  return {angle, length};
}

}  // namespace limitcheck::verify
