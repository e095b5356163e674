// SPDX-License-Identifier: MIT
#include "bench/cases/matched.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "reference/surface/surface.h"
#include "verify/subject/lattice.h"

namespace limitcheck::bench {

namespace {

using fast::Point3;

template <class V>
Point3 point(const V& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// NaN if either is.
double larger(double a, double b) {
  return a >= b || std::isnan(a) ? a : b;
}

struct Screen {
  explicit Screen(const fast::Camera& camera) : eye(camera.eye), focal(camera.focal_pixels()) {
    const auto unit = [](const Point3& p) { return (1 / length(p)) * p; };
    back = unit(camera.eye - camera.target);
    right = unit(cross(camera.up, back));
    up = cross(back, right);
  }
  std::array<double, 2> operator()(const Point3& p) const {
    const Point3 from_eye = p - eye;
    const double scale = -focal / dot(from_eye, back);
    return {scale * dot(from_eye, right), scale * dot(from_eye, up)};
  }

  Point3 eye, back, right, up;
  double focal;
};

}  // namespace

void each_triangle_middle(const data::ControlMesh& mesh, data::Scheme scheme,
                          const fast::DrawList<float>& frame, reference::Derivatives order,
                          const std::function<void(const TriangleMiddle&)>& with) {
  const verify::Lattice lattice(mesh, scheme, 5);
  const reference::Surface surface(mesh, scheme);
  const double thirds = 1 / (3 * static_cast<double>(lattice.scale()));
  for (const fast::Draw& draw : frame.draws) {
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      TriangleMiddle middle{&draw, t, {}, {}, {}};
      double first = 0, second = 0;
      const std::int32_t face = draw.face_of(t);
      for (const std::int32_t v : draw.triangle(t)) {
        const auto at = static_cast<std::size_t>(draw.first + v);
        const auto& [p, n] = frame.vertices[at];
        const auto& from = frame.provenance[at];
        const auto place = lattice.in_face(
            lattice.id(verify::Place{from.face, from.i, from.j, from.denominator, from.corner}), face);
        first += thirds * static_cast<double>(place->i);
        second += thirds * static_cast<double>(place->j);
        middle.position = middle.position + (1. / 3) * fast::Point3{p.x, p.y, p.z};
        middle.normal = middle.normal + fast::Point3{n.x, n.y, n.z};
      }
      middle.exact = surface.evaluate(face, 0, first, second, order);
      with(middle);
    }
  }
}

PointBound worst_errors(const data::ControlMesh& mesh, data::Scheme scheme,
                        const fast::DrawList<float>& frame) {
  const reference::Surface surface(mesh, scheme);
  const double diagonal = data::box_diagonal(mesh);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (frame.vertices.empty()) return {kNaN, kNaN};
  PointBound worst{0, 0};
  for (std::size_t k = 0; k < frame.vertices.size(); ++k) {
    const fast::LatticePoint& at = frame.provenance[k];
    const auto exact =
        surface.evaluate(at.face, at.corner, static_cast<double>(at.i) / at.denominator,
                         static_cast<double>(at.j) / at.denominator, reference::Derivatives::kFirst);
    const Point3 n = point(frame.vertices[k].normal), wanted = point(exact.normal);
    const double off = length(point(frame.vertices[k].position) - point(exact.position)) / diagonal;
    const double turned = std::atan2(length(cross(n, wanted)), dot(n, wanted));
    worst = {larger(worst.position, off), larger(worst.normal, turned)};
  }
  return worst;
}

double pixel_error(const data::ControlMesh& mesh, data::Scheme scheme, const fast::Camera& camera,
                   const fast::DrawList<float>& frame) {
  const Screen screen(camera);
  std::vector<std::pair<double, double>> errors;  // and the pixels that have them
  double all = 0;
  each_triangle_middle(
      mesh, scheme, frame, reference::Derivatives::kPosition, [&](const TriangleMiddle& middle) {
        std::array<std::array<double, 2>, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
          corner[k] = screen(point(frame
                                       .vertices[static_cast<std::size_t>(
                                           middle.draw->first + middle.draw->triangle(middle.triangle)[k])]
                                       .position));
        const auto [a, b, c] = corner;
        const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
        if (area <= 0) return;
        all += area;  // NaN stays
        if (!std::isfinite(area)) return;
        const auto drawn = screen(middle.position), exact = screen(point(middle.exact.position));
        errors.emplace_back(std::hypot(drawn[0] - exact[0], drawn[1] - exact[1]), area);
      });
  if (!(all > 0)) return std::numeric_limits<double>::quiet_NaN();
  std::sort(errors.begin(), errors.end());
  double covered = 0;
  for (const auto& [error, area] : errors)
    if ((covered += area) >= .99 * all) return error;
  return 0;
}

double matching_target(double pixels, const std::function<double(double target)>& error_at) {
  const auto target = [](int k) { return std::exp2(k / 4.); };
  const auto fits = [&](int k) { return error_at(target(k)) <= pixels; };
  int fine = -4, coarse = 32;
  if (!fits(fine)) return 0;
  if (fits(coarse)) return target(coarse);
  while (coarse - fine > 1) {
    const int middle = (fine + coarse) / 2;
    (fits(middle) ? fine : coarse) = middle;
  }
  return target(fine);
}

}  // namespace limitcheck::bench
