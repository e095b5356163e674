// SPDX-License-Identifier: MIT
// Boxes near a point, and the closest point of a triangle.
//
// The tree: our own few lines because no library at hand does this: the search must end when the visitor, who knows
// more about a box than its distance, says so. Boost's R-tree sorts all candidates again at every leaf,
// CGAL's AABB tree hands out one primitive, not the next, and is GPL-3.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "verify/evidence/vector.h"

namespace limitcheck::verify {

/// A binary tree over boxes, split at the median of the longest side. Any number of threads may ask at once.
class BoxTree {
 public:
  struct Box {
    Vector low, high;
  };
  /// The box around some points, larger by `margin` on every side.
  static Box around(std::initializer_list<Vector> points, double margin = 0);

  /// O(n log n). The coordinates must be finite.
  explicit BoxTree(const std::vector<Box>& boxes);

  /// Hands boxes to `visit`, nearer ones first by and large: all that are no farther from p than what `visit`
  /// returned last.
  void near(const Vector& p, const std::function<double(std::size_t index)>& visit) const;

 private:
  struct Node {
    Box box;
    std::int32_t right = -1;          // the left child follows its parent; -1 in a leaf, which ...
    std::int32_t begin = 0, end = 0;  // ... has these entries of order_
  };
  void build(const std::vector<Box>& boxes, std::int32_t begin, std::int32_t end);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;  // in that order
};

/// A point of a triangle.
struct OnTriangle {
  std::array<double, 3> weight;  // >= 0, sum 1
  Vector point;
  double distance;
};

/// The point of the triangle closest to p, by the Voronoi region of the triangle that p lies in (Ericson,
/// Real-Time Collision Detection, 5.1.5). Degenerate triangles are segments or points. Error: a few ulp of
/// the coordinates.
inline OnTriangle closest_on_triangle(const Vector& p, const std::array<Vector, 3>& t) {
  const auto at = [&](double u, double v, double w) {
    const Vector q = t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]);
    return OnTriangle{{u, v, w}, q, norm(p - q)};
  };
  const Vector ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return at(1, 0, 0);
  const Vector bp = p - t[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return at(0, 1, 0);
  const Vector cp = p - t[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return at(0, 0, 1);
  const double c = d1 * d4 - d3 * d2;
  if (c <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return at(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
  const double b = d5 * d2 - d1 * d6;
  if (b <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return at(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
  const double a = d3 * d6 - d5 * d4, e = d4 - d3, f = d5 - d6;
  if (a <= 0 && e >= 0 && f >= 0 && e + f > 0) return at(0, 1 - e / (e + f), e / (e + f));
  const double sum = a + b + c;
  if (!(sum > 0)) {  // no area: the best of the corners, its segments having been ruled out by rounding
    OnTriangle best = at(1, 0, 0);
    for (const OnTriangle& corner : {at(0, 1, 0), at(0, 0, 1)})
      if (corner.distance < best.distance) best = corner;
    return best;
  }
  return at(1 - b / sum - c / sum, b / sum, c / sum);
}

}  // namespace limitcheck::verify
