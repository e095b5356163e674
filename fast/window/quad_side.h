// SPDX-License-Identifier: MIT
// One side of a quad while the quad is subdivided: a boundary, smooth, or semi-sharp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fast/rules/prepared_quads.h"

namespace limitcheck::fast {

/// What the window asks of a side. Parts are counted from one of its ends.
class QuadSide {
 public:
  /// `depth` levels are to come.
  ///   reversed   count parts from the target of half-edge h
  template <class N, class Surface>
  void fill(const PreparedQuads<N, Surface>& mesh, std::int32_t h, int depth, bool reversed) {
    inside_ = mesh.mesh().adjacency.twin(h) >= 0;
    reversed_ = reversed;
    creasing_ = mesh.mesh().creasing;
    if (mesh.semi_sharp().has(h))
      mesh.semi_sharp().along(h, depth + 1, sharpness_);
    else
      sharpness_.clear();
  }

  /// Whether there is a face beyond.
  bool inside() const { return inside_; }
  bool semi_sharp() const { return !sharpness_.empty(); }
  /// The share of the midpoint in the point of part i of 2^level, and of the curve in point i = 1 .. 2^level
  /// - 1.
  double edge_share(int level, int i) const {
    if (sharpness_.empty()) return 0;
    const SidePart p = part(level, i);
    return edge_crease_share(p.sharpness, p.first_half, p.second_half);
  }
  double point_share(int level, int i) const {
    if (sharpness_.empty()) return 0;
    return curve_share(at(level, i - 1), at(level, i), creasing_);
  }
  bool sharp_at(int level, int i) const {
    return !sharpness_.empty() && (at(level, i - 1) > 0 || at(level, i) > 0);
  }
  SidePart part(int level, int i) const {
    return {at(level, i), at(level + 1, 2 * i), at(level + 1, 2 * i + 1)};
  }
  data::Creasing creasing() const { return creasing_; }

 private:
  double at(int level, int i) const {
    const std::size_t n = std::size_t{1} << level, k = static_cast<std::size_t>(i);
    return sharpness_[n - 1 + (reversed_ ? n - 1 - k : k)];
  }

  bool inside_ = false, reversed_ = false;
  data::Creasing creasing_ = data::Creasing::kUniform;
  std::vector<double> sharpness_;
};

}  // namespace limitcheck::fast
