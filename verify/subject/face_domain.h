// SPDX-License-Identifier: MIT
// Where the points of one control face lie. The shape of a face's parameters is known here and nowhere else.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// The parameter domain of a control face: the triangle with corners (0, 0), (1, 0), (0, 1) in (l1, l2).
///
/// Points are pairs of integers over a common denominator n, which every function takes: (i, j) is
/// l1 = i / n, l2 = j / n. Corners are numbered counter-clockwise from 0. Side k runs from corner k to corner
/// next(k), and a point on it is given by its number of steps of 1 / n from corner k.
///
/// Code that asks a domain in place of counting to three is ready for other faces: a quad (the unit square),
/// and an n-gon (n unit squares side by side, one for each corner, which meet in the middle of the face).
class FaceDomain {
 public:
  struct Point {
    std::int64_t i, j;
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

  constexpr int corners() const { return 3; }
  constexpr int next(int k) const { return k + 1 == corners() ? 0 : k + 1; }
  constexpr int previous(int k) const { return k == 0 ? corners() - 1 : k - 1; }
  /// The corner on which corner k comes to lie.
  constexpr int corner(int k, Symmetry s) const {
    return (s.mirrored ? s.first - k + corners() : s.first + k) % corners();
  }

  constexpr bool contains(Point p, std::int64_t n) const { return p.i >= 0 && p.j >= 0 && p.i + p.j <= n; }
  constexpr Point corner_point(int k, std::int64_t n) const { return on_side(k, 0, n); }
  /// 0 <= along <= n.
  constexpr Point on_side(int side, std::int64_t along, std::int64_t n) const {
    return side == 0 ? Point{along, 0} : side == 1 ? Point{n - along, along} : Point{0, n - along};
  }
  /// The side on which a point of the domain lies, of a corner the side that begins there; nothing inside.
  constexpr std::optional<SidePoint> side_of(Point p, std::int64_t n) const {
    const std::int64_t h = n - p.i - p.j;
    if (p.j == 0 && p.i < n) return SidePoint{0, p.i};
    if (h == 0 && p.j < n) return SidePoint{1, p.j};
    if (p.i == 0) return SidePoint{2, h};
    return std::nullopt;
  }
  /// The corner in which a point lies, if it lies in one.
  constexpr std::optional<int> corner_at(Point p, std::int64_t n) const {
    const auto place = side_of(p, n);
    return place && place->along == 0 ? std::optional(place->side) : std::nullopt;
  }
  /// The point of another face on which this point comes to lie.
  constexpr Point moved(Point p, std::int64_t n, Symmetry s) const {
    const std::array<std::int64_t, 3> from{n - p.i - p.j, p.i, p.j};
    std::array<std::int64_t, 3> to{};
    for (int k = 0; k < 3; ++k) to[corner(k, s)] = from[k];
    return {to[1], to[2]};
  }

  /// The centre is (1, 1) over this.
  constexpr std::int64_t centre_denominator() const { return 3; }
  constexpr bool is_centre(Point p, std::int64_t n) const { return p.i == p.j && 3 * p.i == n; }

  /// How many lattice points there are, and the number of each among them, row by row in j.
  constexpr std::int64_t point_count(std::int64_t n) const { return (n + 1) * (n + 2) / 2; }
  constexpr std::int64_t number(Point p, std::int64_t n) const {
    return p.j * (n + 1) - p.j * (p.j - 1) / 2 + p.i;
  }
  /// How many of them lie inside the face in the row of this j, 0 < j < n: i = 1, 2 ...
  constexpr std::int64_t inner_points_in_row(std::int64_t j, std::int64_t n) const { return n - 1 - j; }
  /// Every lattice point, in the order of the numbers.
  template <class Visit>
  constexpr void for_each_point(std::int64_t n, Visit visit) const {
    for (std::int64_t j = 0; j <= n; ++j)
      for (std::int64_t i = 0; i + j <= n; ++i) visit(Point{i, j});
  }
  /// In triangles of the lattice, each half a parallelogram of its steps, which is how many tile the face.
  constexpr std::int64_t area(std::int64_t n) const { return n * n; }
};

/// Twice the oriented area of a triangle of points; > 0 counter-clockwise. In the unit of FaceDomain::area.
constexpr std::int64_t area(const std::array<FaceDomain::Point, 3>& c) {
  return (c[1].i - c[0].i) * (c[2].j - c[0].j) - (c[2].i - c[0].i) * (c[1].j - c[0].j);
}

inline FaceDomain::Point point_of(const lc_provenance& p) {
  return {p.i, p.j};
}

}  // namespace limitcheck::verify
