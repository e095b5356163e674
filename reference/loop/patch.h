// SPDX-License-Identifier: MIT
// A regular patch at a point, and how its parameters lie on the control face.
#pragma once

#include <algorithm>
#include <array>

#include "reference/loop/basis.h"
#include "reference/loop/vertex_limit.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// The gradients of a sub-triangle's parameters with respect to those of its face: its first and second
/// barycentric coordinate (a, b) as functions of (l1, l2) have the gradients 2^level (a1, a2), 2^level (b1,
/// b2).
struct ParameterGradients {
  int a1 = 1, a2 = 0, b1 = 0, b2 = 1;
  long level = 0;

  /// Of a sub-triangle that is turned by half a turn.
  ParameterGradients turned() const { return {-a1, -a2, -b1, -b2, level}; }
};

/// Derivatives with respect to (a, b), still to be turned into those with respect to (l1, l2).
template <class N>
struct LocalPoint {
  Vec3<N> position, a, b, aa, ab, bb;
  N a_terms{}, b_terms{};  ///< of a and b, see Tangents
};

/// The twelve points in the order of Appendix A, weighted, as differences from the fourth: exact zeros where
/// they coincide.
///   size   the largest coordinate that the points were computed from, if not their own
template <class N, class Points>
LocalPoint<N> evaluate_patch(const Points& points, const Basis<N>& basis, Order order, N size = N(0)) {
  const Vec3<N>& origin = points[3];
  std::array<Vec3<N>, 12> d;
  for (std::size_t i = 0; i < 12; ++i) d[i] = points[i] - origin;
  LocalPoint<N> s{};
  for (std::size_t i = 0; i < 12; ++i) s.position += d[i] * basis.value[i];
  s.position += origin;
  if (order == Order::kPosition) return s;
  for (std::size_t i = 0; i < 12; ++i) {
    s.a += d[i] * basis.da[i];
    s.b += d[i] * basis.db[i];
  }
  if constexpr (kRounds<N>) {
    for (std::size_t i = 0; i < 12; ++i) {
      size = std::max(size, magnitude(points[i]));
      s.a_terms += magnitude(basis.da[i]);
      s.b_terms += magnitude(basis.db[i]);
    }
    s.a_terms *= N(2) * size;  // both ends of each difference
    s.b_terms *= N(2) * size;
  }
  if (order == Order::kFirst) return s;
  for (std::size_t i = 0; i < 12; ++i) {
    s.aa += d[i] * basis.daa[i];
    s.ab += d[i] * basis.dab[i];
    s.bb += d[i] * basis.dbb[i];
  }
  return s;
}

/// Sets the derivatives of `result` by the chain rule; `first` and `second` are positive factors of the first
/// and second derivatives, in place of powers of 2^level.
template <class N>
void set_derivatives(SurfacePoint<N>& result, const LocalPoint<N>& s, const ParameterGradients& at,
                     const N& first, const N& second, Order order) {
  if (order == Order::kPosition) return;
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
  if (order == Order::kFirst) return;
  result.d11 = (s.aa * (a1 * a1) + s.ab * (N(2) * a1 * b1) + s.bb * (b1 * b1)) * second;
  result.d12 = (s.aa * (a1 * a2) + s.ab * (a1 * b2 + a2 * b1) + s.bb * (b1 * b2)) * second;
  result.d22 = (s.aa * (a2 * a2) + s.ab * (N(2) * a2 * b2) + s.bb * (b2 * b2)) * second;
  result.second_exist = true;
}

/// Sets the normal of a point from two tangents: its own, or others that span the same plane.
template <class N>
void set_normal(SurfacePoint<N>& point, const Tangents<N>& tangents, const Vec3<N>& fallback) {
  const Normal<N> normal = unit_normal(tangents, fallback);
  point.normal = normal.direction;
  point.normal_kind = normal.kind;
  point.normal_condition = normal.condition;
}
template <class N>
Tangents<N> tangents_of(const SurfacePoint<N>& point) {
  return {point.t1, point.t2, point.t1_terms, point.t2_terms};
}

/// At an extraordinary corner itself. Towards it, derivatives of order d of a mode of eigenvalue mu grow like
/// (2^d mu)^J, so that the largest mu below 1 decides:
///   interior, valence n   mu = 3/8 + cos(2 pi / n) / 4. For n = 3, 4, 5 it is below 1/2: first derivatives
///                         fall to zero. For n = 3 it is 1/4, and its mode is a quadratic polynomial on every
///                         face, A_i a^2 + 2 (A_i + A_{i+1}) a b + A_{i+1} b^2 with A_i = 2/3 of the tangent
///                         masks' direction i: second derivatives are its. All else grows without bound.
///   boundary, K faces     the mode of 1/2 is linear on every face of K <= 2, slopes +-(r_0 - r_K) / 2 along
///                         the boundary edges and 0 along the inner one; all other mu are smaller. For K = 1
///                         the next is 1/4, a multiple of (a + b)^2: second derivatives exist. For K = 2 it
///                         is 3/8: they do not. For K >= 4 one is above 1/2.
///   held, dart            none are said to exist. t1, t2 are along the two edges of a held corner; at a dart
///                         along the sharp edge and across it
///   limit        of the vertex, from the control mesh
///   n            entries of its ring
///   ring_index   of the face in that ring (Topology)
///   at           (a, b) towards the corner's next and previous neighbour in the face; level is not used
template <class N>
SurfacePoint<N> extraordinary_corner(const VertexLimit<N>& limit, std::size_t n, bool on_boundary,
                                     int ring_index, const ParameterGradients& at, Order order,
                                     VertexState state = VertexState::kOrdinary) {
  SurfacePoint<N> result;
  result.at_corner = true;
  result.position = limit.position;
  result.normal = limit.normal.direction;
  result.normal_kind = limit.normal.kind;
  result.normal_condition = limit.normal.condition;
  const Vec3<N>&c = limit.tangents.first, &s = limit.tangents.second;
  if (state == VertexState::kDart || (state == VertexState::kHeld && on_boundary)) {
    const N share = state == VertexState::kDart ? N(2) / N(static_cast<int>(n) - 1) : N(1);
    result.t1 = result.d1 = c * share;
    result.t2 = result.d2 = s * share;
    result.t1_terms = limit.tangents.first_terms * share;
    result.t2_terms = limit.tangents.second_terms * share;
    return result;
  }
  // The masks' sums over a regular polygon, or half of one, of radius 1: n / 2 inside and across, 2 along.
  const auto entries = static_cast<int>(n);
  const N half = N(1) / N(2), share = on_boundary ? N(2) / N(std::max(2, entries - 1)) : N(2) / N(entries);
  const N first_share = on_boundary ? half : share;
  const N c_terms = limit.tangents.first_terms * first_share;
  const N s_terms = limit.tangents.second_terms * share;
  Vec3<N> t1, t2;
  LocalPoint<N> local{};
  bool first = false, second = false;
  if (on_boundary) {
    t1 = c * first_share;
    t2 = s * share;
    first = n <= 3;   // one or two faces
    second = n == 2;  // one
    const Vec3<N> along = c * half;
    if (ring_index == 0) local.a = along;
    if (ring_index + 2 == entries) local.b = Vec3<N>{} - along;
    local.aa = local.ab = local.bb = s;
  } else {
    const auto& circle = circle_table<N>(static_cast<long>(n));
    const auto towards = [&](int i) {
      const std::size_t k = 2 * i % circle.cosine.size();
      return c * circle.cosine[k] + s * circle.sine[k];
    };
    const Vec3<N> a = towards(ring_index), b = towards(ring_index + 1);
    t1 = (a * N(at.a1) + b * N(at.b1)) * share;
    t2 = (a * N(at.a2) + b * N(at.b2)) * share;
    first = n <= 5 && state == VertexState::kOrdinary;
    second = n == 3;
    const N factor = N(4) / N(3);
    local.aa = a * factor;
    local.ab = (a + b) * factor;
    local.bb = b * factor;
  }
  result.d1 = t1;
  result.d2 = t2;
  if (first) set_derivatives(result, local, at, N(1), N(1), second ? order : std::min(order, Order::kFirst));
  result.t1 = t1;
  result.t2 = t2;
  result.t1_terms = on_boundary ? c_terms : c_terms + s_terms;
  result.t2_terms = on_boundary ? s_terms : c_terms + s_terms;
  return result;
}

/// The same from the vertex and its ring.
template <class N>
SurfacePoint<N> extraordinary_corner(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary,
                                     int ring_index, const ParameterGradients& at, Weights weights,
                                     Order order, VertexState state = VertexState::kOrdinary) {
  return extraordinary_corner<N>(vertex_limit(v, ring, on_boundary, weights, state), ring.size(), on_boundary,
                                 ring_index, at, order, state);
}

}  // namespace limitcheck::reference
