// SPDX-License-Identifier: MIT
// Surface points by repeated subdivision: no eigenvalues, nothing shared with stam.h but masks and basis.
#pragma once

#include <memory>
#include <vector>

#include "data/faces.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/number/vec3.h"
#include "reference/point/parameter.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference::catmull_clark {

template <class N>
struct QuadMesh;

/// Subdivides the quad that holds the point and its neighbourhood, always into the sub-quad with the point,
/// until that is regular (a bicubic patch) or the point is its corner (limit masks). The number of steps
/// grows with -log2 of the distance to the extraordinary vertex, and so does the rounding error of its
/// derivatives. Built for double, Decimal50, Decimal100, and Rational: there exact at every valence, but
/// without normals and without
/// tangents at extraordinary corners.                                   [the paper's ref. 1]
///   threads   any number may evaluate at once
template <class N>
class SubdivisionEvaluator {
 public:
  /// Throws data::ArgumentError if the mesh is not manifold (Topology) or the tags do not fit (Sharpness).
  SubdivisionEvaluator(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags = {});

  int face_count() const;
  /// At (u, v) of a quad, whose corners are (0, 0), (1, 0), (1, 1), (0, 1), with `corner` 0; at (u, v) of the
  /// sub-quad at `corner` of any other face, which is split into one quad for each corner: (0, 0) at the
  /// corner, (1, 0) in the middle of the edge to the next. d1 and d2 are the derivatives by u and v.
  /// Parameters are followed exactly.
  ///   throws   data::ArgumentError: no such face or corner, u or v outside 0 .. 1
  SurfacePoint<N> evaluate(int face, int corner, const Parameter& u, const Parameter& v,
                           Derivatives order = Derivatives::kSecond) const;

 private:
  std::shared_ptr<const QuadMesh<N>> mesh_;
};

}  // namespace limitcheck::reference::catmull_clark
