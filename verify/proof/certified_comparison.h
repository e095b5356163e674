// SPDX-License-Identifier: MIT
// The float kernels against certified enclosures of the surface: an error that is a fact about the true
// surface.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"

namespace limitcheck::verify {

/// Over the points looked at. Lengths are of the control mesh's bounding-box diagonal.
struct CertifiedErrors {
  std::int64_t points = 0;
  double position = 0;  ///< no point is farther from the true surface's than this
  double normal = 0;    ///< degrees; likewise, of the angle between the normals
  double radius = 0;    ///< largest radius of an enclosure, included above
  int face = -1;        ///< where the position is worst
  std::string l1, l2;   ///< or u, v; of a face that is no quad at the corner
  int corner = 0;
};

enum class FloatKernel : std::uint8_t { kSlidingWindow, kRowStream };

/// Tessellates the mesh, of triangles by Loop's scheme and others by Catmull-Clark's, with the float kernel
/// and compares about `points` of its lattice points, spread evenly over the output, with the exact limit:
/// Stam's evaluator in ball arithmetic at `digits` digits, the control points taken as the floats they are.
/// Upper bounds: float to double is exact, a decimal is read to
/// 2^-53 of itself, and radius and reading are added. Points whose normal is no limit of tangents count for
/// positions alone.
///   throws   data::ArgumentError: a coordinate that is no float
CertifiedErrors compare_certified(FloatKernel kernel, const data::ControlMesh& mesh, int depth, int points,
                                  int digits = 20);

/// One mesh, one kernel.
struct CertifiedLine {
  std::string mesh, kernel;
  int depth = 0;
  CertifiedErrors errors;
};

/// The stock shapes of the audit, of Catmull-Clark's scheme a choice of its meshes, on all cores.
std::vector<CertifiedLine> certify_stock_shapes(const std::vector<FloatKernel>& kernels, int depth,
                                                int points, data::Scheme scheme = data::Scheme::kLoop);

}  // namespace limitcheck::verify
