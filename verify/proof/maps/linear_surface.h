// SPDX-License-Identifier: MIT
// What the kernels make of a limit point in proofs.
#pragma once

#include <cstdint>

#include "fast/rules/surface_vertex.h"

namespace limitcheck::verify {

/// Position and two tangents, whose plane is the tangent plane: all that is linear in a limit point.
template <class N>
struct LinearSurface {
  using Vertex = fast::LimitFrame<N>;
  static constexpr bool kLinear = true;
  static Vertex vertex(const Vertex& frame, auto&& /*substitute*/, std::int64_t& /*zero_normals*/) {
    return frame;
  }
};

}  // namespace limitcheck::verify
