// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// Diagonal of the bounding box of a mesh with vertices: what lengths are compared with.
inline double box_diagonal(const ControlMesh& mesh) {
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    double low = mesh.positions.at(0)[c], high = low;
    for (const auto& p : mesh.positions) low = std::min(low, p[c]), high = std::max(high, p[c]);
    square += (high - low) * (high - low);
  }
  return std::sqrt(square);
}

}  // namespace limitcheck::data
