// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>
#include <unordered_map>

#include "verify/checks/checks.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

// The uses of each shared point, or of each side of one, that is delivered more than once, as a finite value: each
// a part of `uses`, which are sorted.
//   uses   each vertex with a point, or with a side
template <class Value>
std::vector<std::span<const Use>> groups(const Evidence& e, std::vector<Use>& uses, Value value) {
  std::erase_if(uses, [&](const Use& use) {
    return use.side == Lattice::kNone || !e.lattice.is_shared(e.reference.sides().point(use.side)) ||
           !is_finite(value(use.vertex));
  });
  std::stable_sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.side < b.side; });
  std::vector<std::span<const Use>> several;
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last =
        std::find_if(first, uses.end(), [&](const Use& use) { return use.side != first->side; });
    if (last - first > 1) several.emplace_back(first, last);
    first = last;
  }
  return several;
}

// Compares each vertex of a group with the first one.
template <class Bits, class Value, class Distance>
void compare(const Evidence& e, std::vector<Use> uses, Bits bits, Value value, Distance distance, Result& r) {
  const std::vector<std::span<const Use>> shared = groups(e, uses, value);
  std::vector<double> far(shared.size(), 0);  // the largest distance in the group
  std::vector<std::int64_t> other(shared.size(), -1);
  tbb::parallel_for(std::size_t{0}, shared.size(), [&](std::size_t g) {
    const std::int64_t first = shared[g].front().vertex;
    const auto its = bits(first);
    for (const auto& [v, side] : shared[g].subspan(1)) {
      const auto mine = bits(v);
      if (std::equal(its.begin(), its.end(), mine.begin())) continue;
      const double d = distance(value(first), value(v));
      if (other[g] < 0 || d > far[g]) far[g] = d, other[g] = v;
    }
  });
  const Statistics s = summarise(far, 0);
  take(r, s);
  r.bound = 0;
  r.bad = std::count_if(other.begin(), other.end(), [](std::int64_t v) { return v >= 0; });
  r.message = r.of == 0 ? "every shared point is delivered once"
                        : fmt::format("{:.1f} % of the points delivered more than once differ in bits",
                                      100.0 * static_cast<double>(r.bad) / static_cast<double>(r.of));
  std::int64_t not_finite = 0;
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) not_finite += !is_finite(value(v));
  say_left_out(r, not_finite, "vectors");
  r.status = r.bad > 0 ? Status::kFinding : r.of == 0 && not_finite > 0 ? Status::kNotRun : Status::kHeld;
  if (r.bad == 0) return;
  std::size_t g = static_cast<std::size_t>(s.worst_at);
  if (other[g] < 0)  // they differ in the sign of a zero only: distance 0
    g = static_cast<std::size_t>(std::find_if(other.begin(), other.end(), [](auto v) { return v >= 0; }) -
                                 other.begin());
  const Vector expected = value(shared[g].front().vertex), got = value(other[g]);
  r.witness = e.at_vertex(other[g]);
  r.witness->show(expected, got);
}

}  // namespace

std::vector<Result> check_shared(const Evidence& e) {
  Result positions = e.result("shared-positions", "diagonal"),
         normals = e.result("shared-normals", "degrees");
  const Tessellation& t = e.tessellation;
  if (t.vertex_count() == 0) {
    positions.status = normals.status = Status::kNotRun;
    return {positions, normals};
  }
  std::vector<Use> whole;  // each vertex once, whatever its sides
  for (std::size_t v = 0; v < e.point.size(); ++v)
    whole.push_back({static_cast<std::int64_t>(v), e.point[v]});
  compare(
      e, whole, [&](auto v) { return t.position_bits(v); }, [&](auto v) { return t.position(v); },
      [&](const Vector& a, const Vector& b) { return norm(a - b) / e.diagonal; }, positions);
  if (has_normals(e, normals))
    compare(
        e, e.uses, [&](auto v) { return t.normal_bits(v); }, [&](auto v) { return t.normal(v); },
        angle_degrees, normals);
  return {positions, normals};
}

// Across control edges: what several faces say about a shared point, whatever the truth is. In units of
// twice the bound of one result, the larger of position and normal.
std::vector<Result> check_continuity(const Evidence& e) {
  Result r = e.result("continuity", "bounds", 1);
  const Tessellation& t = e.tessellation;
  const bool normals = e.capabilities.normals && t.has_normals() && e.capabilities.points == LC_POINTS_LIMIT;
  // The first vertex at each point, and of each side.
  std::unordered_map<Lattice::Id, std::int64_t> at_point;
  std::unordered_map<Sides::Id, std::int64_t> of_side;
  const auto jump_in_position = [&](const Use& use) {
    const Lattice::Id point = e.reference.sides().point(use.side);
    const std::int64_t first = at_point.at(point);
    if (first == use.vertex) return -1.0;
    const double distance = norm(t.position(use.vertex) - t.position(first));
    return distance > 0 ? distance / e.diagonal / (2 * e.position_bound_at(point))
                        : distance;  // of a mesh that is the origin the bound is 0
  };
  std::vector<double> jump(e.uses.size(), -1);
  for (std::size_t k = 0; k < e.uses.size(); ++k) {
    const auto& [vertex, side] = e.uses[k];
    const Lattice::Id point = side == Lattice::kNone ? side : e.reference.sides().point(side);
    if (point == Lattice::kNone || !e.lattice.is_shared(point) || !is_finite(t, vertex)) continue;
    at_point.emplace(point, vertex);
    const std::int64_t first = of_side.emplace(side, vertex).first->second;
    jump[k] = jump_in_position(e.uses[k]);
    if (first != vertex && normals && e.reference.has_normal(side))
      jump[k] =
          std::max(jump[k], angle_degrees(t.normal(vertex), t.normal(first)) / (2 * e.normal_bound_at(side)));
  }
  // Where the surface turns out to have no normal, the normals may jump.
  const Confirmation confirmation = confirm(
      e, jump, [&](std::size_t k) { return e.uses[k].side; }, [](std::size_t) { return 1.0; },
      [&](std::size_t k, const ExactPoint& exact) {
        return exact.has_normal ? jump[k] : jump_in_position(e.uses[k]);
      });
  std::int64_t lost = 0;  // of the vertices that count
  for (std::int64_t v = 0; v < t.vertex_count(); ++v)
    lost += e.point[v] != Lattice::kNone && e.lattice.is_shared(e.point[v]) && !is_finite(t, v);
  const Statistics s = summarise(jump, 1);
  take(r, s);
  if (s.of == 0) {
    r.message = "every shared point is delivered once";
    if (t.vertex_count() > 0 && lost == 0) r.status = Status::kHeld;
  }
  say(r, confirmation.message);
  say_left_out(r, lost, "points");
  if (s.worst_at >= 0) {
    const Use& use = e.uses[s.worst_at];
    const Vector got = t.position(use.vertex),
                 expected = t.position(at_point.at(e.reference.sides().point(use.side)));
    r.witness = e.at_use(use);
    r.witness->show(expected, got);
  }
  return {r};
}

}  // namespace limitcheck::verify
