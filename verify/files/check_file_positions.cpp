// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "verify/audit/bounds.h"
#include "verify/audit/statistics.h"
#include "verify/files/file_evidence.h"

namespace limitcheck::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::vector<double> list(const Vector& v) {
  return {v.begin(), v.end()};
}

// Errors of vertices (negative: not looked at) as a row; `expected(vertex)` is for the witness.
template <class Expected>
Result row(const FileEvidence& e, const char* check, const std::vector<double>& error, Expected&& expected) {
  Result r = e.result(check);
  r.unit = "diagonal";
  r.bound = e.tolerance;
  const Statistics s = summarise(error, e.tolerance);
  take(r, s);
  if (s.worst_at >= 0) {
    const auto vertex = static_cast<std::int32_t>(s.worst_at);
    r.witness = e.at_vertex(vertex);
    r.witness->expected = list(expected(vertex));
    r.witness->got = list(e.tessellation.positions[vertex]);
    if (s.worst) r.worst_absolute = *s.worst * e.surface.diagonal();
  }
  return r;
}

}  // namespace

std::vector<Result> check_file_finite(const FileEvidence& e) {
  Result r = e.result("file-finite");
  r.unit = "vectors";
  r.bound = 0;
  const auto look = [&](const Vector& v, std::int32_t vertex) {
    ++r.of;
    if (is_finite(v)) return;
    if (r.bad++ > 0) return;
    r.status = Status::kFinding;
    r.witness = Witness{};
    r.witness->vertex = vertex;
    r.witness->got = list(v);
  };
  const FileTessellation& t = e.tessellation;
  for (std::size_t v = 0; v < t.positions.size(); ++v)
    if (t.used[v]) look(t.positions[v], static_cast<std::int32_t>(v));
  for (const auto& n : t.normals) look(n.direction, n.vertex);
  return {r};
}

std::vector<Result> check_file_distance(const FileEvidence& e) {
  const FileTessellation& t = e.tessellation;
  if (!e.claimed.empty()) return check_file_positions(e);
  std::vector<double> error(t.positions.size(), -1);
  for (std::size_t v = 0; v < error.size(); ++v)
    if (t.used[v]) {
      const std::int32_t point = e.merged.point_of[v];
      error[v] = point < 0 ? kInfinite : e.foot[point].distance / e.surface.diagonal();
    }
  return {row(e, "file-distance", error,
              [&](std::int32_t v) { return e.point_of(v) < 0 ? Vector{} : e.foot[e.point_of(v)].position; })};
}

std::vector<Result> check_file_positions(const FileEvidence& e) {
  const FileTessellation& t = e.tessellation;
  std::vector<double> error(t.positions.size(), -1);
  std::vector<Vector> expected(t.positions.size());
  std::int64_t without = 0;
  for (std::size_t v = 0; v < error.size(); ++v) without += t.used[v] && e.claimed[v].face < 0;
  tbb::parallel_for(std::size_t{0}, error.size(), [&](std::size_t v) {
    if (e.claimed[v].face < 0) return;
    if (!is_finite(t.positions[v])) {
      error[v] = kInfinite;
      return;
    }
    const Foot foot = e.surface.at(e.claimed[v], t.positions[v]);
    expected[v] = foot.position;
    error[v] = foot.distance / e.surface.diagonal();
  });
  Result r = row(e, "file-positions", error, [&](std::int32_t v) { return expected[v]; });
  if (without > 0) {
    r.status = Status::kFinding;
    r.bad += without;
    r.of += without;
    r.message = fmt::format("{} vertices have no row in the provenance; they were projected", without);
  }
  return {r};
}

std::vector<Result> check_file_normals(const FileEvidence& e) {
  Result r = e.result("file-normals");
  r.unit = "degrees";
  r.bound = normal_bound(LC_FLOAT32, 5);
  const auto& normals = e.tessellation.normals;
  if (normals.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no normals";
    return {r};
  }
  std::vector<double> angle(normals.size(), -1);
  std::vector<Vector> expected(normals.size());
  std::int64_t undefined = 0;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const std::int32_t vertex = normals[k].vertex, point = e.point_of(vertex);
    if (point < 0) continue;
    const bool told = !e.claimed.empty() && e.claimed[vertex].face >= 0;
    const Vector& at = e.tessellation.positions[vertex];
    const Foot foot = told ? e.surface.at(e.claimed[vertex], at) : e.foot[point];
    expected[k] = foot.normal;
    if (!foot.has_normal) {
      ++undefined;
      continue;
    }
    angle[k] = angle_degrees(normals[k].direction, foot.normal);
    // At an extraordinary vertex the normal turns so fast that rounding of the position shows: the corner or
    // edge that the foot may as well be on will do.
    if (told || !(angle[k] > *r.bound)) continue;
    const Foot place = e.surface.at(e.place[point], at);
    if (!place.has_normal) {
      angle[k] = -1;
      ++undefined;
    } else if (const double there = angle_degrees(normals[k].direction, place.normal); there < angle[k]) {
      angle[k] = there;
      expected[k] = place.normal;
    }
  }
  const Statistics s = summarise(angle, *r.bound);
  take(r, s);
  if (s.worst_at >= 0) {
    r.witness = e.at_vertex(normals[s.worst_at].vertex);
    r.witness->expected = list(expected[s.worst_at]);
    r.witness->got = list(normals[s.worst_at].direction);
  }
  if (undefined > 0) r.message = fmt::format("{} more where the surface has no normal", undefined);
  if (s.bad == 0) return {r};

  // What else could they be?
  const auto opposite = std::count_if(angle.begin(), angle.end(), [](double a) { return a > 179; });
  const auto say = [&](const std::string& what) { r.message += (r.message.empty() ? "" : "; ") + what; };
  if (2 * opposite > s.of) say("most of them point the other way");
  const auto& t = e.tessellation;
  std::vector<Vector> mean(e.merged.vertex_of.size(), Vector{});
  for (const auto& triangle : t.triangles) {
    std::array<std::int32_t, 3> p{};
    for (int c = 0; c < 3; ++c) p[c] = e.point_of(triangle[c]);
    if (std::min({p[0], p[1], p[2]}) < 0) continue;
    const Vector n = cross(e.position(p[1]) - e.position(p[0]), e.position(p[2]) - e.position(p[0]));
    for (const std::int32_t k : p) mean[k] = mean[k] + n;
  }
  double apart = 0, wrong = 0;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    if (angle[k] < 0 || !std::isfinite(angle[k])) continue;
    const double from_mean = angle_degrees(normals[k].direction, mean[e.point_of(normals[k].vertex)]);
    apart += from_mean * from_mean;
    wrong += angle[k] * angle[k];
  }
  if (apart < wrong)
    say(fmt::format(
        "they are nearer to averages of the triangles around (weighted by area: {:.2g} degrees rms) than to "
        "the normals of the limit surface ({:.2g} rms)",
        std::sqrt(apart / static_cast<double>(s.of)), std::sqrt(wrong / static_cast<double>(s.of))));
  return {r};
}

}  // namespace limitcheck::verify
