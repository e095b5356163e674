// SPDX-License-Identifier: MIT
// The middles of a frame's triangles, and the limit surface's points at the same parameters.
#pragma once

#include <cstdint>
#include <functional>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "fast/frame/sink.h"
#include "fast/mesh/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::bench {

struct TriangleMiddle {
  const fast::Draw* draw = nullptr;
  std::int32_t triangle = 0;      // of the draw
  fast::Point3 position, normal;  // as drawn: the mean position, and the sum of the normals
  reference::SurfacePoint<double> exact;
};

/// Calls `with` for every triangle of a frame with provenance, of depths up to 5. The faces are triangles of Loop's
/// scheme or quads.
void each_triangle_middle(const data::ControlMesh& mesh, data::Scheme scheme,
                          const fast::DrawList<float>& frame, reference::Derivatives order,
                          const std::function<void(const TriangleMiddle&)>& with);

}  // namespace limitcheck::bench
