// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {
namespace {

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

std::vector<Result> check_file_cover(const FileEvidence& e) {
  Result facing = e.result("file-orientation"), cover = e.result("file-coverage");
  facing.unit = "triangles";
  facing.bound = 0;
  cover.unit = "share";
  const auto& triangles = e.tessellation.triangles;
  if (triangles.empty()) {
    facing.status = cover.status = Status::kNotSupported;
    facing.message = cover.message = "the file has no faces";
    return {facing, cover};
  }

  std::vector<PlacedTriangle> placed(triangles.size());
  std::vector<char> back(triangles.size(), 0), nowhere(triangles.size(), 0);
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
    std::array<std::int32_t, 3> p{};
    for (int c = 0; c < 3; ++c) p[c] = e.point_of(triangles[t][c]);
    if (std::min({p[0], p[1], p[2]}) < 0 || p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) {
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
