// SPDX-License-Identifier: MIT
// The rows of triangles: file-degenerate; file-orientation and file-coverage.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {
namespace {

// The triangle is lower than a few roundings of the coordinates in double.
bool has_no_area(const std::array<Vector, 3>& p) {
  const Vector a = p[1] - p[0], b = p[2] - p[0];
  const double longest = std::max({norm(a), norm(b), norm(b - a)});
  return norm(cross(a, b)) <= 0x1p-50 * std::max({largest(p[0]), largest(p[1]), largest(p[2])}) * longest;
}

// The surface itself is so thin at this place of a face that the tolerance does not tell its triangles from
// lines: the exact triangle of a third of the file's resolution, drawn from the place towards the middle of
// the face, where corners without derivatives are out of the way.
bool thin_at(const FileEvidence& e, const FacePoint& at, double spacing) {
  const Chart chart = e.surface.domain().chart();
  const Chart::Affine centre = chart.centre();
  std::array<Vector, 3> corner;
  for (int k = 0; k < 3; ++k) {
    Chart::Affine l = at.l;
    for (int i = 0; i < 3; ++i) l[i] += spacing * (centre[i] - l[i]);
    l[0] -= k > 0 ? spacing / 3 : 0;
    if (k > 0) l[k] += spacing / 3;
    corner[k] = e.surface.at({at.face, chart.clamp(l)}, {}).position;
  }
  const double longest =
      std::max({norm(corner[1] - corner[0]), norm(corner[2] - corner[0]), norm(corner[2] - corner[1])});
  const double area = norm(cross(corner[1] - corner[0], corner[2] - corner[0]));
  return area <= e.tolerance * e.surface.diagonal() * longest;
}

// The same in any face at one of the points.
bool surface_is_thin(const FileEvidence& e, const std::array<std::int32_t, 3>& points, double spacing) {
  const Domain& domain = e.surface.domain();
  for (const std::int32_t p : points)
    for (const std::int32_t face : faces_with(domain, e.place[p]))
      if (FacePoint there; domain.express(e.place[p], face, there) && thin_at(e, there, spacing)) return true;
  return false;
}

// A face of the domain is covered once if the areas of the triangles on it, in its parameters, add up to 1; a
// hole is left open if they add up to 0.
// Feet are put on edges and corners, so a face's share is exact but for rounding; one triangle at depth 6 is
// 2.4e-4.
constexpr double kShare = 1e-4;
// Where triangles cross face borders their areas are exact between two faces but not around an extraordinary
// vertex: only all faces together are judged, and less sharply.
constexpr double kCrossingShare = 1e-2;

bool faces_back(const FileEvidence& e, const std::array<std::int32_t, 3>& p, const PlacedTriangle& placed) {
  if (placed.face >= 0 && std::abs(placed.area) < 1e-12) return false;  // no orientation
  const Vector n = cross(e.position(p[1]) - e.position(p[0]), e.position(p[2]) - e.position(p[0]));
  const auto against = [&](std::int32_t k) { return e.foot[k].has_normal && dot(n, e.foot[k].normal) < 0; };
  const bool in_space = against(p[0]) + against(p[1]) + against(p[2]) >= 2;
  return placed.face >= 0 && !placed.crosses ? placed.area < 0 && (in_space || placed.area < -1e-9)
                                             : in_space;
}

}  // namespace

std::vector<Result> check_file_triangles(const FileEvidence& e) {
  Result r = e.result("file-degenerate", "triangles", 0);
  const auto& t = e.tessellation;
  if (lacks(t.triangles, "faces", r)) return {r};
  const double faces =
      static_cast<double>(e.surface.domain().face_count()) * e.surface.domain().chart().area();
  const double spacing = std::min(1., std::sqrt(faces / static_cast<double>(t.triangles.size())));
  std::int64_t joints = 0, thin = 0;
  for (std::size_t k = 0; k < t.triangles.size(); ++k) {
    const auto& v = t.triangles[k];
    const auto p = e.points_of(v);
    if (std::min({p[0], p[1], p[2]}) < 0) continue;  // not finite
    ++r.of;
    if (!has_no_area({e.position(p[0]), e.position(p[1]), e.position(p[2])})) continue;
    if (is_collapsed(v)) {
      ++joints;
    } else if (surface_is_thin(e, p, spacing)) {
      ++thin;
    } else if (r.bad++ == 0) {
      r.witness = e.at_vertex(v[0]);
      r.witness->triangle = static_cast<std::int64_t>(k);
    }
  }
  for (const auto& [count, what] :
       {std::pair{r.bad, "triangles of three vertices have no area"},
        {joints, "name a vertex twice, as joints of triangle strips do"},
        {thin, "have no area because the surface there is thinner than the tolerance"}})
    if (count > 0) say(r, fmt::format("{} {}", count, what));
  if (r.of == 0) r.status = Status::kNotRun;
  if (r.bad > 0) {
    r.status = Status::kFinding;
  } else if (joints > 0) {
    r.status = Status::kQualityWarning;
    r.bad = joints;
  }
  return {r};
}

std::vector<Result> check_file_cover(const FileEvidence& e) {
  Result facing = e.result("file-orientation", "triangles", 0), cover = e.result("file-coverage", "share");
  const auto& triangles = e.tessellation.triangles;
  if (lacks(triangles, "faces", facing) && lacks(triangles, "faces", cover)) return {facing, cover};

  std::vector<PlacedTriangle> placed(triangles.size());
  std::vector<char> back(triangles.size(), 0), nowhere(triangles.size(), 0);
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
    const auto p = e.points_of(triangles[t]);
    if (std::min({p[0], p[1], p[2]}) < 0 || is_collapsed(p)) {
      nowhere[t] = 1;  // covers nothing
      return;
    }
    placed[t] = place_triangle(e, p);
    back[t] = faces_back(e, p, placed[t]);
  });

  facing.of = static_cast<std::int64_t>(triangles.size());
  facing.bad = std::count(back.begin(), back.end(), 1);
  if (facing.bad > 0) {
    const auto t = static_cast<std::size_t>(std::find(back.begin(), back.end(), 1) - back.begin());
    facing.status = Status::kFinding;
    facing.witness = e.at_vertex(triangles[t][0]);
    facing.witness->triangle = static_cast<std::int64_t>(t);
    facing.message = facing.bad == facing.of
                         ? "all of them: the tessellation is inside out (corners clockwise seen from outside)"
                         : fmt::format("{} of {} triangles face inwards", facing.bad, facing.of);
  }

  const LimitSurface& surface = e.surface.surface();
  std::vector<double> share(e.surface.domain().face_count(), 0);
  const auto wanted = [&](std::size_t f) { return surface.is_hole(static_cast<std::int32_t>(f)) ? 0. : 1.; };
  double faces = 0;
  for (std::size_t f = 0; f < share.size(); ++f) faces += wanted(f);
  std::int64_t crossing = 0, lost = 0;
  double all = 0;
  for (std::size_t t = 0; t < placed.size(); ++t) {
    if (placed[t].face < 0) {
      lost += nowhere[t] == 0;
      continue;
    }
    crossing += placed[t].crosses;
    share[placed[t].face] += std::abs(placed[t].area);
    all += std::abs(placed[t].area);
  }
  if (crossing == 0 && lost == 0) {
    cover.bound = kShare;
    cover.of = static_cast<std::int64_t>(share.size());
    std::int64_t less = 0, more = 0, holes = 0;
    double worst = -1, sum = 0;
    for (std::size_t f = 0; f < share.size(); ++f) {
      const double off = std::abs(share[f] - wanted(f));
      less += share[f] < wanted(f) - kShare;
      more += share[f] > 1 + kShare && wanted(f) > 0;
      holes += share[f] > kShare && wanted(f) == 0;
      sum += off * off;
      if (off <= worst) continue;
      worst = off;
      const auto at = surface.control_point({static_cast<std::int32_t>(f), {}});
      cover.witness = Witness{};
      cover.witness->face = at.face;
      cover.witness->corner = at.corner;
      cover.witness->expected = {wanted(f)};
      cover.witness->got = {share[f]};
    }
    cover.bad = less + more + holes;
    cover.worst = worst;
    cover.rms = std::sqrt(sum / static_cast<double>(share.size()));
    if (cover.bad > 0) {
      cover.status = Status::kFinding;
      cover.message = fmt::format(
          "{} {} are not wholly covered, {} more than once", less,
          surface.has_control_faces() ? "control faces" : "quads at the corners of control faces", more);
      if (holes > 0)
        cover.message += fmt::format(", and {} that are holes of the control mesh are covered", holes);
    }
    return {facing, cover};
  }
  cover.bound = kCrossingShare + 2 * static_cast<double>(lost) / static_cast<double>(placed.size());
  cover.of = 1;
  cover.worst = cover.rms = std::abs(all / faces - 1);
  cover.message = fmt::format(
      "{} triangles cross the borders of control faces{}: the faces are judged together, {:.4f} of the "
      "surface is covered",
      crossing, lost > 0 ? fmt::format(" and {} more than one border", lost) : "", all / faces);
  if (*cover.worst > *cover.bound) {
    cover.bad = 1;
    cover.status = Status::kFinding;
  }
  return {facing, cover};
}

}  // namespace limitcheck::verify
