// SPDX-License-Identifier: MIT
// The triangles of a tessellation laid over the domain, and how far a piece of the surface and what lies over it are from
// one another at most. For hausdorff.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "verify/files/checks/file_evidence.h"
#include "verify/projection/box_tree.h"

namespace limitcheck::verify {

/// Of triangles barycentric; in the domain affine, as Chart has them.
using Barycentric = std::array<double, 3>;
using Corners = std::array<Vector, 3>;

/// A triangle of the tessellation over one face, its corners in the coordinates of that face, perhaps beyond
/// its edges.
struct Over {
  std::int32_t triangle;
  std::array<Barycentric, 3> l;
};

inline Vector mix(const Corners& corner, const Barycentric& weight) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2];
}

/// Triangles, of which the nearest is found by their boxes.
class TriangleTree {
 public:
  explicit TriangleTree(std::vector<Corners> triangles)
      : triangles_(std::move(triangles)), tree_(boxes_of(triangles_)) {}
  /// Of a point from the nearest; infinite without triangles.
  double distance(const Vector& p) const {
    double least = std::numeric_limits<double>::infinity();
    tree_.near(p, [&](std::size_t k) {
      return least = std::min(least, closest_on_triangle(p, triangles_[k]).distance);
    });
    return least;
  }
  const Corners& operator[](std::size_t k) const { return triangles_[k]; }

 private:
  static std::vector<BoxTree::Box> boxes_of(const std::vector<Corners>& triangles) {
    std::vector<BoxTree::Box> boxes;
    for (const auto& t : triangles) boxes.push_back(BoxTree::around({t[0], t[1], t[2]}));
    return boxes;
  }
  std::vector<Corners> triangles_;
  BoxTree tree_;
};

/// Upper bounds of the distances between one piece of the surface and the triangles over it, in the mesh's unit.
struct Bound {
  double from_triangles = 0, from_surface = 0;
  FacePoint at_triangles, at_surface;  // where they are taken
  std::int32_t triangle = -1;          // from which, at at_triangles ...
  Barycentric weight{};                // ... with these coordinates
  bool bare = false;                   // some of the piece has no triangle over it
};

/// Any number of threads may ask at once.
class Overlay {
 public:
  /// The points of the evidence are placed. Keeps a reference to it.
  explicit Overlay(const FileEvidence& e)
      : e_(e),
        over_(e.surface.domain().face_count()),
        number_(e.tessellation.triangles.size()),
        finite_(lay_all()) {}

  /// The triangles over a face.
  const std::vector<Over>& over(std::int32_t face) const { return over_[face]; }
  /// Those of `all` that are over the piece, judged by their extents.
  static std::vector<Over> near(const Piece& piece, const std::vector<Over>& all) {
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
  /// Both bounds, each with the place where it is taken. Of the surface over holes nobody expects triangles.
  Bound look(const Piece& piece, const std::vector<Over>& over) const {
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
    if (e_.surface.surface().is_hole(piece.face)) {
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

  /// The corners of a triangle, which are finite.
  const Corners& corners(std::int32_t triangle) const { return finite_[number_[triangle]]; }
  /// Triangles not wholly over one face, or over no part of it.
  const std::vector<std::int32_t>& loose() const { return loose_; }
  /// From a point to the nearest triangle, wherever it is; infinite without triangles.
  double distance_to_triangles(const Vector& p) const { return finite_.distance(p); }

 private:
  // A convex polygon: of three corners, cut along three sides, of which each adds one, or by rounding twice as many as
  // lie on one side of it.
  using Part = boost::container::static_vector<Barycentric, 12>;
  static constexpr double kNoArea = 1e-14;  // of a face, in its parameters

  // Coordinates of u with respect to a triangle of the domain.
  static Barycentric within(const std::array<Barycentric, 3>& t, double area, const Barycentric& u) {
    return {determinant(u, t[1], t[2]) / area, determinant(t[0], u, t[2]) / area,
            determinant(t[0], t[1], u) / area};
  }
  // The common part of two triangles of the domain: Sutherland and Hodgman's clipping of `a` along the sides of `b`.
  static Part clip(const std::array<Barycentric, 3>& a, const std::array<Barycentric, 3>& b) {
    const double sign = determinant(b[0], b[1], b[2]) < 0 ? -1 : 1;
    Part part(a.begin(), a.end());
    for (std::size_t k = 0; k < 3 && !part.empty(); ++k) {
      const Part before = part;
      std::array<double, Part::static_capacity> height;  // over side k of b, in any unit
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
  static double area_of(const Part& part) {
    double sum = 0;
    for (std::size_t k = 1; k + 1 < part.size(); ++k) sum += determinant(part[0], part[k], part[k + 1]);
    return std::abs(sum);
  }

  // The triangles whose corners are finite; each of some area is laid over the domain.
  std::vector<Corners> lay_all() {
    std::vector<Corners> finite;
    for (std::size_t t = 0; t < number_.size(); ++t) {
      const auto p = e_.points_of(e_.tessellation.triangles[t]);
      if (std::min({p[0], p[1], p[2]}) < 0) continue;
      number_[t] = static_cast<std::int32_t>(finite.size());
      finite.push_back({e_.position(p[0]), e_.position(p[1]), e_.position(p[2])});
      if (!is_collapsed(p)) lay(static_cast<std::int32_t>(t), place_triangle(e_, p));
    }
    return finite;
  }
  // Over its face, and over the faces beyond the edges it crosses.
  void lay(std::int32_t triangle, const PlacedTriangle& placed) {
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

  const FileEvidence& e_;
  std::vector<std::vector<Over>> over_;  // of each face
  std::vector<std::int32_t> number_;     // of each triangle in finite_, if it is there
  std::vector<std::int32_t> loose_;
  TriangleTree finite_;  // those with finite corners; made last, by laying all
};

}  // namespace limitcheck::verify
