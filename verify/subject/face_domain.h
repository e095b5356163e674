// SPDX-License-Identifier: MIT
// Where the points of one control face lie. The shape of a face's parameters is known here and nowhere else.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>

#include "data/scheme.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// A point named by a face: what lc_provenance says of a vertex and, on a face that is cut into quads, which
/// corner's quad it means.
struct Place {
  std::int32_t face;
  std::uint32_t i, j, denominator;
  std::int32_t corner = 0;
};
inline Place place_of(const lc_provenance& p, std::int32_t corner = 0) {
  return {p.face, p.i, p.j, p.denominator, corner};
}

/// The parameter domain of a control face:
///   triangle   of Loop's scheme: corners (0, 0), (1, 0), (0, 1) in (l1, l2)
///   quad       of Catmull-Clark's: the unit square of (u, v)
///   polygon    any other face of Catmull-Clark's, with as many parts as corners: part k is the unit square
///              from corner k to the middle of side k, the middle of the face, and the middle of side k - 1
///
/// Points are integers over a common number n of steps to a side, which every function takes: (i, j) is
/// l1 = i / n, l2 = j / n. A side is two sides of parts, so that in a part of a polygon u = i / (n / 2). An
/// odd n leaves of a polygon its corners. Corners are numbered counter-clockwise from 0. Side k runs from
/// corner k to corner next(k), and a point on it is given by its number of steps from corner k.
class FaceDomain {
 public:
  struct Point {
    std::int64_t i, j;
    std::int32_t part = 0;
    friend constexpr bool operator==(const Point&, const Point&) = default;
  };
  struct SidePoint {
    int side;
    std::int64_t along;  // steps from corner `side`
  };
  /// One face's corners laid on another's, in the same order or, if mirrored, in the opposite one.
  struct Symmetry {
    int first = 0;  // where corner 0 comes to lie
    bool mirrored = false;
  };

  constexpr FaceDomain(data::Scheme scheme, int corners)
      : shape_(scheme == data::Scheme::kLoop ? Shape::kTriangle
               : corners == 4                ? Shape::kQuad
                                             : Shape::kPolygon),
        corners_(corners) {}
  static constexpr FaceDomain triangle() { return {data::Scheme::kLoop, 3}; }

  constexpr int corners() const { return corners_; }
  constexpr int parts() const { return shape_ == Shape::kPolygon ? corners_ : 1; }
  constexpr int next(int k) const { return k + 1 == corners() ? 0 : k + 1; }
  constexpr int previous(int k) const { return k == 0 ? corners() - 1 : k - 1; }
  /// The corner on which corner k comes to lie.
  constexpr int corner(int k, Symmetry s) const {
    return (s.mirrored ? s.first - k + corners() : s.first + k) % corners();
  }

  /// How many steps to a side a denominator means, and the other way round.
  constexpr std::int64_t steps(std::int64_t denominator) const {
    return shape_ == Shape::kPolygon ? 2 * denominator : denominator;
  }
  /// n is even on a polygon.
  constexpr std::int64_t denominator(std::int64_t n) const { return shape_ == Shape::kPolygon ? n / 2 : n; }

  constexpr bool contains(Point p, std::int64_t n) const {
    if (p.i < 0 || p.j < 0 || p.part < 0 || p.part >= parts()) return false;
    if (shape_ == Shape::kTriangle) return p.i + p.j <= n;
    const std::int64_t most = denominator(n);
    return p.i <= most && p.j <= most;
  }
  constexpr Point corner_point(int k, std::int64_t n) const { return on_side(k, 0, n); }
  /// 0 <= along <= n.
  constexpr Point on_side(int side, std::int64_t along, std::int64_t n) const {
    if (shape_ != Shape::kPolygon) return moved({along, 0}, n, {side});
    return 2 * along <= n ? Point{along, 0, side} : Point{0, n - along, next(side)};
  }
  /// The side on which a point of the domain lies, of a corner the side that begins there; nothing inside.
  constexpr std::optional<SidePoint> side_of(Point p, std::int64_t n) const {
    if (shape_ == Shape::kTriangle) {
      const std::int64_t h = n - p.i - p.j;
      if (p.j == 0 && p.i < n) return SidePoint{0, p.i};
      if (h == 0 && p.j < n) return SidePoint{1, p.j};
      if (p.i == 0) return SidePoint{2, h};
    } else if (shape_ == Shape::kQuad) {
      if (p.j == 0 && p.i < n) return SidePoint{0, p.i};
      if (p.i == n && p.j < n) return SidePoint{1, p.j};
      if (p.j == n && p.i > 0) return SidePoint{2, n - p.i};
      if (p.i == 0) return SidePoint{3, n - p.j};
    } else {
      if (p.j == 0) return SidePoint{p.part, p.i};
      if (p.i == 0) return SidePoint{previous(p.part), n - p.j};
    }
    return std::nullopt;
  }
  /// How many steps along a side a point of the domain lies, its ends included; -1 beside it.
  constexpr std::int64_t along(Point p, int side, std::int64_t n) const {
    const auto at = side_of(p, n);
    if (!at) return -1;
    if (at->side == side) return at->along;
    return at->along == 0 && at->side == next(side) ? n : -1;
  }
  /// The corner in which a point lies, if it lies in one.
  constexpr std::optional<int> corner_at(Point p, std::int64_t n) const {
    const auto place = side_of(p, n);
    return place && place->along == 0 ? std::optional(place->side) : std::nullopt;
  }
  /// The point of another face on which this point comes to lie.
  constexpr Point moved(Point p, std::int64_t n, Symmetry s) const {
    if (shape_ == Shape::kTriangle) {
      const std::array<std::int64_t, 3> from{n - p.i - p.j, p.i, p.j};
      std::array<std::int64_t, 3> to{};
      for (int k = 0; k < 3; ++k)
        to[static_cast<std::size_t>(corner(k, s))] = from[static_cast<std::size_t>(k)];
      return {to[1], to[2]};
    }
    const Point q = s.mirrored ? Point{p.j, p.i} : Point{p.i, p.j};
    if (shape_ == Shape::kPolygon) return {q.i, q.j, corner(p.part, s)};
    return s.first == 0   ? q
           : s.first == 1 ? Point{n - q.j, q.i}
           : s.first == 2 ? Point{n - q.i, n - q.j}
                          : Point{q.j, n - q.i};
  }

  /// The same point as every part names it: on the line between two parts, the lower corner's name; in the
  /// middle, that of part 0.
  constexpr Point canonical(Point p, std::int64_t n) const {
    if (shape_ != Shape::kPolygon || 2 * p.j != n) return p;
    if (2 * p.i == n) return {p.i, p.j, 0};
    return {p.j, p.i, previous(p.part)};
  }
  /// The point as a part names it; nothing if it does not touch that part.
  constexpr std::optional<Point> in_part(Point p, int part, std::int64_t n) const {
    if (p.part == part) return p;
    const Point c = canonical(p, n);
    if (is_centre(c, n)) return Point{c.i, c.j, part};
    if (c.part == part) return c;
    if (2 * c.i == n && next(c.part) == part) return Point{c.j, c.i, part};
    return std::nullopt;
  }
  /// The lowest part that touches all of these points; nothing if there is none.
  template <std::size_t Count>
  constexpr std::optional<int> common_part(const std::array<Point, Count>& points, std::int64_t n) const {
    if (parts() == 1) return 0;
    std::size_t k = 0;  // the first that is not in the middle, which every part touches
    while (k < Count && is_centre(points[k], n)) ++k;
    if (k == Count) return 0;
    const Point c = canonical(points[k], n);
    const int other = 2 * c.i == n ? next(c.part) : c.part;
    for (const int part : {c.part < other ? c.part : other, c.part < other ? other : c.part}) {
      bool all = true;
      for (const Point& p : points) all = all && in_part(p, part, n);
      if (all) return part;
    }
    return std::nullopt;
  }
  /// Names the points as one part does. False if no part touches all of them.
  template <std::size_t Count>
  constexpr bool share_part(std::array<Point, Count>& points, std::int64_t n) const {
    const auto part = common_part(points, n);
    if (part)
      for (Point& p : points) p = *in_part(p, *part, n);
    return part.has_value();
  }
  /// The straight line from p to q in pieces, each within one part and given by its two ends. Between two parts a
  /// line is straight along a side only; elsewhere it is one piece, whose ends lie in two parts.
  template <class Visit>
  constexpr void for_each_straight(Point p, Point q, std::int64_t n, Visit visit) const {
    std::array<Point, 2> ends{p, q};
    if (share_part(ends, n)) {
      visit(ends[0], ends[1]);
      return;
    }
    const auto at = side_of(p, n);  // a corner lies on the side before, too
    const int own = at ? at->side : 0, other = at && at->along == 0 ? previous(own) : own;
    for (const int side : {own < other ? own : other, own < other ? other : own}) {
      const Point middle{n / 2, 0, side};
      if (n % 2 != 0 || along(p, side, n) < 0 || along(q, side, n) < 0) continue;
      for_each_straight(p, middle, n, visit);
      for_each_straight(middle, q, n, visit);
      return;
    }
    visit(p, q);
  }
  /// The same in the shortest steps between points of the scale.
  template <class Visit>
  constexpr void for_each_step(Point p, Point q, std::int64_t n, Visit visit) const {
    for_each_straight(p, q, n, [&](Point from, Point to) {
      if (from.part != to.part) return visit(from, to);
      const std::int64_t di = to.i - from.i, dj = to.j - from.j, pieces = std::gcd(di, dj);
      const auto at = [&](std::int64_t k) {
        return Point{from.i + di / pieces * k, from.j + dj / pieces * k, from.part};
      };
      for (std::int64_t k = 0; k < pieces; ++k) visit(at(k), at(k + 1));
    });
  }

  /// The centre is (1, 1) over this many steps.
  constexpr std::int64_t centre_denominator() const { return shape_ == Shape::kTriangle ? 3 : 2; }
  constexpr bool is_centre(Point p, std::int64_t n) const {
    return p.i == p.j && centre_denominator() * p.i == n;
  }

  /// How many names of lattice points there are at most, and the number of each among them.
  constexpr std::int64_t point_count(std::int64_t n) const {
    if (shape_ == Shape::kTriangle) return (n + 1) * (n + 2) / 2;
    const std::int64_t m = denominator(n) + 1;
    return parts() * m * m;
  }
  constexpr std::int64_t number(Point p, std::int64_t n) const {
    if (shape_ == Shape::kTriangle) return p.j * (n + 1) - p.j * (p.j - 1) / 2 + p.i;
    const std::int64_t m = denominator(n) + 1;
    const Point c = canonical(p, n);
    return (c.part * m + c.j) * m + c.i;
  }
  /// Every lattice point once.
  template <class Visit>
  constexpr void for_each_point(std::int64_t n, Visit visit) const {
    const std::int64_t most = denominator(n);
    for (std::int32_t part = 0; part < parts(); ++part)
      for (std::int64_t j = 0; j <= most; ++j)
        for (std::int64_t i = 0; shape_ == Shape::kTriangle ? i + j <= n : i <= most; ++i)
          if (const Point p{i, j, part}; canonical(p, n) == p) visit(p);
  }
  /// The triangles of a lattice of steps of `unit`: of Loop's scheme, or halves of squares that are cut from (i, j) to
  /// (i + 1, j + 1); of a polygon in steps of n, those from corner 0 to the others.
  template <class Visit>
  constexpr void for_each_triangle(std::int64_t n, std::int64_t unit, Visit visit) const {
    if (parts() > 1 && unit == n) {
      for (int k = 1; k + 1 < corners(); ++k)
        visit(corner_point(0, n), corner_point(k, n), corner_point(k + 1, n));
      return;
    }
    const bool loop = shape_ == Shape::kTriangle;
    const std::int64_t most = denominator(n);
    for (std::int32_t part = 0; part < parts(); ++part)
      for (std::int64_t j = 0; j < most; j += unit)
        for (std::int64_t i = 0; i < (loop ? most - j : most); i += unit) {
          const Point at{i, j, part}, right{i + unit, j, part}, up{i, j + unit, part},
              across{i + unit, j + unit, part};
          visit(at, right, loop ? up : across);
          if (!loop) visit(at, across, up);
          if (loop && i + j + unit < most) visit(right, across, up);
        }
  }
  /// How many of the lattice points lie inside the face.
  constexpr std::int64_t inner_count(std::int64_t n) const {
    if (shape_ == Shape::kTriangle) return (n - 1) * (n - 2) / 2;
    if (shape_ == Shape::kQuad) return (n - 1) * (n - 1);
    return n == 1 ? 0 : 1 + parts() * (n / 2) * (n / 2 - 1);
  }
  /// Their numbers among these, from 0: of a triangle and a quad row by row in j; of a polygon part by part,
  /// then the centre.
  constexpr std::int64_t inner_number(Point p, std::int64_t n) const {
    if (shape_ == Shape::kTriangle) return (p.j - 1) * (n - 1) - p.j * (p.j - 1) / 2 + p.i - 1;
    if (shape_ == Shape::kQuad) return (p.j - 1) * (n - 1) + p.i - 1;
    if (is_centre(p, n)) return inner_count(n) - 1;
    const Point c = canonical(p, n);
    const std::int64_t m = n / 2;
    return (c.part * (m - 1) + c.j - 1) * m + c.i - 1;
  }
  Point inner_point(std::int64_t number, std::int64_t n) const {
    if (shape_ == Shape::kTriangle) {  // the last row that begins at `number` or before
      const auto begin = [n](std::int64_t j) { return (j - 1) * (n - 1) - j * (j - 1) / 2; };
      const double half = static_cast<double>(n) - 0.5;
      auto j = static_cast<std::int64_t>(
          half - std::sqrt(std::max(0.0, half * half - 2 * static_cast<double>(number + n - 1))));
      while (j > 1 && begin(j) > number) --j;
      while (j + 1 < n && begin(j + 1) <= number) ++j;
      return {number - begin(j) + 1, j};
    }
    if (shape_ == Shape::kQuad) return {number % (n - 1) + 1, number / (n - 1) + 1};
    const std::int64_t m = n / 2;
    if (number == inner_count(n) - 1) return {m, m, 0};
    const std::int64_t row = number / m;
    return {number % m + 1, row % (m - 1) + 1, static_cast<std::int32_t>(row / (m - 1))};
  }

  /// Twice the oriented area of a triangle of points, > 0 counter-clockwise, in triangles of the lattice.
  /// Exact if a part has all three points; otherwise of a regular polygon, rounded.
  double area(std::array<Point, 3> c, std::int64_t n) const {
    __extension__ using Wide = __int128;  // products of numbers up to 2^32
    if (share_part(c, n))
      return static_cast<double>(Wide{c[1].i - c[0].i} * (c[2].j - c[0].j) -
                                 Wide{c[2].i - c[0].i} * (c[1].j - c[0].j));
    // The polygon has the radius 1 and, like its parts together, the area parts() * (n / 2)^2.
    const auto a = flat(c[0], n), b = flat(c[1], n), d = flat(c[2], n);
    const double half = static_cast<double>(n) / 2, unit = std::sin(2 * std::numbers::pi / corners_);
    const double area = (b[0] - a[0]) * (d[1] - a[1]) - (d[0] - a[0]) * (b[1] - a[1]);
    return std::round(area * 2 * half * half / unit * 1024) / 1024;
  }

 private:
  enum class Shape : std::uint8_t { kTriangle, kQuad, kPolygon };

  // Where a point of a polygon lies in the plane, if the polygon is regular and its parts are bilinear.
  std::array<double, 2> flat(Point p, std::int64_t n) const {
    const auto corner = [&](int k, std::size_t axis) {
      const double turn = 2 * std::numbers::pi * k / corners_;
      return axis == 0 ? std::cos(turn) : std::sin(turn);
    };
    const double u = 2 * static_cast<double>(p.i) / static_cast<double>(n);
    const double v = 2 * static_cast<double>(p.j) / static_cast<double>(n);
    std::array<double, 2> at{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double own = corner(p.part, axis), to_next = (own + corner(p.part + 1, axis)) / 2,
                   to_previous = (own + corner(p.part - 1, axis)) / 2;
      at[axis] = (1 - v) * ((1 - u) * own + u * to_next) + v * (1 - u) * to_previous;  // the middle is 0
    }
    return at;
  }

  Shape shape_;
  int corners_;
};

constexpr FaceDomain::Point point_of(const Place& p) {
  return {p.i, p.j, p.corner};
}
constexpr FaceDomain::Point point_of(const lc_provenance& p) {
  return {p.i, p.j};
}

}  // namespace limitcheck::verify
