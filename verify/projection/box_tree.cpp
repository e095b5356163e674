// SPDX-License-Identifier: MIT
#include "verify/projection/box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace limitcheck::verify {
namespace {

constexpr std::int32_t kLeaf = 4;

double squared_distance(const Vector& p, const BoxTree::Box& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = std::max({box.low[axis] - p[axis], p[axis] - box.high[axis], 0.0});
    sum += d * d;
  }
  return sum;
}

void extend(BoxTree::Box& box, const BoxTree::Box& by) {
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], by.low[axis]);
    box.high[axis] = std::max(box.high[axis], by.high[axis]);
  }
}

}  // namespace

BoxTree::Box BoxTree::around(std::initializer_list<Vector> points, double margin) {
  Box box{*points.begin(), *points.begin()};
  for (const Vector& p : points) extend(box, {p, p});
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] -= margin;
    box.high[axis] += margin;
  }
  return box;
}

BoxTree::BoxTree(const std::vector<Box>& boxes) : order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes.empty()) build(boxes, 0, static_cast<std::int32_t>(boxes.size()));
  boxes_.reserve(boxes.size());
  for (const std::uint32_t k : order_) boxes_.push_back(boxes[k]);
}

void BoxTree::build(const std::vector<Box>& boxes, std::int32_t begin, std::int32_t end) {
  const std::size_t self = nodes_.size();
  Node node{boxes[order_[begin]], -1, begin, end};
  for (std::int32_t k = begin; k < end; ++k) extend(node.box, boxes[order_[k]]);
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return;
  const Vector size = node.box.high - node.box.low;
  const auto axis = std::max_element(size.begin(), size.end()) - size.begin();
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return boxes[a].low[axis] + boxes[a].high[axis] <
                            boxes[b].low[axis] + boxes[b].high[axis];
                   });
  build(boxes, begin, middle);
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(boxes, middle, end);
}

void BoxTree::near(const Vector& p, const std::function<double(std::size_t)>& visit) const {
  double within = std::numeric_limits<double>::infinity();  // squared
  const auto descend = [&](const auto& again, std::int32_t at) -> void {
    const Node& node = nodes_[at];
    if (node.right < 0) {
      for (std::int32_t k = node.begin; k < node.end; ++k) {
        if (squared_distance(p, boxes_[k]) > within) continue;
        const double bound = std::max(visit(order_[k]), 0.0);
        within = bound * bound;
      }
      return;
    }
    std::pair first{squared_distance(p, nodes_[node.right].box), node.right};
    std::pair last{squared_distance(p, nodes_[at + 1].box), at + 1};
    if (last.first < first.first) std::swap(first, last);
    for (const auto& [distance, child] : {first, last})
      if (distance <= within) again(again, child);
  };
  if (!nodes_.empty()) descend(descend, 0);
}

}  // namespace limitcheck::verify
