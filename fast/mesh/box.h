// SPDX-License-Identifier: MIT
// The bounding box of the points of a mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "data/control_mesh.h"

namespace limitcheck::fast {

/// Of one point or more.
struct Box {
  explicit Box(const data::ControlMesh& mesh) : Box(mesh.positions) {}
  explicit Box(std::span<const std::array<double, 3>> positions) : low(positions.front()), high(low) {
    for (const auto& p : positions) {
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    }
  }
  double middle(std::size_t axis) const { return low[axis] / 2 + high[axis] / 2; }
  /// The longest side.
  double size() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }

  std::array<double, 3> low, high;
};

}  // namespace limitcheck::fast
