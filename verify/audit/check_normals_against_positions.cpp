// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "verify/audit/bounds.h"
#include "verify/audit/checks.h"
#include "verify/audit/statistics.h"

namespace limitcheck::verify {
namespace {

// The unit normals of all triangles, weighted by area, at each lattice point that several triangles share.
struct Mean {
  Vector sum{};
  double shortest = std::numeric_limits<double>::infinity();  // edge at the point
};

template <class Position>
std::vector<Mean> means(const Evidence& e, Position position) {
  std::vector<Mean> mean(static_cast<std::size_t>(e.lattice.size()));
  for (std::int64_t k = 0; k < e.tessellation.triangle_count(); ++k) {
    if (!e.tessellation.triangle_ok(k)) continue;
    const auto& corner = e.tessellation.triangles()[k];
    if (std::any_of(corner.begin(), corner.end(), [&](auto v) { return e.point[v] == Lattice::kNone; }))
      continue;
    const Vector a = position(corner[0]), b = position(corner[1]), c = position(corner[2]);
    const Vector n = cross(b - a, c - a);
    const double shortest = std::min({norm(b - a), norm(c - a), norm(c - b)});
    for (const auto v : corner) {
      Mean& m = mean[e.point[v]];
      m.sum = m.sum + n;
      m.shortest = std::min(m.shortest, shortest);
    }
  }
  return mean;
}

}  // namespace

// The delivered normal against the mean of the delivered facets round the point. On the exact surface, with
// the same triangles, that angle is not zero but known: it may not be larger by more than the bound of the
// normals and the turn that the bound of the positions can give the facets, twice that bound over the
// shortest edge.
std::vector<Result> check_normals_against_positions(const Evidence& e) {
  Result r = e.result("normals-against-positions");
  r.unit = "degrees";
  if (!e.capabilities.normals || e.capabilities.points != LC_POINTS_LIMIT) {
    r.status = Status::kNotSupported;
    r.message = "delivers no limit normals";
    return {r};
  }
  const Tessellation& t = e.tessellation;
  if (!t.has_normals() || t.vertex_count() == 0) {
    r.status = Status::kNotRun;
    return {r};
  }
  const auto delivered = means(e, [&](std::uint32_t v) { return t.position(v); });
  const auto exact = means(e, [&](std::uint32_t v) { return e.reference.position(e.point[v]); });
  constexpr double kDegrees = 57.295779513082320877;
  const int depth = e.lattice.depth();
  const double normal = normal_bound(e.capabilities.precision, depth);
  const double position =
      position_bound(e.capabilities.precision, depth, e.magnitude, e.diagonal) * e.diagonal;
  std::vector<double> excess(static_cast<std::size_t>(t.vertex_count()), -1);
  r.bound = normal;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    if (id == Lattice::kNone || !e.reference.has_normal(id) || !(norm(exact[id].sum) > 0)) continue;
    const double turn = 4 * position / exact[id].shortest;
    if (!(turn < 0.1)) continue;  // slivers: the facets say nothing
    const double expected = angle_degrees(e.reference.normal(id), exact[id].sum);
    const double got = angle_degrees(t.normal(v), delivered[id].sum);
    excess[v] = std::isfinite(got) ? std::max(0.0, std::abs(got - expected) - turn * kDegrees) : got;
  }
  const Statistics s = summarise(excess, *r.bound);
  take(r, s);
  if (s.worst_at >= 0) {
    const Vector got = t.normal(s.worst_at), facets = delivered[e.point[s.worst_at]].sum;
    const double length = norm(facets);
    r.witness = e.at_vertex(s.worst_at);
    r.witness->expected = {facets[0] / length, facets[1] / length, facets[2] / length};
    r.witness->got = {got.begin(), got.end()};
  }
  return {r};
}

}  // namespace limitcheck::verify
