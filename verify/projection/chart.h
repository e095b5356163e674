// SPDX-License-Identifier: MIT
// The shape of the faces of a domain: the unit triangle or the unit square.
#pragma once

#include <algorithm>
#include <array>

namespace limitcheck::verify {

/// Coordinates >= 0 with sum 1 from ones that are so up to rounding.
inline std::array<double, 3> clamped(std::array<double, 3> l) {
  for (double& x : l) x = std::clamp(x, 0.0, 1.0);
  const double sum = l[0] + l[1] + l[2];
  if (sum != 1)
    for (double& x : l) x /= sum;
  return l;
}

/// Points are given by three affine coordinates with sum 1, so that the same code measures areas, clips and
/// interpolates in both shapes; steps by three with sum 0.
///   triangle   barycentric coordinates: l1 and l2 of Loop's scheme are the second and the third
///   square     (1 - u - v, u, v), of which the first is negative beyond the diagonal; only u and v count
///
/// A side goes counter-clockwise. Side k lies opposite corner k of a triangle, and begins at corner k of a
/// square.
class Chart {
 public:
  using Affine = std::array<double, 3>;

  static constexpr Chart triangle() { return Chart(false); }
  static constexpr Chart square() { return Chart(true); }

  constexpr bool is_square() const { return square_; }
  constexpr int corners() const { return square_ ? 4 : 3; }
  /// The corners where a side begins and ends.
  constexpr int first(int side) const { return square_ ? side : (side + 1) % 3; }
  constexpr int last(int side) const { return square_ ? (side + 1) % 4 : (side + 2) % 3; }
  /// The side that begins at a corner.
  constexpr int side_from(int corner) const { return square_ ? corner : (corner + 2) % 3; }

  static constexpr Affine at(double u, double v) { return {1 - u - v, u, v}; }
  constexpr Affine corner(int k) const {
    if (square_) return at(k == 1 || k == 2 ? 1 : 0, k >= 2 ? 1 : 0);
    Affine l{};
    l[k] = 1;
    return l;
  }
  constexpr Affine centre() const { return square_ ? Affine{0, .5, .5} : Affine{1. / 3, 1. / 3, 1. / 3}; }
  /// The step along a side, from its first corner to its last.
  constexpr Affine along(int side) const {
    const Affine a = corner(first(side)), b = corner(last(side));
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  }
  /// The determinant of three points is twice their area over that of the triangle (0, 0), (1, 0), (0, 1),
  /// half of which is the unit; so much has the whole.
  constexpr double area() const { return square_ ? 2 : 1; }

  /// How far a point lies from a side, the far corner or side being at 1; 0 exactly means on it.
  constexpr double height(int side, const Affine& l) const {
    if (!square_) return l[side];
    return side == 0 ? l[2] : side == 1 ? 1 - l[1] : side == 2 ? 1 - l[2] : l[1];
  }
  /// The height gained by a step.
  constexpr double slope(int side, const Affine& step) const {
    if (!square_) return step[side];
    return side == 0 ? step[2] : side == 1 ? -step[1] : side == 2 ? -step[2] : step[1];
  }
  /// The corner in which a point lies exactly, or -1.
  constexpr int corner_at(const Affine& l) const {
    for (int k = 0; k < corners(); ++k)
      if (square_ ? height(k, l) == 0 && height((k + 3) % 4, l) == 0 : l[k] == 1) return k;
    return -1;
  }
  /// Within a tenth of a corner.
  constexpr bool is_near(int corner, const Affine& l) const {
    return square_ ? height(corner, l) <= .1 && height((corner + 3) % 4, l) <= .1 : l[corner] >= .9;
  }

  /// The point with what rounding has put outside moved back.
  Affine clamp(const Affine& l) const {
    return square_ ? at(std::clamp(l[1], 0.0, 1.0), std::clamp(l[2], 0.0, 1.0)) : clamped(l);
  }
  /// The point with its height over a side set to 0, which it is but for rounding.
  constexpr Affine put_on(int side, Affine l) const {
    if (square_) {
      l[side % 2 == 0 ? 2 : 1] = side == 1 || side == 2 ? 1 : 0;
      return at(l[1], l[2]);
    }
    l[side] = 0;
    return l;
  }
  /// The point moved straight onto a side.
  Affine dropped(int side, Affine l) const {
    if (!square_) {
      l[(side + 1) % 3] += l[side] / 2;
      l[(side + 2) % 3] += l[side] / 2;
    }
    return clamp(put_on(side, l));
  }

  friend constexpr bool operator==(Chart, Chart) = default;

 private:
  constexpr explicit Chart(bool square) : square_(square) {}
  bool square_;
};

}  // namespace limitcheck::verify
