// SPDX-License-Identifier: MIT
// The cubic B-spline curve that boundaries and creases are in both schemes: it does not depend on interior
// vertices. [D1]
#pragma once

#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// Boundary vertex: 1/8 --- 3/4 --- 1/8.
template <class N>
Vec3<N> boundary_vertex_point(const Vec3<N>& v, const Vec3<N>& first, const Vec3<N>& last) {
  return v + ((first - v) + (last - v)) * (N(1) / N(8));
}

/// Boundary edge: 1/2 --- 1/2.
template <class N>
Vec3<N> boundary_edge_point(const Vec3<N>& a, const Vec3<N>& b) {
  return (a + b) * (N(1) / N(2));
}

/// Limit of a boundary vertex: 1/6 --- 2/3 --- 1/6.
template <class N>
Vec3<N> boundary_limit(const Vec3<N>& v, const Vec3<N>& first, const Vec3<N>& last) {
  return v + ((first - v) + (last - v)) * (N(1) / N(6));
}

}  // namespace limitcheck::reference
