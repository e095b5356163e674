// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "verify/checks/checks.h"
#include "verify/checks/confirm.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {
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
  Result r = e.result("normals-against-positions");
  r.unit = "degrees";
  if (!e.capabilities.normals || e.capabilities.points != LC_POINTS_LIMIT) {
    r.status = Status::kNotSupported;
    r.message = "delivers no limit normals";
    return {r};
  }
  const Tessellation& t = e.tessellation;
  if (!t.has_normals()) {
    r.status = Status::kNotRun;
    return {r};
  }
  const auto delivered = facets(e, [&](std::uint32_t v) { return t.position(v); });
  const auto exact = facets(e, [&](std::uint32_t v) { return e.reference.position(e.point[v]); });
  constexpr double kDegrees = 57.295779513082320877;
  const double position =
      position_bound(e.capabilities.precision, e.reference.steps(), e.magnitude, e.diagonal) * e.diagonal;
  const auto turn = [&](Sides::Id id) { return 4 * position * exact[id].sides / norm(exact[id].sum); };
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
