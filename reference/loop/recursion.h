// SPDX-License-Identifier: MIT
// The two that subdivide one face, again and again: the paper's recursive subdivider, and the points of stam.h without
// eigenvalues. They share only the masks and the basis with stam.h.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
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
template <class Point>
class SteppedFan;

/// Largest differences in double between NaiveSubdivider and StamEvaluator at depths 0 to 4, measured on the
/// stock shapes, fans and bumpy spheres. Its tests hold these numbers.
struct NaiveError {
  static constexpr double kPosition = 4e-16;  ///< relative to the diagonal of the bounding box
  static constexpr double kNormal = 2e-13;    ///< unit normal
};

/// Counter-clockwise like its control face, whose lattice points have l1 = i / 2^depth, l2 = j / 2^depth.
template <class N>
using LeafTriangle = std::array<LeafCorner<N>, 3>;

/// The recursive subdivider of section 4, as the paper lists it: every face by itself, four sub-faces at each
/// level down to the depth, limit point and normal at the leaves. Faces share nothing, so most points are
/// computed several times. Near semi-sharp tags a face is refined together with its neighbours, until they are
/// gone; around a vertex of very many faces its ring is worked out once for all of them, with the same bits.   [C18]
/// Built for double, Decimal50, Decimal100.
template <class N>
class NaiveSubdivider {
 public:
  /// Throws data::ArgumentError if the mesh is not manifold (Topology) or the tags do not fit (Sharpness).
  explicit NaiveSubdivider(const data::ControlMesh& mesh, Weights weights = Weights::kLoop);
  NaiveSubdivider(std::vector<Vec3<N>> positions, const std::vector<Triangle>& triangles,
                  Weights weights = Weights::kLoop, const SharpTags& tags = {});

  std::size_t face_count() const;

  /// Subdivides one face `depth` >= 0 times and hands 4^depth leaves to `emit`, depth first, sub-faces 0, 1,
  /// 2, 3. Any number of threads may do so at once.
  ///   error    in double NaiveError
  ///   throws   data::ArgumentError: no such face, depth < 0 or > 30
  void tessellate(std::size_t face, int depth, const std::function<void(const LeafTriangle<N>&)>& emit) const;

 private:
  std::shared_ptr<const CutMesh<N>> mesh_;
  std::shared_ptr<const std::map<std::int32_t, SteppedFan<Vec3<N>>>> fans_;  // of vertices of many faces
  Weights weights_;
};

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
