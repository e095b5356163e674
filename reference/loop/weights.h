// SPDX-License-Identifier: MIT
// The two families of weights that an interior vertex can have.
#pragma once

#include <cstdint>

namespace limitcheck::reference {

/// They give the same surface where all interior valences are 3 or 6, and different ones elsewhere. Edges and
/// boundaries have the same rules in both.
enum class Weights : std::uint8_t {
  kLoop,   ///< Loop 1987: the ring has the weight a(n) = 5/8 - (3 + 2 cos(2 pi / n))^2 / 64 together
  kWarren  ///< Warren's simplification: 3/8, and 9/16 at n = 3. libigl, geometry-central and Open3D have it.
};

}  // namespace limitcheck::reference
