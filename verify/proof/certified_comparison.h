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
  double normal = 0;    ///< degrees; likewise, of the angle between the normals where derivatives exist
  double radius = 0;    ///< largest radius of an enclosure, included above
  int face = -1;        ///< where the position is worst
  std::string l1, l2;   ///< or u, v; of a face that is no quad at the corner
  int corner = 0;
  /// What a bound for the unit box is a bound of here: the side of a box about the origin that holds the mesh, a
  /// power of two; 2^-24 of it more for placing the mesh.
  double unit = 0;
  /// 1 / |d1 x d2| in that unit, and what rounding the control points to the kernel's coordinates turns a normal
  /// by (its sine): the largest at any point whose normal was compared.
  double condition = 0, placing = 0;
};

/// What proofs of topologies say of a kernel: the largest of their rows.
struct ProvedBounds {
  double position = 0, product = 0;  ///< BoundProof::position_bound and product_bound
  /// What they allow the errors of a mesh: of the diagonal, and degrees.
  double position_of(const CertifiedErrors& errors) const;
  double normal_of(const CertifiedErrors& errors) const;
  bool hold(const CertifiedErrors& errors) const {
    return errors.position <= position_of(errors) && errors.normal <= normal_of(errors);
  }
};

enum class FloatKernel : std::uint8_t { kSlidingWindow, kRowStream };

/// Tessellates the mesh, of triangles by Loop's scheme and others by Catmull-Clark's, with the float kernel
/// and compares about `points` of its lattice points, spread evenly over the output, with the exact limit:
/// Stam's evaluator in ball arithmetic at `digits` digits, the control points taken as the floats they are.
/// Upper bounds: float to double is exact, a decimal is read to 2^-53 of itself, and radius and reading are
/// added. Points without two derivatives that span a plane count for positions alone: their normals are made
/// in double, and compared in the proofs of the topologies.
///   throws   data::ArgumentError: a coordinate that is no float
CertifiedErrors compare_certified(FloatKernel kernel, const data::ControlMesh& mesh, int depth, int points,
                                  int digits = 20);

/// One mesh, one kernel.
struct CertifiedLine {
  std::string mesh, kernel;
  int depth = 0;
  CertifiedErrors errors;
};

/// The stock shapes of the audit, of Catmull-Clark's scheme a choice of its meshes: lines to be certified.
std::vector<CertifiedLine> stock_shape_lines(const std::vector<FloatKernel>& kernels, int depth,
                                             data::Scheme scheme = data::Scheme::kLoop);
/// Fills in their errors, on all cores.
void certify(std::vector<CertifiedLine>& lines, int points);

}  // namespace limitcheck::verify
