// SPDX-License-Identifier: MIT
// Whether the positions and normals of a file are those of the surface.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "verify/files/checks/file_evidence.h"
#include "verify/recognise/recognise.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Steps in the parameters that move a point by `radius` in the direction in which it moves fastest, and in the
// one in which it moves slowest: the axes of an ellipse, which is long where tangents are nearly parallel.
struct Axes {
  double fast[2], slow[2];

  Axes(const LimitSurface& surface, const FacePoint& at, double radius) {
    const auto p = surface.evaluate(at, reference::Order::kFirst);
    const Vector d1 = vector_of(p.t1), d2 = vector_of(p.t2);
    const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
    const double turn = std::atan2(2 * b, a - c) / 2, middle = (a + c) / 2,
                 spread = std::hypot((a - c) / 2, b);
    const auto length = [&](double square) {
      constexpr double kMost = .25;  // of a face
      return square * kMost * kMost > radius * radius ? radius / std::sqrt(square) : kMost;
    };
    const double most = length(middle + spread), least = length(middle - spread);
    fast[0] = most * std::cos(turn), fast[1] = most * std::sin(turn);
    slow[0] = -least * std::sin(turn), slow[1] = least * std::cos(turn);
  }
};

// The smallest angle, in degrees, between a direction and the normals of points of the surface within
// `radius` of a foot: a position that was rounded by so much may have been any of them. A descent in the
// parameters, which ends when the angle is at most `enough`, or as soon as the surface is seen not to turn.
double least_angle_nearby(const ClosestPoint& surface, const Foot& foot, const Vector& direction,
                          double radius, double enough) {
  constexpr int kDirections = 8, kSteps = 64;
  constexpr int kSeen = 12;          // steps after which it is seen: where tangents are nearly parallel the
                                     // surface bends away long before the end of a slow one
  constexpr double kWorthIt = 1e-3;  // of what is missing, gained by a step, or by all of these
  const double first = angle_degrees(direction, foot.normal);
  double angle = first, scale = .5;
  FacePoint best = foot.at;
  for (int i = 0; i < kSteps && angle > enough; ++i) {
    const Axes axes(surface.surface(), best, radius);
    double least = angle;
    FacePoint there = best;
    for (int k = 0; k < kDirections; ++k) {
      const double turn = 2 * std::numbers::pi * k / kDirections, c = scale * std::cos(turn),
                   s = scale * std::sin(turn);
      const double x = c * axes.fast[0] + s * axes.slow[0], y = c * axes.fast[1] + s * axes.slow[1];
      const FacePoint at = surface.domain().walk(best, {-x - y, x, y});
      const Foot other = surface.at(at, foot.position);
      if (!other.has_normal || other.distance > radius) continue;
      const double its = angle_degrees(direction, other.normal);
      if (its < least) least = its, there = at;
    }
    if (i == kSeen && first - least < kWorthIt * (first - enough)) return least;
    scale = angle - least > kWorthIt * (angle - enough) ? std::min(1., 2 * scale) : scale / 2;
    angle = least, best = there;
  }
  return angle;
}

// A length of 1 + x is as far from the exact unit vector as a direction that is off by x radians. So both
// have one bound, that of normal_bound(LC_FLOAT32, 5): it lets through what was written with four decimals
// (9e-5).
constexpr double kLengthBound = 1e-3;

Result length_row(const FileEvidence& e) {
  Result r = e.result("file-normal-length", "|n| - 1", kLengthBound);
  const auto& normals = e.tessellation.normals;
  if (lacks(normals, "normals", r)) return r;
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
      if (placed.face < 0) placed = place_triangle(e, e.points_of(v));
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
  std::vector<bool> seen(t.texture.size());
  for (std::size_t i = 0; i < t.corner_texture.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t index = t.corner_texture[i][c];
      if (index < 0 || seen[static_cast<std::size_t>(index)]) continue;
      seen[static_cast<std::size_t>(index)] = true;
      const auto& uv = t.texture[static_cast<std::size_t>(index)];
      look({uv[0], uv[1], 0}, t.triangles[i][c]);
    }
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
  const bool told = !e.claimed.empty();
  std::vector<double> error(t.positions.size(), -1);
  std::vector<Vector> expected(t.positions.size());
  tbb::parallel_for(std::size_t{0}, error.size(), [&](std::size_t v) {
    const std::int32_t point = e.merged.point_of[v];
    if (told ? e.claimed[v].face < 0 : !t.used[v]) return;
    error[v] = kInfinite;
    if (point < 0) return;  // not finite
    const Foot foot = told ? e.surface.at(e.claimed[v], t.positions[v]) : e.foot[point];
    expected[v] = foot.position;
    error[v] = foot.distance / e.surface.diagonal();
  });
  Result r = e.result(told ? "file-positions" : "file-distance", "diagonal", e.tolerance);
  const Statistics s = summarise(error, e.tolerance);
  take(r, s);
  r.decades = decades(error);
  if (s.worst_at >= 0) {
    r.witness = e.at_vertex(static_cast<std::int32_t>(s.worst_at));
    r.witness->show(expected[s.worst_at], t.positions[s.worst_at]);
    if (s.worst) r.worst_absolute = *s.worst * e.surface.diagonal();
  }
  std::int64_t without = 0;
  for (std::size_t v = 0; v < error.size(); ++v) without += told && t.used[v] && e.claimed[v].face < 0;
  if (without == 0) return {r};
  r.status = Status::kFinding;
  r.bad += without, r.of += without;
  r.message = fmt::format("{} vertices have no row in the provenance; they were projected", without);
  return {r};
}

std::vector<Result> check_file_normals(const FileEvidence& e) {
  Result r = e.result("file-normals", "degrees", normal_bound(LC_FLOAT32, 5));
  const auto& normals = e.tessellation.normals;
  if (lacks(normals, "normals", r)) return {r, length_row(e)};
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
  r.decades = decades(angle);
  if (s.worst_at >= 0) {
    r.witness = e.at_vertex(normals[s.worst_at].vertex);
    r.witness->show(expected[s.worst_at], normals[s.worst_at].direction);
  }
  if (undefined > 0) say(r, fmt::format("{} more where the surface has no normal", undefined));
  if (shared > 0)
    say(r,
        fmt::format("{} more on edges that stay sharp stand for both sides, which have two normals", shared));
  if (s.bad == 0) return {r, length_row(e)};

  const FileTessellation& t = e.tessellation;
  std::vector<DeliveredNormal> delivered;
  for (std::size_t k = 0; k < normals.size(); ++k) {
    if (angle[k] < 0 || !std::isfinite(angle[k])) continue;
    const FacePoint& at = e.foot[e.point_of(normals[k].vertex)].at;
    const std::int32_t face = e.surface.surface().control_face(at.face);
    delivered.push_back({normals[k].vertex, normals[k].direction, expected[k], face, at.l[1], at.l[2]});
  }
  say(r, origin_of_normals(delivered, e.control, t.positions, t.triangles, e.merged.point_of));
  return {r, length_row(e)};
}

}  // namespace limitcheck::verify
