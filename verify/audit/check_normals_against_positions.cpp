// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "verify/audit/bounds.h"
#include "verify/audit/checks.h"
#include "verify/audit/confirm.h"

namespace limitcheck::verify {
namespace {

// The area vectors (twice the area) of the triangles round a lattice point, summed.
struct Facets {
  Vector sum{};
  double sides = 0;  // of all of them
};

// At each lattice point, of the triangles whose corners were all delivered as finite points.
template <class Position>
std::vector<Facets> facets(const Evidence& e, Position position) {
  std::vector<Facets> at(e.lattice.size());
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
      Facets& f = at[e.point[v]];
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
      position_bound(e.capabilities.precision, e.lattice.depth(), e.magnitude, e.diagonal) * e.diagonal;
  const auto turn = [&](Lattice::Id id) { return 4 * position * exact[id].sides / norm(exact[id].sum); };
  const auto excess = [&](std::size_t v, const Vector& normal) {
    const Lattice::Id id = e.point[v];
    const double expected = angle_degrees(normal, exact[id].sum);
    const double got = angle_degrees(t.normal(static_cast<std::int64_t>(v)), delivered[id].sum);
    return std::isfinite(got) ? std::max(0.0, std::abs(got - expected) - turn(id) * kDegrees) : got;
  };

  std::vector<double> error(t.vertex_count(), -1);
  std::int64_t not_finite = 0;
  for (std::size_t v = 0; v < error.size(); ++v) {
    const auto k = static_cast<std::int64_t>(v);
    if (!is_finite(t, k)) {
      ++not_finite;
      continue;
    }
    const Lattice::Id id = e.point[v];
    if (id == Lattice::kNone || !e.reference.has_normal(id)) continue;
    if (turn(id) < 0.1) error[v] = excess(v, e.reference.normal(id));  // beyond, the facets say nothing
  }
  const std::int64_t at = judge_angles(
      e, error,
      [&](std::size_t v, const ExactPoint& point) {
        return point.has_normal ? excess(v, point.normal) : -1.0;
      },
      r);
  say_left_out(r, not_finite, "points");
  if (at >= 0) {
    const Vector got = t.normal(at), mean = delivered[e.point[at]].sum;
    const double length = norm(mean);
    r.witness = e.at_vertex(at);
    r.witness->expected = {mean[0] / length, mean[1] / length, mean[2] / length};
    r.witness->got = {got.begin(), got.end()};
  }
  return {r};
}

}  // namespace limitcheck::verify
