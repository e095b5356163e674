// SPDX-License-Identifier: MIT
// Faults planted in the operations of a kernel that runs on rows of weights. For tests.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "fast/mesh/vec3.h"
#include "verify/proof/numbers/fault.h"
#include "verify/proof/numbers/residue.h"
#include "verify/proof/numbers/stencil.h"

namespace limitcheck::verify::test {

inline constexpr std::array kFaultKinds{StencilFault::Kind::kFactor, StencilFault::Kind::kDropped,
                                        StencilFault::Kind::kDoubled, StencilFault::Kind::kNeighbour,
                                        StencilFault::Kind::kCoordinate};

/// Equal weights of the same control points.
inline bool same(const Stencil<Residue>& a, const Stencil<Residue>& b) {
  return a.constant() == b.constant() &&
         std::ranges::equal(a.entries(), b.entries(), [](const auto& x, const auto& y) {
           return x.point == y.point && x.weight == y.weight;
         });
}
inline bool same(const fast::Vec3<Stencil<Residue>>& a, const fast::Vec3<Stencil<Residue>>& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// How many operations a run does that a fault of a kind could spoil.
template <class Run>
std::int64_t operations_of(StencilFault::Kind kind, Run&& run) {
  constexpr std::int64_t kFar = std::int64_t{1} << 40;
  const StencilFault counter(kind, kFar);
  run();
  return kFar - counter.left();
}

}  // namespace limitcheck::verify::test
