// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "verify/files/checks/file_evidence.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Errors of vertices (negative: not looked at) as a row; `expected(vertex)` is for the witness.
template <class Expected>
Result row(const FileEvidence& e, const char* check, const std::vector<double>& error, Expected&& expected) {
  Result r = e.result(check, "diagonal", e.tolerance);
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
  Result r = e.result("file-finite", "vectors", 0);
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
  for (std::size_t v = 0; v < t.positions.size(); ++v) look(t.positions[v], static_cast<std::int32_t>(v));
  for (const auto& n : t.normals) look(n.direction, n.vertex);
  return {r};
}

std::vector<Result> check_file_unused(const FileEvidence& e) {
  Result r = e.result("file-unused", "vertices", 0);
  const auto& used = e.tessellation.used;
  r.of = static_cast<std::int64_t>(used.size());
  r.bad = std::count(used.begin(), used.end(), false);
  if (r.bad == 0) return {r};
  r.status = Status::kQualityWarning;
  r.message = fmt::format("{} vertices belong to no face; only whether they are finite was looked at", r.bad);
  r.witness = Witness{};
  r.witness->vertex = std::find(used.begin(), used.end(), false) - used.begin();
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

}  // namespace limitcheck::verify
