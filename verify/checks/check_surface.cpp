// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "verify/checks/checks.h"
#include "verify/evidence/evidence.h"
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
  results.push_back(e.result(limit ? "positions" : "refined-positions", "diagonal"));
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
  const auto id = [&](std::size_t v) { return e.point[v]; };
  const auto bound = [&](std::size_t v) { return e.position_bound_at(e.point[v]); };
  // Refined points are means of control points, for which double is as good as any arithmetic.
  const Confirmation confirmation =
      limit ? confirm(e, error, id, bound,
                      [&](std::size_t v, const ExactPoint& exact) { return off(v, exact.position); })
            : Confirmation{};
  // What was confirmed is not preferred to what is as bad: here certified numbers differ in the last bits only.
  std::int64_t far = -1;
  for (std::size_t v = 0; v < error.size(); ++v)
    if (error[v] >= 0 && bound(v) > e.position_bound() && !(error[v] <= bound(v)) &&
        (far < 0 || error[v] / bound(v) > error[far] / bound(far)))
      far = static_cast<std::int64_t>(v);
  const std::int64_t at = judge(error, bound, e.position_bound(), far, "at vertices of high valence", r);
  r.decades = decades(error);
  count_places(r, e.lattice, error.size(), id,
               [&](std::size_t v) { return error[v] < 0 ? -1 : static_cast<int>(!(error[v] <= bound(v))); });
  say(r, confirmation.message);
  std::int64_t not_finite = 0;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) not_finite += !is_finite(t.position(v));
  say_left_out(r, not_finite, "positions");
  if (at >= 0) {
    Vector expected = e.reference.position(e.point[at]);
    const Vector got = t.position(at);
    r.witness = e.at_vertex(at);
    if (const ExactPoint* exact = limit && is_bad(r) ? e.reference.certified(e.point[at]) : nullptr) {
      expected = exact->position;
      r.witness->expected_digits = exact->position_digits;
    }
    r.witness->show(expected, got);
    if (r.worst) {
      r.worst_absolute = *r.worst * e.diagonal;
      r.worst_ulps = largest(got - expected) / ulp_at(largest(expected), e.capabilities.precision);
    }
  }
  return results;
}

std::vector<Result> check_normals(const Evidence& e) {
  Result angle = e.result("normals"), length = e.result("normal-length");
  const Tessellation& t = e.tessellation;
  const bool any = has_normals(e, angle);
  if (!has_normals(e, length) || !any) return {angle, length};
  angle.unit = "degrees";
  length.unit = "|n| - 1";
  length.bound = length_bound(e.capabilities.precision);
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
    if (const ExactPoint* exact = is_bad(angle) ? e.reference.certified(side) : nullptr) {
      expected = exact->normal;
      angle.witness->expected_digits = exact->normal_digits;
    }
    angle.witness->show(expected, got);
  }
  // Where the surface has no normal any unit vector is accepted; the row says at how many points.
  const Statistics without = summarise(undefined, std::numeric_limits<double>::infinity());
  if (without.of > 0)
    say(angle,
        fmt::format("{} more where the surface has no normal, up to {} degrees from the reference's choice",
                    without.of, without.worst ? fmt::format("{:.3g}", *without.worst) : "infinitely many"));

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

namespace {

// The area vectors (twice the area) of the triangles round a lattice point, on one side, summed.
struct Facets {
  Vector sum{};
  double sides = 0;  // of all of them
};

// On each side of the lattice points, of the triangles whose corners were all delivered as finite points.
template <class Position>
std::vector<Facets> facets(const Evidence& e, Position position) {
  const Sides& of_points = e.reference.sides();
  std::vector<Facets> at(of_points.size());
  const Tessellation& t = e.tessellation;
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    if (!t.triangle_ok(k)) continue;
    const auto& corner = t.triangles()[k];
    if (std::any_of(corner.begin(), corner.end(),
                    [&](auto v) { return e.point[v] == Lattice::kNone || !is_finite(t.position(v)); }))
      continue;
    const Vector a = position(corner[0]), b = position(corner[1]), c = position(corner[2]);
    const Vector area = cross(b - a, c - a);
    const double sides = perimeter(a, b, c);
    for (const auto v : corner) {
      Facets& f = at[of_points.of(e.point[v], t.triangle_face()[k])];
      f.sum = f.sum + area;
      f.sides += sides;
    }
  }
  return at;
}

}  // namespace

// The delivered normal against the mean of the delivered facets round the point. On the exact surface, with
// the same triangles, that angle is not zero but known: it may not be larger by more than the bound of the
// normals and the turn that the bound of the positions can give the mean. A triangle whose corners move by s
// changes its area vector by no more than 2 s (the sum of its sides), and here s is the bound once for the
// subject and, generously, once for the reference.
std::vector<Result> check_normals_against_positions(const Evidence& e) {
  Result r = e.result("normals-against-positions", "degrees");
  if (!has_normals(e, r, true)) return {r};
  const Tessellation& t = e.tessellation;
  const auto delivered = facets(e, [&](std::uint32_t v) { return t.position(v); });
  const auto exact = facets(e, [&](std::uint32_t v) { return e.reference.position(e.point[v]); });
  const Sides& of_points = e.reference.sides();
  constexpr double kDegrees = 57.295779513082320877;
  const auto turn = [&](Sides::Id id) {
    const double position = e.position_bound_at(of_points.point(id)) * e.diagonal;
    return 4 * position * exact[id].sides / norm(exact[id].sum);
  };
  const auto excess = [&](std::size_t k, const Vector& normal) {
    const auto [vertex, id] = e.uses[k];
    const double expected = angle_degrees(normal, exact[id].sum);
    const double got = angle_degrees(t.normal(vertex), delivered[id].sum);
    return std::isfinite(got) ? std::max(0.0, std::abs(got - expected) - turn(id) * kDegrees) : got;
  };

  std::vector<double> error(e.uses.size(), -1);
  for (std::size_t k = 0; k < error.size(); ++k) {
    const auto [vertex, id] = e.uses[k];
    if (id == Lattice::kNone || !is_finite(t, vertex) || !e.reference.has_normal(id)) continue;
    if (turn(id) < 0.1) error[k] = excess(k, e.reference.normal(id));  // beyond, the facets say nothing
  }
  const std::int64_t at = judge_angles(
      e, error,
      [&](std::size_t k, const ExactPoint& point) {
        return point.has_normal ? excess(k, point.normal) : -1.0;
      },
      r);
  say_left_out(r, not_finite(t), "points");
  if (at >= 0) {
    const auto [vertex, id] = e.uses[at];
    const Vector got = t.normal(vertex), mean = delivered[id].sum;
    const double length = norm(mean);
    r.witness = e.at_use(e.uses[at]);
    r.witness->expected = {mean[0] / length, mean[1] / length, mean[2] / length};
    r.witness->got = {got.begin(), got.end()};
  }
  return {r};
}

}  // namespace limitcheck::verify
