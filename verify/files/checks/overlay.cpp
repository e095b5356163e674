// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "verify/files/checks/hausdorff.h"

namespace limitcheck::verify {
namespace {

// Coordinates of u with respect to a triangle of the domain.
Barycentric within(const std::array<Barycentric, 3>& t, double area, const Barycentric& u) {
  return {determinant(u, t[1], t[2]) / area, determinant(t[0], u, t[2]) / area,
          determinant(t[0], t[1], u) / area};
}

// A convex polygon of few corners. Cutting along a side adds one corner at most, but for rounding.
class Part {
 public:
  static constexpr std::size_t kMost = 12;
  std::size_t size() const { return size_; }
  const Barycentric& operator[](std::size_t k) const { return corner_[k]; }
  const Barycentric* begin() const { return corner_.data(); }
  const Barycentric* end() const { return corner_.data() + size_; }
  void clear() { size_ = 0; }
  void push_back(const Barycentric& corner) {
    if (size_ < kMost) corner_[size_++] = corner;
  }

 private:
  std::array<Barycentric, kMost> corner_;
  std::size_t size_ = 0;
};

// The common part of two triangles of the domain: Sutherland
// and Hodgman's clipping of `a` along the sides of `b`.
Part clip(const std::array<Barycentric, 3>& a, const std::array<Barycentric, 3>& b) {
  const double sign = determinant(b[0], b[1], b[2]) < 0 ? -1 : 1;
  Part part;
  for (const Barycentric& corner : a) part.push_back(corner);
  for (std::size_t k = 0; k < 3 && part.size() > 0; ++k) {
    const Part before = part;
    std::array<double, Part::kMost> height;  // over side k of b, in any unit
    for (std::size_t i = 0; i < before.size(); ++i)
      height[i] = sign * determinant(before[i], b[(k + 1) % 3], b[(k + 2) % 3]);
    part.clear();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const std::size_t next = i + 1 < before.size() ? i + 1 : 0;
      const Barycentric &p = before[i], &q = before[next];
      const double x = height[i], y = height[next];
      if (x >= 0) part.push_back(p);
      if ((x > 0 && y < 0) || (x < 0 && y > 0)) {
        const double s = x / (x - y);
        part.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1]), p[2] + s * (q[2] - p[2])});
      }
    }
  }
  return part;
}

double area_of(const Part& part) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < part.size(); ++k) sum += determinant(part[0], part[k], part[k + 1]);
  return std::abs(sum);
}

constexpr double kNoArea = 1e-14;  // of a face, in its parameters

std::vector<BoxTree::Box> boxes_of(const std::vector<std::array<Vector, 3>>& triangles) {
  std::vector<BoxTree::Box> boxes;
  for (const auto& t : triangles) boxes.push_back(BoxTree::around({t[0], t[1], t[2]}));
  return boxes;
}

}  // namespace

TriangleTree::TriangleTree(std::vector<std::array<Vector, 3>> triangles)
    : triangles_(std::move(triangles)), tree_(boxes_of(triangles_)) {}

double TriangleTree::distance(const Vector& p) const {
  double least = std::numeric_limits<double>::infinity();
  tree_.near(p, [&](std::size_t k) {
    return least = std::min(least, closest_on_triangle(p, triangles_[k]).distance);
  });
  return least;
}

Overlay::Overlay(const FileEvidence& e) : e_(e), over_(e.surface.domain().face_count()) {
  const auto& list = e.tessellation.triangles;
  number_.resize(list.size());
  std::vector<std::array<Vector, 3>> finite;
  for (std::size_t t = 0; t < list.size(); ++t) {
    const auto p = e.points_of(list[t]);
    if (std::min({p[0], p[1], p[2]}) < 0) continue;
    number_[t] = static_cast<std::int32_t>(finite.size());
    finite.push_back({e.position(p[0]), e.position(p[1]), e.position(p[2])});
    if (is_collapsed(p)) continue;
    lay(static_cast<std::int32_t>(t), place_triangle(e, p));
  }
  finite_.emplace(std::move(finite));
}

// Over its face, and over the faces beyond the edges it crosses.
void Overlay::lay(std::int32_t triangle, const PlacedTriangle& placed) {
  const bool flat = std::abs(placed.area) < kNoArea;
  if (placed.face < 0 || placed.crosses || flat) loose_.push_back(triangle);
  if (placed.face < 0 || flat) return;
  over_[placed.face].push_back({triangle, placed.l});
  if (!placed.crosses) return;
  const Domain& domain = e_.surface.domain();
  const Chart chart = domain.chart();
  for (int k = 0; k < chart.corners(); ++k) {
    const auto height = [&](int c) { return chart.height(k, placed.l[c]); };
    if (std::min({height(0), height(1), height(2)}) >= 0) continue;
    const std::int32_t next = domain.across(placed.face, k);
    if (next < 0) continue;
    Over there{triangle, {}};
    for (int c = 0; c < 3; ++c) there.l[c] = domain.unfolded(placed.face, k, placed.l[c]);
    over_[next].push_back(there);
  }
}

// Those over the piece, judged by their extents.
std::vector<Over> Overlay::near(const Piece& piece, const std::vector<Over>& all) {
  std::vector<Over> some;
  for (const Over& o : all) {
    bool apart = false;
    for (int k = 0; k < 3; ++k) {
      const auto [o_low, o_high] = std::minmax({o.l[0][k], o.l[1][k], o.l[2][k]});
      const auto [p_low, p_high] = std::minmax({piece.at[0][k], piece.at[1][k], piece.at[2][k]});
      apart = apart || o_low >= p_high || o_high <= p_low;
    }
    if (!apart) some.push_back(o);
  }
  return some;
}

Bound Overlay::look(const Piece& piece, const std::vector<Over>& over) const {
  Bound bound;
  const double area = determinant(piece.at[0], piece.at[1], piece.at[2]);
  double left = area;
  for (const Over& o : over) {
    const double o_area = determinant(o.l[0], o.l[1], o.l[2]);
    if (std::abs(o_area) < kNoArea) continue;
    const Part part = clip(o.l, piece.at);
    if (part.size() < 3) continue;
    left -= area_of(part);
    const auto& triangle = corners(o.triangle);
    for (const Barycentric& u : part) {
      const Barycentric on_piece = within(piece.at, area, u), on_triangle = within(o.l, o_area, u);
      const Vector p = piece.flat(on_piece), t = mix(triangle, on_triangle);
      const double from_surface = closest_on_triangle(p, triangle).distance + piece.deviation;
      const double from_triangles = closest_on_triangle(t, piece.corner).distance + piece.deviation;
      if (from_surface > bound.from_surface) {
        bound.from_surface = from_surface;
        bound.at_surface = {piece.face, piece.chart.clamp(u)};
      }
      if (from_triangles > bound.from_triangles) {
        bound.from_triangles = from_triangles;
        bound.at_triangles = {piece.face, piece.chart.clamp(u)};
        bound.triangle = o.triangle;
        bound.weight = on_triangle;
      }
    }
  }
  if (is_hole(piece.face)) {
    bound.from_surface = 0;
  } else if (left > 1e-6 * area) {  // not covered: the nearest triangle, wherever it is
    // No point of the piece is farther from its middle than a corner is, and the distance to the triangles
    // changes no faster than the place.
    constexpr Barycentric kMiddle{1. / 3, 1. / 3, 1. / 3};
    const Vector middle = piece.flat(kMiddle);
    double reach = 0;
    for (const Vector& corner : piece.corner) reach = std::max(reach, norm(corner - middle));
    bound.bare = true;
    bound.at_surface = piece.parameter(kMiddle);
    bound.from_surface =
        std::max(bound.from_surface, distance_to_triangles(middle) + reach + piece.deviation);
  }
  return bound;
}

}  // namespace limitcheck::verify
