// SPDX-License-Identifier: MIT
// The part of a large mesh that the surface at one point depends on, small even at a vertex of a million faces; and what
// all certified evaluation ends in: few faces, whose control points are known to any precision. Heavy: include from .cpp
// files.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "data/faces.h"
#include "data/scheme.h"
#include "reference/loop/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/number/ball.h"
#include "reference/number/number_exact.h"
#include "reference/number/vec3.h"
#include "reference/point/parameter.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {

/// Face 0 is the face with the point, or the quad that it is in after a step; its surface there is that of the whole
/// mesh, exactly, with the same parameters.
struct NearPart {
  data::Faces faces;
  std::vector<std::array<Rational, 3>> positions;
  Valences valences;
  int corner = 0;  ///< of face 0
};

/// Around a vertex of n faces, and in the middle of a face of n corners, a point hears of those that are near, as many
/// on either side as there are steps before it is away from the vertex; of all others it hears through the means of
/// the ring alone: of the neighbours, and by Catmull-Clark's scheme of the faces' centroids (masks.h). So these stay
/// what they are if all that is far is left out and few points take its place that make up the means.
///   position   of a vertex, in doubles
///   most       faces at a vertex, or corners of a face, of which nothing is left out
///   returns    nothing where the mesh has no such vertex near the face; where the point lies at it, which hears of all;
///              where it is on the boundary, or two faces of many corners touch
std::optional<NearPart> near_part(const Topology& topology,
                                  const std::function<std::array<double, 3>(std::int32_t)>& position,
                                  data::Scheme scheme, int face, int corner, const Parameter& u,
                                  const Parameter& v, int most);

/// A point of face 0 of a mesh, and all that the surface depends on there.
struct PartWithPoint {
  data::Faces faces;
  SharpTags tags;
  Valences valences;
  int corner;
  Parameter u, v;
  /// Of the derivatives: those by other parameters, of which so many times the change is one of u and v.
  Rational factor = 1;
  /// The control points, to Ball::precision().
  std::function<std::vector<Vec3<Ball>>()> positions;
};

/// To so many digits, as CertifiedEvaluator::evaluate says.
CertifiedPoint certify(const PartWithPoint& part, data::Scheme scheme, Weights weights, int digits,
                       Wanted wanted);

}  // namespace limitcheck::reference
