// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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
  for (const std::int32_t p : points) {
    const FacePoint& at = e.place[p];
    for (int k = 0; k < domain.chart().corners(); ++k)
      for (const std::int32_t face : domain.faces_at(domain.vertex(at.face, k))) {
        FacePoint there;
        if (domain.express(at, face, there) && thin_at(e, there, spacing)) return true;
      }
  }
  return false;
}

}  // namespace

std::vector<Result> check_file_triangles(const FileEvidence& e) {
  Result r = e.result("file-degenerate");
  r.unit = "triangles";
  r.bound = 0;
  const auto& t = e.tessellation;
  if (t.triangles.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no faces";
    return {r};
  }
  const double faces =
      static_cast<double>(e.surface.domain().face_count()) * e.surface.domain().chart().area();
  const double spacing = std::min(1., std::sqrt(faces / static_cast<double>(t.triangles.size())));
  std::int64_t joints = 0, thin = 0;
  for (std::size_t k = 0; k < t.triangles.size(); ++k) {
    const auto& v = t.triangles[k];
    const std::array<std::int32_t, 3> p{e.point_of(v[0]), e.point_of(v[1]), e.point_of(v[2])};
    if (std::min({p[0], p[1], p[2]}) < 0) continue;  // not finite
    ++r.of;
    if (!has_no_area({e.position(p[0]), e.position(p[1]), e.position(p[2])})) continue;
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      ++joints;
    } else if (surface_is_thin(e, p, spacing)) {
      ++thin;
    } else if (r.bad++ == 0) {
      r.witness = e.at_vertex(v[0]);
      r.witness->triangle = static_cast<std::int64_t>(k);
    }
  }
  const auto say = [&](std::int64_t count, const char* what) {
    if (count > 0) r.message += fmt::format("{}{} {}", r.message.empty() ? "" : "; ", count, what);
  };
  say(r.bad, "triangles of three vertices have no area");
  say(joints, "name a vertex twice, as joints of triangle strips do");
  say(thin, "have no area because the surface there is thinner than the tolerance");
  if (r.of == 0) r.status = Status::kNotRun;
  if (r.bad > 0) {
    r.status = Status::kFinding;
  } else if (joints > 0) {
    r.status = Status::kQualityWarning;
    r.bad = joints;
  }
  return {r};
}

}  // namespace limitcheck::verify
