// SPDX-License-Identifier: MIT
// Coordinates of generated meshes: every one is exact in float.
#pragma once

#include <bit>
#include <cstdint>

namespace limitcheck::data {

/// The nearest float (ties to even). It also hides the last bits in which the sines of two C libraries may
/// differ. By integers, because g++ 12 at -O2 drops a conversion to float and back where it vectorises the
/// two.
inline double rounded(double x) {
  auto bits = std::bit_cast<std::uint64_t>(x);
  bits += 0x0fffffff + (bits >> 29 & 1);
  return std::bit_cast<double>(bits & ~std::uint64_t{0x1fffffff});
}

}  // namespace limitcheck::data
