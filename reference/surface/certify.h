// SPDX-License-Identifier: MIT
// What all certified evaluation ends in: few faces, whose control points are known to any precision. Heavy: include from
// .cpp files.
#pragma once

#include <functional>
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
