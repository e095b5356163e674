// SPDX-License-Identifier: MIT
// Limit masks of Catmull and Clark's, for the quad model: on the ring of a vertex, or on what of it lies to
// one side of sharp edges. Not those of reference/, which judges.
#pragma once

#include <vector>

#include "reference/number/vec3.h"

namespace limitcheck::verify {

/// A vertex c with its neighbours e_i and, opposite c between e_i and e_{i+1}, f_i: n of each inside, K + 1
/// and K in a sector, which begins and ends at sharp edges or at the boundary.
struct QuadRing {
  using V = reference::Vec3<double>;
  V c;
  std::vector<V> e, f;
  bool closed;
};

/// Two directions, the first crossed with the second outward.
struct QuadTangents {
  QuadRing::V first, second;
};

/// With t = 2 pi / n inside and pi / K in a sector, lambda = (5 + cos t + cos(t/2) sqrt(18 + 2 cos t)) / 16.
QuadTangents quad_tangents(const QuadRing& ring);

/// Of a vertex at which one sharp edge ends, that to e_0.
QuadRing::V dart_limit(const QuadRing& ring);
QuadTangents dart_tangents(const QuadRing& ring);

}  // namespace limitcheck::verify
