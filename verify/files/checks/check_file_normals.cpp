// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "verify/files/checks/file_evidence.h"
#include "verify/files/checks/nearby_normal.h"
#include "verify/recognise/normal_origin.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

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

// Of the normals on edges that stay sharp, by their number: the faces of the triangles that have them there.
std::map<std::int32_t, std::set<std::int32_t>> faces_of_cut_normals(const FileEvidence& e) {
  std::map<std::int32_t, std::set<std::int32_t>> faces;
  const FileTessellation& t = e.tessellation;
  const auto on_cut = [&](std::int32_t vertex) {
    const std::int32_t point = e.point_of(vertex);
    return point >= 0 && e.place[point].face >= 0 && e.surface.domain().on_cut(e.place[point]);
  };
  std::vector<std::int32_t> of_vertex(t.positions.size(), -1);
  for (std::size_t k = 0; k < t.normals.size(); ++k) {
    const std::int32_t vertex = t.normals[k].vertex;
    of_vertex[vertex] = static_cast<std::int32_t>(k);
    if (on_cut(vertex)) faces[static_cast<std::int32_t>(k)];
  }
  if (faces.empty()) return faces;
  for (std::size_t i = 0; i < t.triangles.size(); ++i) {
    const auto& v = t.triangles[i];
    PlacedTriangle placed;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto its = faces.find(t.corner_normals.empty() ? of_vertex[v[c]] : t.corner_normals[i][c]);
      if (its == faces.end()) continue;
      if (placed.face < 0) placed = place_triangle(e, {e.point_of(v[0]), e.point_of(v[1]), e.point_of(v[2])});
      if (placed.face >= 0 && !placed.crosses) its->second.insert(placed.face);
    }
  }
  return faces;
}

// What a normal on an edge that stays sharp is held against.
struct SideNormal {
  enum Kind { kJudged, kUndefined, kShared } kind;
  Foot foot{};  // kJudged
};

// The normal of the side on which its triangles lie; if they tell nothing, that of the nearest. One that
// triangles of two sides share, with normals that differ by more than the bound, is right on one at most.
SideNormal side_normal(const FileEvidence& e, std::int32_t point, const Vector& direction,
                       const std::set<std::int32_t>& faces, double bound) {
  SideNormal side{SideNormal::kUndefined, {}};
  double nearest = std::numeric_limits<double>::infinity(), apart = 0;
  std::vector<Vector> normals;
  for (const Foot& foot : in_all_faces(e, e.place[point], e.position(point))) {
    if (!faces.empty() && !faces.contains(foot.at.face)) continue;
    if (!foot.has_normal) return {SideNormal::kUndefined, {}};
    for (const Vector& other : normals) apart = std::max(apart, angle_degrees(other, foot.normal));
    normals.push_back(foot.normal);
    const double angle = angle_degrees(direction, foot.normal);
    if (side.kind == SideNormal::kJudged && !(angle < nearest)) continue;
    side = {SideNormal::kJudged, foot};
    nearest = angle;
  }
  if (!faces.empty() && apart > bound) return {SideNormal::kShared, {}};
  return side;
}

// How far a foot may be from where its vertex was made: the rounding of three floats, and what computing them
// in float costs about the mesh (1e-7 of its diagonal).
double rounding(const FileEvidence& e, const Vector& at) {
  const double largest = std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
  return 0x1p-23 * (largest + e.surface.diagonal());
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
  std::int64_t undefined = 0, shared = 0;
  // What rounding may excuse; a file with many normals that it does not is not searched to the end.
  constexpr int kMostInVain = 1000;
  int in_vain = 0;
  const auto least_angle = [&](const Foot& foot, const Vector& direction, const Vector& at, double so_far) {
    if (!(so_far > *r.bound) || in_vain >= kMostInVain) return so_far;
    const double least = least_angle_nearby(e.surface, foot, direction, rounding(e, at), *r.bound);
    in_vain += least > *r.bound;
    return least;
  };
  const auto sides = faces_of_cut_normals(e);
  for (std::size_t k = 0; k < normals.size(); ++k) {
    const std::int32_t vertex = normals[k].vertex, point = e.point_of(vertex);
    if (point < 0 || !e.tessellation.used[vertex]) continue;
    if (const auto faces = sides.find(static_cast<std::int32_t>(k)); faces != sides.end()) {
      const SideNormal side = side_normal(e, point, normals[k].direction, faces->second, *r.bound);
      undefined += side.kind == SideNormal::kUndefined;
      shared += side.kind == SideNormal::kShared;
      if (side.kind != SideNormal::kJudged) continue;
      expected[k] = side.foot.normal;
      angle[k] = angle_degrees(normals[k].direction, side.foot.normal);
      // Nearby, too, the surface is that of the side.
      angle[k] = least_angle(side.foot, normals[k].direction, e.position(point), angle[k]);
      continue;
    }
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
    angle[k] = least_angle(foot, normals[k].direction, at, angle[k]);
  }
  const Statistics s = summarise(angle, *r.bound);
  take(r, s);
  if (s.worst_at >= 0) {
    r.witness = e.at_vertex(normals[s.worst_at].vertex);
    r.witness->expected = list(expected[s.worst_at]);
    r.witness->got = list(normals[s.worst_at].direction);
  }
  if (undefined > 0) r.message = fmt::format("{} more where the surface has no normal", undefined);
  if (shared > 0)
    r.message +=
        fmt::format("{}{} more on edges that stay sharp stand for both sides, which have two normals",
                    r.message.empty() ? "" : "; ", shared);
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
