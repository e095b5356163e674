// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>

#include "data/control_mesh.h"
#include "fast/frame/sink.h"

namespace limitcheck::bench {

/// A triangle of a frame and how it lies to the exact surface: at its middle, the drawn point's distance from
/// the point of the same parameter, and the interpolated normal's angle to the exact one in degrees.
struct TriangleError {
  const fast::Draw* draw = nullptr;
  std::int32_t triangle = 0;  // of the draw
  double position = 0, normal = 0;
};

/// Calls `with` for every triangle of a frame with provenance, of depths up to 5.
void each_triangle_error(const data::ControlMesh& mesh, const fast::DrawList<float>& frame,
                         const std::function<void(const TriangleError&)>& with);

}  // namespace limitcheck::bench
