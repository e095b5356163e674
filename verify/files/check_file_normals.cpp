// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/audit/bounds.h"
#include "verify/audit/normal_origin.h"
#include "verify/audit/statistics.h"
#include "verify/files/file_evidence.h"

namespace limitcheck::verify {
namespace {

std::vector<double> list(const Vector& v) {
  return {v.begin(), v.end()};
}

// A length of 1 + x is as far from the exact unit vector as a direction that is off by x radians. So both
// have one bound, that of normal_bound(LC_FLOAT32, 5): it lets through what was written with four decimals
// (9e-5).
constexpr double kLengthBound = 1e-3;

Result length_row(const FileEvidence& e) {
  Result r = e.result("file-normal-length");
  r.unit = "|n| - 1";
  r.bound = kLengthBound;
  const auto& normals = e.tessellation.normals;
  if (normals.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no normals";
    return r;
  }
  std::vector<double> error;
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const auto& n : normals) {
    const double length = norm(n.direction);
    const bool looked_at = std::isfinite(length) && e.tessellation.used[n.vertex];
    error.push_back(looked_at ? std::abs(length - 1) : -1);  // what is not finite has a row of its own
    if (!looked_at) continue;
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  const Statistics s = summarise(error, *r.bound);
  take(r, s);
  if (s.worst_at < 0) return r;
  r.witness = e.at_vertex(normals[s.worst_at].vertex);
  r.witness->got = list(normals[s.worst_at].direction);
  if (s.bad > 0) r.message = fmt::format("lengths from {:.4g} to {:.4g}", shortest, longest);
  return r;
}

}  // namespace

std::vector<Result> check_file_normals(const FileEvidence& e) {
  Result r = e.result("file-normals");
  r.unit = "degrees";
  r.bound = normal_bound(LC_FLOAT32, 5);
  const auto& normals = e.tessellation.normals;
  if (normals.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no normals";
    return {r, length_row(e)};
  }
  std::vector<double> angle(normals.size(), -1);
  std::vector<Vector> expected(normals.size());
  std::int64_t undefined = 0;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const std::int32_t vertex = normals[k].vertex, point = e.point_of(vertex);
    if (point < 0 || !e.tessellation.used[vertex]) continue;
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
  if (s.bad == 0) return {r, length_row(e)};

  const FileTessellation& t = e.tessellation;
  std::vector<DeliveredNormal> delivered;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    if (angle[k] < 0 || !std::isfinite(angle[k])) continue;
    const FacePoint& at = e.foot[e.point_of(normals[k].vertex)].at;
    const std::int32_t face = e.surface.surface().control_face(at.face);
    delivered.push_back({normals[k].vertex, normals[k].direction, expected[k], face, at.l[1], at.l[2]});
  }
  const std::string origin =
      origin_of_normals(delivered, e.control, t.positions, t.triangles, e.merged.point_of);
  if (!origin.empty()) r.message += (r.message.empty() ? "" : "; ") + origin;
  return {r, length_row(e)};
}

}  // namespace limitcheck::verify
