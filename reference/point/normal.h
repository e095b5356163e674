// SPDX-License-Identifier: MIT
// Tangents, and unit normals that are never NaN.
#pragma once

#include <algorithm>
#include <span>

#include "reference/number/number.h"
#include "reference/number/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// Two tangents, sums of weighted points; first x second points outwards.
///   first_terms, second_terms   sum of |weight| magnitude(point): a relative error u of the points or of the
///                               sum moves the tangent by some u times that. A tangent no larger than this
///                               is not a direction but what rounding left of one. 0 unless kRounds<N>
template <class N>
struct Tangents {
  Vec3<N> first, second;
  N first_terms{}, second_terms{};
};

/// Adds weight * (a - b), and its terms.
template <class N>
inline void add_difference(Vec3<N>& sum, N& terms, const N& weight, const Vec3<N>& a, const Vec3<N>& b) {
  sum += (a - b) * weight;
  if constexpr (kRounds<N>) terms += (magnitude(a) + magnitude(b)) * magnitude(weight);
}

/// A normal, and how it came about.
template <class N>
struct Normal {
  Vec3<N> direction;  ///< unit length
  NormalKind kind;
  N condition{};  ///< see SurfacePoint::normal_condition
};

/// Where the limit of a vertex lies and which way it faces. Of quads without tangents and normal in exact rationals.
template <class N>
struct VertexLimit {
  Vec3<N> position;
  Tangents<N> tangents;
  Normal<N> normal;
};

/// The exponent of the largest coordinate.
template <class N>
long exponent(const Vec3<N>& a) {
  using T = NumberTraits<N>;
  if constexpr (kRounds<N>) return T::exponent(magnitude(a));
  return std::max({T::exponent(a.x), T::exponent(a.y), T::exponent(a.z)});
}

/// The vector times the power of two that brings its largest coordinate to [1, 2); zero stays zero.
template <class N>
Vec3<N> rescaled(const Vec3<N>& a) {
  using T = NumberTraits<N>;
  const long e = exponent(a);
  return e == kZeroExponent ? a : Vec3<N>{T::scale(a.x, -e), T::scale(a.y, -e), T::scale(a.z, -e)};
}

/// a / |a| for a vector that is not zero, however small or large.
template <class N>
Vec3<N> unit(const Vec3<N>& a) {
  const Vec3<N> b = rescaled(a);
  return b * (N(1) / NumberTraits<N>::sqrt(dot(b, b)));
}

/// The error of a tangent, a sum of rounded points with rounded weights, in relative errors of one operation:
/// two for each point, two for its weight, and the rest for the product, the differences and the additions
/// (these err either way, so that their number hardly counts).
inline constexpr int kRoundingsOfATangent = 16;

/// Whether t1 x t2 can be trusted: it is larger than threshold |t1| |t2| and than what rounding can make of
/// it, |t1| e2 + |t2| e1 + e1 e2, where e is the error of a tangent. So a tangent that vanishes but for
/// rounding gives no normal.   [D12]
///   cross_product  receives t1 x t2 up to a positive factor
///   condition      receives (|t1| s2 + |t2| s1) / |t1 x t2|, s the terms
template <class N>
bool has_normal(const Tangents<N>& t, Vec3<N>& cross_product, N& condition) {
  using T = NumberTraits<N>;
  const Vec3<N> a = rescaled(t.first), b = rescaled(t.second);
  cross_product = cross(a, b);
  const N aa = dot(a, a), bb = dot(b, b), square = dot(cross_product, cross_product);
  condition = N(0);
  if (!(square > aa * bb * (N(T::kNormalThreshold) * N(T::kNormalThreshold)))) return false;
  if constexpr (kRounds<N>) {
    // In the scale that `rescaled` chose: to compare with e1, e2 as with a and b.
    const N s1 = T::scale(t.first_terms, -exponent(t.first)),
            s2 = T::scale(t.second_terms, -exponent(t.second));
    const N u = N(kRoundingsOfATangent) * N(T::kRounding), size = T::sqrt(square);
    const N turn = T::sqrt(aa) * s2 + T::sqrt(bb) * s1;
    condition = turn / size;
    return size > u * (turn + u * s1 * s2);
  }
  return true;
}

/// Whether t1 x t2 loses several digits: their angle has a sine below 1/100.
template <class N>
bool nearly_parallel(const Vec3<N>& t1, const Vec3<N>& t2) {
  const Vec3<N> a = rescaled(t1), b = rescaled(t2), c = cross(a, b);
  return N(10000) * dot(c, c) < dot(a, a) * dot(b, b);
}

/// The normal of two tangents. Where they fail it is `fallback`, made a unit vector, and where that is zero
/// (0, 0, 1).   [D12]
template <class N>
Normal<N> unit_normal(const Tangents<N>& tangents, const Vec3<N>& fallback) {
  Vec3<N> n;
  N condition;
  if (has_normal(tangents, n, condition)) return {unit(n), NormalKind::kRegular, condition};
  if (dot(rescaled(fallback), fallback) > N(0)) return {unit(fallback), NormalKind::kFallback, {}};
  return {{N(0), N(0), N(1)}, NormalKind::kArbitrary, {}};
}

/// Sum of the ring triangles' area-weighted normals (twice the area).
template <class N>
Vec3<N> area_normal(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary) {
  Vec3<N> sum{};
  for (std::size_t i = 0; i + (on_boundary ? 1 : 0) < ring.size(); ++i)
    sum += cross(ring[i] - v, ring[(i + 1) % ring.size()] - v);
  return sum;
}

/// Whether normals can be had: not in exact rationals, which have no square roots.
template <class N>
inline constexpr bool kHasNormals = requires(N a) {
  NumberTraits<N>::sqrt(a);
};

/// Sets the normal of a point from two tangents: its own, or others that span the same plane.
template <class N>
void set_normal(SurfacePoint<N>& point, const Tangents<N>& tangents, const Vec3<N>& fallback) {
  if constexpr (kHasNormals<N>) {
    const Normal<N> normal = unit_normal(tangents, fallback);
    point.normal = normal.direction;
    point.normal_kind = normal.kind;
    point.normal_condition = normal.condition;
  }
}
/// Of a point, with what is known of their terms.
template <class N>
Tangents<N> tangents_of(const SurfacePoint<N>& point) {
  return {point.t1, point.t2, point.t1_terms, point.t2_terms};
}

}  // namespace limitcheck::reference
