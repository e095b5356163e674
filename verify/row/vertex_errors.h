// SPDX-License-Identifier: MIT
// A tessellation with the error of each of its vertices, as the page of a report colours it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace limitcheck::verify {

struct VertexErrors {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<double> distance,
      angle;  // of each vertex, in diagonals and in degrees; negative: not looked at
  double distance_bound = 0, angle_bound = 0;
};

}  // namespace limitcheck::verify
