// SPDX-License-Identifier: MIT
#include "verify/picture/canvas.h"

#include <algorithm>
#include <cmath>

#include "data/error.h"

namespace limitcheck::verify {

namespace {

using fast::Point3;

constexpr std::int64_t kUnit = 4096;  // of a pixel

Point3 unit(const Point3& v) {
  return (1 / length(v)) * v;
}

/// Twice the area of the triangle o, a, b; positive if it is clockwise on a screen whose y points downwards.
template <class ScreenVertex>
std::int64_t area(const ScreenVertex& o, const ScreenVertex& a, const ScreenVertex& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace

Canvas::Canvas(const fast::Camera& camera) : camera_(camera), focal_(camera.focal_pixels()) {
  camera.validate();
  back_ = unit(camera.eye - camera.target);
  right_ = unit(cross(camera.up, back_));
  up_ = cross(back_, right_);
  light_ = unit(back_ + .45 * up_ - .35 * right_);
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  picture_ = {camera.width, camera.height, std::vector<float>(pixels, Picture::kNothing)};
  inverse_.assign(pixels, 0);
}

Canvas::ScreenVertex Canvas::project(const fast::SurfaceVertex<float>& vertex) const {
  const auto& p = vertex.position;
  const Point3 from_eye = Point3{p.x, p.y, p.z} - camera_.eye;
  const double distance = -dot(from_eye, back_);
  if (!(distance >= camera_.near))
    throw data::ArgumentError("picture: a vertex is not before the near plane");
  const double x = camera_.width / 2. + focal_ * dot(from_eye, right_) / distance;
  const double y = camera_.height / 2. - focal_ * dot(from_eye, up_) / distance;
  constexpr double kFarthest = 1 << 17;  // pixels: differences fit in 31 bits, products of two of them in 62
  if (!(std::abs(x) < kFarthest && std::abs(y) < kFarthest))
    throw data::ArgumentError("picture: a vertex is too far to the side of the view");
  const auto& n = vertex.normal;
  return {std::llround(x * kUnit), std::llround(y * kUnit), 1 / distance,
          (1 / distance) * Point3{n.x, n.y, n.z}};
}

void Canvas::fill(const std::array<ScreenVertex, 3>& corner) {
  // Counter-clockwise from outside is, with y downwards, a negative area.
  const std::int64_t whole = -area(corner[0], corner[1], corner[2]);
  if (whole <= 0) return;
  const auto first = [](std::int64_t low) { return (low + kUnit / 2 - 1) / kUnit; };  // middle at or after
  const auto after = [](std::int64_t high) { return (high + kUnit / 2) / kUnit; };
  const auto [left, right] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
  const auto [top, bottom] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  const std::int64_t x_from = std::max<std::int64_t>(0, first(left)),
                     x_to = std::min<std::int64_t>(camera_.width, after(right)),
                     y_from = std::max<std::int64_t>(0, first(top)),
                     y_to = std::min<std::int64_t>(camera_.height, after(bottom));
  for (std::int64_t y = y_from; y < y_to; ++y) {
    for (std::int64_t x = x_from; x < x_to; ++x) {
      const ScreenVertex middle{x * kUnit + kUnit / 2, y * kUnit + kUnit / 2, 0, {}};
      std::array<double, 3> weight{};
      bool inside = true;
      for (std::size_t k = 0; k < 3 && inside; ++k) {
        const ScreenVertex &a = corner[(k + 1) % 3], &b = corner[(k + 2) % 3];
        const std::int64_t side = -area(a, b, middle);
        // Of a middle on an edge: it belongs to the triangle to the right of it or below it.
        const bool owned = b.y > a.y || (b.y == a.y && b.x < a.x);
        inside = side > 0 || (side == 0 && owned);
        weight[k] = static_cast<double>(side) / static_cast<double>(whole);
      }
      if (!inside) continue;
      const double inverse =
          weight[0] * corner[0].inverse + weight[1] * corner[1].inverse + weight[2] * corner[2].inverse;
      const auto pixel = static_cast<std::size_t>(y * camera_.width + x);
      if (inverse <= inverse_[pixel]) continue;
      inverse_[pixel] = inverse;
      const Point3 normal =
          weight[0] * corner[0].normal + weight[1] * corner[1].normal + weight[2] * corner[2].normal;
      const double size = length(normal), lit = size > 0 ? std::max(0., dot(normal, light_) / size) : 0;
      picture_.shade[pixel] = static_cast<float>(255 * (.22 + .78 * lit));
    }
  }
}

void Canvas::triangle(const fast::SurfaceVertex<float>& a, const fast::SurfaceVertex<float>& b,
                      const fast::SurfaceVertex<float>& c) {
  fill({project(a), project(b), project(c)});
}

void Canvas::draw(const fast::Draw& draw, std::span<const fast::SurfaceVertex<float>> vertices,
                  std::span<const fast::LatticePoint>) {
  corners_.clear();
  for (const auto& vertex : vertices) corners_.push_back(project(vertex));
  for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
    const auto v = draw.triangle(t);
    fill({corners_[v[0]], corners_[v[1]], corners_[v[2]]});
  }
}

}  // namespace limitcheck::verify
