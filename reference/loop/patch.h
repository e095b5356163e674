// SPDX-License-Identifier: MIT
// The surface at a point of a regular patch, and at an extraordinary corner.
#pragma once

#include <algorithm>
#include <array>

#include "reference/loop/basis.h"
#include "reference/loop/vertex_limit.h"
#include "reference/point/local_point.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// The twelve points in the order of Appendix A, weighted, as differences from the fourth: exact zeros where
/// they coincide.
///   size   the largest coordinate that the points were computed from, if not their own
template <class N, class Points>
LocalPoint<N> evaluate_patch(const Points& points, const Basis<N>& basis, Derivatives order, N size = N(0)) {
  const Vec3<N>& origin = points[3];
  std::array<Vec3<N>, 12> d;
  for (std::size_t i = 0; i < 12; ++i) d[i] = points[i] - origin;
  LocalPoint<N> s{};
  for (std::size_t i = 0; i < 12; ++i) s.position += d[i] * basis.value[i];
  s.position += origin;
  if (order == Derivatives::kPosition) return s;
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
  if (order == Derivatives::kFirst) return s;
  for (std::size_t i = 0; i < 12; ++i) {
    s.aa += d[i] * basis.daa[i];
    s.ab += d[i] * basis.dab[i];
    s.bb += d[i] * basis.dbb[i];
  }
  return s;
}

/// At an extraordinary corner itself. Which derivatives there are is said by vertex_limit.h; those that are
/// not zero are the polynomials of their modes:
///   interior, valence 3   A_i a^2 + 2 (A_i + A_{i+1}) a b + A_{i+1} b^2 on face i, with A_i = 2/3 of the
///                         tangent masks' direction i
///   boundary, K <= 2      slopes +-(r_0 - r_K) / 2 along the boundary edges and 0 along the inner one. For
///                         K = 1 a multiple of (a + b)^2 besides
///   held, K = 2           slopes r_0 - c and r_2 - c along the ends, their sum along the inner edge
///   dart, valence 6       that of the tangents, as in a regular vertex
/// Tangents t1, t2: along the two edges of a held corner; at a dart along the sharp edge and across it.
///   limit        of the vertex, from the control mesh
///   n            entries of its ring
///   ring_index   of the face in that ring (Topology)
///   at           (a, b) towards the corner's next and previous neighbour in the face; level is not used
template <class N>
SurfacePoint<N> extraordinary_corner(const VertexLimit<N>& limit, std::size_t n, bool on_boundary,
                                     int ring_index, const ParameterGradients& at, Weights weights,
                                     Derivatives order, VertexState state = VertexState::kOrdinary) {
  SurfacePoint<N> result;
  result.at_corner = true;
  result.position = limit.position;
  result.normal = limit.normal.direction;
  result.normal_kind = limit.normal.kind;
  result.normal_condition = limit.normal.condition;
  const auto entries = static_cast<int>(n), faces = entries - (on_boundary ? 1 : 0);
  result.limits = {leading_modes(faces, on_boundary, state, weights),
                   on_boundary && state != VertexState::kDart};
  const DerivativeLimit &first = result.limits.first, &second = result.limits.second;
  const Vec3<N>&c = limit.tangents.first, &s = limit.tangents.second;
  const auto around = [&](int i, const N& share) {  // towards neighbour i of a regular polygon
    const auto& circle = circle_table<N>(static_cast<long>(faces));
    const std::size_t k = 2 * static_cast<std::size_t>(i) % circle.cosine.size();
    return (c * circle.cosine[k] + s * circle.sine[k]) * share;
  };
  // The masks' sums over a regular polygon, or half of one, of radius 1: n / 2 inside and across, 2 along.
  N c_share(1), s_share(1);
  LocalPoint<N> local{};
  Vec3<N> t1, t2;
  if (state == VertexState::kDart) {
    c_share = s_share = N(2) / N(faces);
    if (first.fate == Fate::kValue)
      local.a = around(ring_index, c_share), local.b = around(ring_index + 1, c_share);
  } else if (!on_boundary) {
    c_share = s_share = N(2) / N(faces);
    const Vec3<N> a = around(ring_index, N(1)), b = around(ring_index + 1, N(1));
    t1 = (a * N(at.a1) + b * N(at.b1)) * c_share;
    t2 = (a * N(at.a2) + b * N(at.b2)) * c_share;
    const N factor = N(4) / N(3);
    local.aa = a * factor;
    local.ab = (a + b) * factor;
    local.bb = b * factor;
  } else if (state == VertexState::kHeld) {
    const auto along = [&](int i) { return i == 0 ? c : i == faces ? s : c + s; };
    local.a = along(ring_index), local.b = along(ring_index + 1);
  } else {
    c_share = N(1) / N(2), s_share = N(2) / N(std::max(2, faces));
    const Vec3<N> along = c * c_share;
    if (ring_index == 0) local.a = along;
    if (ring_index + 1 == faces) local.b = Vec3<N>{} - along;
    local.aa = local.ab = local.bb = s;
  }
  const N c_terms = limit.tangents.first_terms * c_share, s_terms = limit.tangents.second_terms * s_share;
  if (on_boundary) t1 = c * c_share, t2 = s * s_share;
  result.d1 = t1;
  result.d2 = t2;
  if (first.exists())
    set_derivatives(result, local, at, N(1), N(1),
                    second.exists() ? order : std::min(order, Derivatives::kFirst));
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
                                     Derivatives order, VertexState state = VertexState::kOrdinary) {
  return extraordinary_corner<N>(vertex_limit(v, ring, on_boundary, weights, state), ring.size(), on_boundary,
                                 ring_index, at, weights, order, state);
}

}  // namespace limitcheck::reference
