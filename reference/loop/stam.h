// SPDX-License-Identifier: MIT
// The exact evaluator: Stam's method for Loop surfaces, at any corner valences and boundaries.
//
//   J. Stam, Evaluation of Loop Subdivision Surfaces, 1998. One subdivision step leaves at most one
//   extraordinary vertex per sub-face. Sub-faces without one are box spline patches (Appendix A). Near one
//   inside, the J-th power of the subdivision matrix of its two-ring comes from the matrix's eigenvalues
//   (two_ring.h), so that the cost does not depend on how near the point is; near others the steps are taken
//   (stepped_ring.h). One more step then gives the twelve control points of a regular piece.
#pragma once

#include <memory>
#include <vector>

#include "data/control_mesh.h"
#include "reference/loop/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/point/parameter.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

namespace detail {
template <class N>
class StamData;
}

/// Largest errors of StamEvaluator<double>, measured against 50 and 100 digits on the known answers and on
/// the stock shapes. Its tests hold these numbers.
struct StamError {
  static constexpr double kPosition = 2;  ///< in ulp of the largest control coordinate
  /// d1, d2: the same, beside 2^-52 |d1| log2(1 / distance to the nearest extraordinary corner).
  static constexpr double kFirst = 8;
  /// Position, d1, d2: relative, down to 1e-300 from a corner. On the boundary itself, beside a vertex of four faces
  /// and more, relative to the larger of d1 and d2, which outgrows the other one there.
  static constexpr double kNearCorner = 1e-13;
  static constexpr double kNormal = 2e-15;  ///< unit normal, beside what the errors of d1 and d2 make of it
};

/// Limit surface of a control mesh, Loop's or Warren's weights, B-spline boundary with the ordinary interior
/// rule next to it. Built for double, Decimal50, Decimal100 (number_exact.h) and Ball (ball.h).
///
///   construction  O(n)
///   a point       near a vertex of few faces inside O(their number); of 65 and more, on the boundary, or held,
///                 O(J^2), where 2^-J is the distance from the vertex; near a dart of n faces O(J n)
///   threads       any number may evaluate at once
///   error         in double StamError; second derivatives beyond 1e308 come out infinite, and so may others
///                 nearer than 1e-307 to a vertex
///   parameters    l1, l2 >= 0, l1 + l2 <= 1.
///                 Corners, edges and every dyadic point are ordinary points.
///                 Two doubles whose rounded sum is 1 lie on the far edge.
template <class N>
class StamEvaluator {
 public:
  /// The mesh must be valid (data/validate.h). Throws data::ArgumentError if it is not manifold (Topology).
  explicit StamEvaluator(const data::ControlMesh& mesh, Weights weights = Weights::kLoop);
  /// Control points in the number type itself.
  ///   valences   of vertices that have more faces; of points at such a vertex itself nothing can be said
  StamEvaluator(std::vector<Vec3<N>> positions, const std::vector<Triangle>& triangles,
                Weights weights = Weights::kLoop, const SharpTags& tags = {}, Valences valences = {});

  int face_count() const;
  /// Throws data::ArgumentError for a face that is not there and for parameters outside the triangle.
  SurfacePoint<N> evaluate(int face, double l1, double l2, Derivatives order = Derivatives::kSecond) const;
  SurfacePoint<N> evaluate(int face, const Parameter& l1, const Parameter& l2,
                           Derivatives order = Derivatives::kSecond) const;

 private:
  std::shared_ptr<const detail::StamData<N>> data_;
};

}  // namespace limitcheck::reference
