// SPDX-License-Identifier: MIT
// How wrong the float kernels can be: proved bounds for a topology and all control meshes in the unit box.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fast/frame/sink.h"
#include "fast/rules/surface_vertex.h"
#include "verify/proof/numbers/error_bound_number.h"
#include "verify/proof/topologies/neighbourhood.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {

/// Half the side of the unit box: control coordinates are floats in [-1/2, 1/2].
inline constexpr double kUnitBox = .5;

/// A tangent du or dv of the kernel's own: see regular_limit and NumberStream for which multiple
/// of a derivative.
struct TangentBound {
  double error = 0;             ///< of a coordinate
  double size = 0;              ///< the largest coordinate that a mesh in the box can give it
  std::vector<double> weights;  ///< of the control points, in the exact tangent
  double relative() const { return size > 0 ? error / size : 0; }
};

/// One limit point. Errors are of a coordinate, for the worst control mesh in the box, against the exact
/// limit of that mesh. No tangents at control vertices of row streaming: their normals are made in double and
/// rounded once.
struct PointBound {
  fast::LatticePoint at;
  double position = 0;
  bool has_tangents = true;
  TangentBound du, dv;
};

/// All points of a pair, in the order in which the kernel delivers them.
struct KernelBounds {
  ProvedKernel kernel;
  int depth = 0;
  std::vector<PointBound> points;
  double position() const;
};

/// Runs the shipped kernel on BoundNumber (error_bound_number.h, where the model is stated). Covered: every
/// operation from the control points to positions and tangents, the prepass in double and its narrowing, the
/// rounding of constants, and the local origins of row streaming, whose choice counts as an operation with an
/// error of 2^-13 that cancels later. Not covered: placing a mesh (recentring rounds every coordinate once
/// more; scaling by a power of two is exact), the rule for vanishing tangents [D12], and what follows from
/// the tangents, for which see normal_angle_bound.
///   reach   of the box; bounds of the sliding window are proportional to it, those of row streaming nearly
KernelBounds bound_kernel(ProvedKernel kernel, const Neighbourhood& neighbourhood, int depth,
                          double reach = kUnitBox, const RoundingModel& model = {});

/// Upper bound in radians of the angle between the kernel's unit normal and the exact one, where the exact
/// tangents (the kernel's own) have |du x dv| >= cross > 0:
///
///     asin((3 (e_u s_v + e_v s_u + e_u e_v) + 4 sqrt(3) 2^-24 S_u S_v + 2^-60) / cross) + 2^-23
///
/// e: errors, s: sizes of a coordinate, S = s + e. A vector of three such coordinates is sqrt(3) as long;
/// each coordinate of the product costs two roundings of products and one of their difference, or with fma
/// less; 2^-60 is the bias of row streaming; the last term is the final multiplication by the inverse length,
/// one rounding per coordinate. An error of the inverse length itself is common to the coordinates and turns
/// nothing. Infinite if the fraction exceeds 1.
double normal_angle_bound(const PointBound& bound, double cross);

/// The numerator of that fraction over 3 s_u s_v, the largest |du x dv| that the sizes allow: a normal that
/// has the share q of it is right to asin(share / q) + 2^-23.
double normal_error_share(const PointBound& bound);

/// The numerator itself: how far du x dv, and what is computed from it, can be from the exact one.
double product_error(const PointBound& bound);

/// How far the length of a unit normal may be from 1: the rounding of three components, of the sum of their
/// squares, and the inverse root of row streaming (2.2e-7, see vertex-inl.h).
inline constexpr double kLengthBound = 8 * 0x1p-24;

/// The bounds, and the worst errors found by trying: random control meshes and signs at the corners of the box, then
/// changes of one coordinate at a time that make the largest error larger; and what ships, on four more meshes. The real
/// float kernel against the exact limit: positions come from the reference (Stam's evaluator in double, whose own error
/// of some 1e-16 is far below a float's), tangents from the rows of the bounds.
BoundProof search_worst(const Neighbourhood& neighbourhood, const KernelBounds& bounds, int meshes,
                        std::uint64_t seed, double reach = kUnitBox);

/// Bounds and search over the depths: what the table shows.
///   meshes   tried at each depth up to 4; a fifth of them beyond, where each has many times the points
BoundProof prove_bound(ProvedKernel kernel, const Neighbourhood& neighbourhood, int first_depth,
                       int last_depth, int meshes);

// The float kernels as they ship: with unit normals, and row streaming on every vector target of this machine.

using FloatPoints = std::vector<fast::Vec3<float>>;

/// What a kernel delivers of several control meshes of one topology.
struct Delivery {
  /// Of each mesh, in the order of LinearRuns; of row streaming from the scalar code.
  std::vector<std::vector<fast::SurfaceVertex<float>>> vertices;
  std::string targets;  ///< of row streaming: the names of all that ran, in the order of kernels()
  std::string unlike;   ///< the first whose bits are not those of the scalar code; empty: there is none
};

/// Runs the shipped code, without a placement. A batch has all meshes in its lanes, each block of four lanes in
/// another order, so that lanes and blocks that change places show.
///   meshes   positions of the neighbourhood's vertices, at least one mesh
Delivery deliver(ProvedKernel kernel, const Neighbourhood& neighbourhood, std::span<const FloatPoints> meshes,
                 int depth);

}  // namespace limitcheck::verify
