// SPDX-License-Identifier: MIT
#include "fast/ring.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace limitcheck::fast {

namespace {

constexpr double kParallel = 1e-12;  // claim D12
constexpr double kNoise = 1e-14;     // a tangent this small beside what it sums is rounding error

Point3 unit_or_zero(const Point3& a) {
  const double size = length(a);
  return size > 0 && std::isfinite(size) ? (1 / size) * a : Point3{};
}

}  // namespace

double loop_alpha(int n) {
  const double t = 3 + 2 * std::cos(2 * std::numbers::pi / n);
  return 5. / 8 - t * t / 64;
}

void Ring::gather(const data::ControlMesh& mesh, const Adjacency& adjacency, std::int32_t v) {
  centre_ = to_point(mesh.positions[v]);
  points_.clear();
  open_ = adjacency.on_boundary(v);
  const std::int32_t start = adjacency.outgoing(v);
  if (start < 0) return;
  std::int32_t next = start, last;
  do {
    last = next;
    points_.push_back(to_point(mesh.positions[adjacency.target(last)]));
    next = adjacency.rotate(last);
  } while (next >= 0 && next != start);
  if (open_) points_.push_back(to_point(mesh.positions[adjacency.origin(Adjacency::prev(last))]));
}

void Ring::assign(const Point3& centre, std::vector<Point3> points, bool open) {
  centre_ = centre;
  points_ = std::move(points);
  open_ = open;
}

void Ring::subdivide() {
  const std::size_t n = points_.size();
  if (n == 0) return;
  const Point3 first = points_.front(), v = centre_;
  Point3 previous = open_ ? Point3{} : points_.back();
  Point3 sum;
  for (std::size_t i = 0; i < n; ++i) {
    const Point3 here = points_[i];
    sum = sum + here;
    if (open_ && (i == 0 || i + 1 == n)) {
      points_[i] = .5 * (v + here);
    } else {
      const Point3 next = i + 1 == n ? first : points_[i + 1];
      points_[i] = .375 * (v + here) + .125 * (previous + next);
    }
    previous = here;
  }
  // `previous` is the old last point.
  if (open_) {
    centre_ = .75 * v + .125 * (first + previous);
  } else {
    const double a = loop_alpha(static_cast<int>(n));
    centre_ = (1 - a) * v + (a / static_cast<double>(n)) * sum;
  }
}

Point3 Ring::limit_position() const {
  if (points_.empty()) return centre_;
  if (open_) return (1. / 6) * (4. * centre_ + points_.front() + points_.back());
  const auto n = static_cast<int>(points_.size());
  const double w = 3. * n / (8 * loop_alpha(n));
  Point3 sum;
  for (const Point3& r : points_) sum = sum + r;
  return (1 / (w + n)) * (w * centre_ + sum);
}

Point3 Ring::limit_normal(bool* degenerate) const {
  if (degenerate != nullptr) *degenerate = false;
  const std::size_t n = points_.size();
  Point3 first, second;  // tangents, first x second outward
  if (open_) {
    const auto faces = static_cast<double>(n - 1);
    const double theta = std::numbers::pi / faces, c = std::cos(theta), s = std::sin(theta);
    first = points_.front() - points_.back();
    if (n == 2) {
      second = (points_[0] - centre_) + (points_[1] - centre_);
    } else {
      // The weights sum to 0, so the centre's own drops out of differences from it.
      const double end = -c * (1 + c) / ((1 + 2 * c) * s);
      second = end * ((points_.front() - centre_) + (points_.back() - centre_));
      for (std::size_t i = 1; i + 1 < n; ++i) {
        second = second + std::sin(static_cast<double>(i) * theta) * (points_[i] - centre_);
      }
    }
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      const double t = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
      const Point3 d = points_[i] - centre_;
      first = first + std::cos(t) * d;
      second = second + std::sin(t) * d;
    }
  }

  const Point3 normal = cross(first, second);
  const double size = length(normal);
  double reach = 0;
  for (const Point3& r : points_) reach += length(r - centre_);
  const double shorter = std::min(length(first), length(second)),
               longer = std::max(length(first), length(second));
  if (shorter > kNoise * reach && size > kParallel * shorter * longer) return (1 / size) * normal;

  if (degenerate != nullptr) *degenerate = true;
  Ring finer = *this;
  for (int step = 0; step < 3; ++step) {
    finer.subdivide();
    const Point3 guess = finer.area_normal();
    if (guess != Point3{}) return guess;
  }
  const Point3 guess = area_normal();
  return guess != Point3{} ? guess : Point3{0, 0, 1};
}

Point3 Ring::face_normal(int i) const {
  const std::size_t a = static_cast<std::size_t>(i), b = a + 1 == points_.size() ? 0 : a + 1;
  return unit_or_zero(cross(points_[a] - centre_, points_[b] - centre_));
}

double Ring::cone_cosine(const Point3& normal) const {
  double smallest = 1;
  for (int i = 0; i < faces(); ++i) {
    const Point3 face = face_normal(i);
    if (face != Point3{}) smallest = std::min(smallest, dot(face, normal));
  }
  return smallest;
}

Point3 Ring::area_normal() const {
  Point3 sum;
  double sizes = 0;
  for (int i = 0; i < faces(); ++i) {
    const auto a = static_cast<std::size_t>(i), b = a + 1 == points_.size() ? 0 : a + 1;
    const Point3 p = points_[a] - centre_, q = points_[b] - centre_;
    sum = sum + cross(p, q);
    sizes += length(p) * length(q);  // not the area: that of a collinear ring is rounding error itself
  }
  return length(sum) > kParallel * sizes ? unit_or_zero(sum) : Point3{};
}

}  // namespace limitcheck::fast
