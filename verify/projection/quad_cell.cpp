// SPDX-License-Identifier: MIT
#include "verify/projection/quad_cell.h"

namespace limitcheck::verify {

QuadCell cell(int i, int j, int n) {
  constexpr std::array<std::array<int, 2>, 4> kCorner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const bool right = 2 * i >= n, up = 2 * j >= n;
  const int nearest = up ? (right ? 2 : 3) : (right ? 1 : 0);
  QuadCell c;
  for (int k = 0; k < 4; ++k) {
    const auto& [x, y] = kCorner[(nearest + k) % 4];
    c.corner[k] = {i + x, j + y};
  }
  return c;
}

}  // namespace limitcheck::verify
