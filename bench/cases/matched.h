// SPDX-License-Identifier: MIT
// Frames against the limit surface, and speed at equal error: who computes less exactly pays for it here.
#pragma once

#include <cstdint>
#include <functional>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "fast/frame/sink.h"
#include "fast/mesh/vec3.h"
#include "fast/plan/depth.h"
#include "reference/point/surface_point.h"

namespace limitcheck::bench {

/// The middle of a drawn triangle, and the limit surface's point at the same parameter.
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

/// The bounds that points have to keep: of positions in diagonals of the bounding box, and of unit normals in rad.
struct PointBound {
  double position = 0x1p-22, normal = 0x1p-16;
};

/// The largest errors of a frame's vertices against the limit surface of the control mesh in double (StamError).
/// The frame has provenance. NaN if it has no vertices, or one that is NaN.
PointBound worst_errors(const data::ControlMesh& mesh, data::Scheme scheme,
                        const fast::DrawList<float>& frame);

/// How far, on the screen of `camera` and in pixels, the middle of a drawn triangle is from the point of the limit
/// surface at the same parameter: not exceeded by 99 % of the pixels that triangles seen from the front cover (each
/// counted with its own triangles, hidden ones as well). The mesh has triangles or quads; the frame has provenance. NaN if
/// nothing is seen from the front, or a vertex is NaN.
double pixel_error(const data::ControlMesh& mesh, data::Scheme scheme, const fast::Camera& camera,
                   const fast::DrawList<float>& frame);

/// The largest target of 2^(k/4), k = 32 .. -4, whose error is at most `pixels`, by bisection; 0: none is.
///   error_at   of a strategy with that target; does not fall as targets grow, but by little
double matching_target(double pixels, const std::function<double(double target)>& error_at);

}  // namespace limitcheck::bench
