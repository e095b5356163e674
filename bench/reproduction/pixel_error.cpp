// SPDX-License-Identifier: MIT
#include "bench/reproduction/pixel_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "reference/stam.h"
#include "verify/audit/lattice.h"

namespace limitcheck::bench {

namespace {

using fast::Point3;

Point3 point(const reference::Vec3<double>& p) {
  return {p.x, p.y, p.z};
}

/// Value below which that share of the numbers lies.
double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

struct Samples {
  std::vector<double> silhouette, interior;
};

}  // namespace

struct PixelErrorMeter::State {
  State(const data::ControlMesh& mesh, int depth) : lattice(mesh, depth), surface(mesh) {}
  verify::Lattice lattice;
  reference::StamEvaluator<double> surface;
};

PixelErrorMeter::PixelErrorMeter(const data::ControlMesh& mesh, int depth)
    : state_(std::make_unique<State>(mesh, depth)) {}
PixelErrorMeter::~PixelErrorMeter() = default;

PixelError PixelErrorMeter::measure(const fast::DrawList<float>& frame, const fast::Camera& camera,
                                    std::int64_t samples, std::optional<fast::Kind> kind) const {
  if (frame.provenance.size() != frame.vertices.size())
    throw std::invalid_argument("pixel error: the frame does not say where its vertices lie");
  std::int64_t triangles = 0;
  const auto counts = [&](const fast::Draw& draw) { return !kind || draw.kind == *kind; };
  for (const fast::Draw& draw : frame.draws) triangles += counts(draw) ? draw.triangle_count() : 0;
  const std::int64_t step = std::max<std::int64_t>(1, 4 * triangles / std::max<std::int64_t>(1, samples));

  // Weights of the three corners.
  constexpr std::array<std::array<double, 3>, 4> places{
      {{1. / 3, 1. / 3, 1. / 3}, {.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}}};
  const auto scale = static_cast<double>(state_->lattice.scale());
  Samples found;
  PixelError error;
  std::int64_t number = 0;
  for (const fast::Draw& draw : frame.draws) {
    if (!counts(draw)) continue;
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      if (number++ % step != 0) continue;
      const std::int32_t face = draw.face_of(t);
      std::array<double, 3> l1{}, l2{};
      std::array<Point3, 3> corner;
      std::size_t k = 0;
      for (const std::int32_t v : draw.triangle(t)) {
        const auto at = static_cast<std::size_t>(draw.first + v);
        const fast::LatticePoint& p = frame.provenance[at];
        const auto inside =
            state_->lattice.in_face(state_->lattice.id({p.face, p.i, p.j, p.denominator}), face);
        if (!inside) throw std::logic_error("pixel error: a vertex does not lie on its triangle's face");
        l1[k] = static_cast<double>(inside->i) / scale;
        l2[k] = static_cast<double>(inside->j) / scale;
        const auto& q = frame.vertices[at].position;
        corner[k++] = {q.x, q.y, q.z};
      }
      for (const auto& w : places) {
        const auto exact = state_->surface.evaluate(static_cast<std::size_t>(face),
                                                    w[0] * l1[0] + w[1] * l1[1] + w[2] * l1[2],
                                                    w[0] * l2[0] + w[1] * l2[1] + w[2] * l2[2]);
        const Point3 surface = point(exact.position), normal = point(exact.normal);
        const Point3 flat = w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2];
        const Point3 sight = surface - camera.eye;
        const double distance = length(sight), away = dot(normal, sight) / distance;
        if (away > 0) continue;
        ++error.samples;
        const double pixels = std::abs(dot(normal, flat - surface)) *
                              std::sqrt(std::max(0., 1 - away * away)) * camera.focal_pixels() / distance;
        error.mean += pixels;
        (away > -std::sin(20 * std::numbers::pi / 180) ? found.silhouette : found.interior).push_back(pixels);
      }
    }
  }
  if (error.samples > 0) error.mean /= static_cast<double>(error.samples);
  error.silhouette_99 = quantile(found.silhouette, .99);
  error.interior_99 = quantile(found.interior, .99);
  for (const double e : found.silhouette) error.silhouette_worst = std::max(error.silhouette_worst, e);
  for (const double e : found.interior) error.interior_worst = std::max(error.interior_worst, e);
  return error;
}

}  // namespace limitcheck::bench
