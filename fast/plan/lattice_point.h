// SPDX-License-Identifier: MIT
// A place on a control face.
#pragma once

#include <cstdint>

namespace limitcheck::fast {

/// Where a vertex lies on `face`: l1 = i / denominator, l2 = j / denominator, or (u, v) likewise on a quad.
/// Lattice points of depth d have denominator 2^d, the centre of a triangle's fan i = j = 1 and denominator
/// 3. A face of Catmull-Clark's scheme that is no quad has a quad at each `corner`, with a (u, v) of its own
/// whose denominator is 2^(d-1), at least 1.
struct LatticePoint {
  std::int32_t face = -1;
  std::uint32_t i = 0, j = 0;
  std::uint32_t denominator = 1;
  std::int32_t corner = 0;
  friend constexpr bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

}  // namespace limitcheck::fast
