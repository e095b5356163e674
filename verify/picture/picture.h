// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace limitcheck::verify {

/// The shade that each pixel shows, in 0 .. 255, not rounded; kNothing where no surface is. Top row first.
struct Picture {
  static constexpr float kNothing = -1;

  int width = 0, height = 0;
  std::vector<float> shade;

  float at(int x, int y) const {
    return shade[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

}  // namespace limitcheck::verify
