// SPDX-License-Identifier: MIT
// A point of a patch, and how the patch's own parameters lie on the control face. The same in both schemes.
#pragma once

#include "reference/number/number.h"
#include "reference/number/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// The gradients of a piece's two parameters (a, b) with respect to those of its face: 2^level (a1, a2) and
/// 2^level (b1, b2). Of a sub-triangle they are its first and second barycentric coordinate.
struct ParameterGradients {
  int a1 = 1, a2 = 0, b1 = 0, b2 = 1;
  long level = 0;

  /// Of a sub-triangle that is turned by half a turn.
  ParameterGradients turned() const { return {-a1, -a2, -b1, -b2, level}; }
};

/// Derivatives with respect to (a, b), still to be turned into those with respect to the face's parameters.
template <class N>
struct LocalPoint {
  Vec3<N> position, a, b, aa, ab, bb;
  N a_terms{}, b_terms{};  ///< of a and b, see Tangents
};

/// Sets the derivatives of `result` by the chain rule; `first` and `second` are positive factors of the first
/// and second derivatives, in place of powers of 2^level.
template <class N>
void set_derivatives(SurfacePoint<N>& result, const LocalPoint<N>& s, const ParameterGradients& at,
                     const N& first, const N& second, Derivatives order) {
  if (order == Derivatives::kPosition) return;
  const N a1(at.a1), a2(at.a2), b1(at.b1), b2(at.b2);
  result.d1 = (s.a * a1 + s.b * b1) * first;
  result.d2 = (s.a * a2 + s.b * b2) * first;
  result.t1 = result.d1;
  result.t2 = result.d2;
  if constexpr (kRounds<N>) {
    result.t1_terms = (s.a_terms * magnitude(a1) + s.b_terms * magnitude(b1)) * first;
    result.t2_terms = (s.a_terms * magnitude(a2) + s.b_terms * magnitude(b2)) * first;
  }
  result.first_exist = true;
  if (order == Derivatives::kFirst) return;
  result.d11 = (s.aa * (a1 * a1) + s.ab * (N(2) * a1 * b1) + s.bb * (b1 * b1)) * second;
  result.d12 = (s.aa * (a1 * a2) + s.ab * (a1 * b2 + a2 * b1) + s.bb * (b1 * b2)) * second;
  result.d22 = (s.aa * (a2 * a2) + s.ab * (N(2) * a2 * b2) + s.bb * (b2 * b2)) * second;
  result.second_exist = true;
}

}  // namespace limitcheck::reference
