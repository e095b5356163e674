// SPDX-License-Identifier: MIT
// The points of stam.h by repeated subdivision. This evaluator needs no eigenvalues and shares only the masks
// and the basis with stam.h.
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

template <class N>
struct CutMesh;

/// Subdivides the face and its ring, always into the sub-face that holds the point, until that is regular (a
/// box spline patch, Appendix A) or the point is its corner (limit masks). The number of steps grows with
/// -log2 of the distance to the extraordinary vertex, and so does the rounding error of the derivatives.
/// Built for double, Decimal50, Decimal100.
///   threads   any number may evaluate at once
template <class N>
class SubdivisionEvaluator {
 public:
  /// As StamEvaluator.
  explicit SubdivisionEvaluator(const data::ControlMesh& mesh, Weights weights = Weights::kLoop);
  SubdivisionEvaluator(std::vector<Vec3<N>> positions, const std::vector<Triangle>& triangles,
                       Weights weights = Weights::kLoop, const SharpTags& tags = {});

  int face_count() const;
  /// As StamEvaluator::evaluate; parameters are followed exactly, whatever they are.
  SurfacePoint<N> evaluate(int face, const Parameter& l1, const Parameter& l2,
                           Derivatives order = Derivatives::kSecond) const;

 private:
  std::shared_ptr<const CutMesh<N>> mesh_;
  Weights weights_;
};

}  // namespace limitcheck::reference
