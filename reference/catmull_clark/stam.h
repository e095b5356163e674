// SPDX-License-Identifier: MIT
// Surface points without subdivision: the exact evaluation of Stam [1998], by powers of the two-ring's map.
#pragma once

#include <memory>
#include <vector>

#include "data/faces.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "reference/point/parameter.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference::catmull_clark {

namespace detail {
template <class N>
class StamData;
}

/// Two steps at most for the whole mesh, once; then a bicubic patch, or, next to an extraordinary vertex, the
/// two-ring after J steps at a cost that grows with log J (two_ring.h). Built for double, Decimal50,
/// Decimal100 and Ball.
///   error     in double positions within one unit in the last place of the largest coordinate (measured:
///             0.9); derivatives within 4 * 2^-53 (t1_terms + J |d1|), since the J-th power is that of a
///             rounded eigenvalue
///   threads   any number may evaluate at once
template <class N>
class StamEvaluator {
 public:
  /// Throws data::ArgumentError if the mesh is not manifold (Topology) or the tags do not fit (Sharpness).
  ///   valences   of vertices that have more faces, in a mesh without tags, and, from the number of vertices on, of
  ///              faces that have more corners: the points in their middle. Of points at such a vertex itself
  ///              nothing can be said
  StamEvaluator(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags = {},
                const Valences& valences = {});

  int face_count() const;
  /// As SubdivisionEvaluator::evaluate.
  SurfacePoint<N> evaluate(int face, int corner, const Parameter& u, const Parameter& v,
                           Derivatives order = Derivatives::kSecond) const;
  /// The same with parameters that are doubles, for speed.
  SurfacePoint<N> evaluate(int face, int corner, double u, double v,
                           Derivatives order = Derivatives::kSecond) const;

 private:
  std::shared_ptr<const detail::StamData<N>> data_;
};

}  // namespace limitcheck::reference::catmull_clark
