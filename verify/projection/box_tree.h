// SPDX-License-Identifier: MIT
// Boxes near a point.
//
// Our own few lines because no library at hand does this: the search must end when the visitor, who knows
// more about a box than its distance, says so. Boost's R-tree sorts all candidates again at every leaf,
// CGAL's AABB tree hands out one primitive, not the next, and is GPL-3.
#pragma once

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

}  // namespace limitcheck::verify
