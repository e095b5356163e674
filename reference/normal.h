// SPDX-License-Identifier: MIT
// Unit normals that are never NaN, and the limit of a vertex: position, tangents, normal.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "reference/masks.h"
#include "reference/surface_point.h"

namespace limitcheck::reference {

template <class N>
struct Normal {
  Vec3<N> direction;  ///< unit length
  NormalKind kind;
  N condition{};  ///< see SurfacePoint::normal_condition
};

/// The vector times the power of two that brings its largest coordinate to [1, 2); zero stays zero.
template <class N>
Vec3<N> rescaled(const Vec3<N>& a) {
  using T = NumberTraits<N>;
  const long e = std::max({T::exponent(a.x), T::exponent(a.y), T::exponent(a.z)});
  if (e == kZeroExponent) return a;
  return {T::scale(a.x, -e), T::scale(a.y, -e), T::scale(a.z, -e)};
}

/// a / |a| for a vector that is not zero, however small or large.
template <class N>
Vec3<N> unit(const Vec3<N>& a) {
  const Vec3<N> b = rescaled(a);
  return b * (N(1) / NumberTraits<N>::sqrt(dot(b, b)));
}

/// How many relative errors of one operation a sum of rounded points, with rounded weights, is off by at
/// most: two for each point, two for its weight, and the product, differences and additions (as these err
/// either way, their number hardly counts).
inline constexpr int kRoundingsOfATangent = 16;

/// Whether t1 x t2 can be trusted: |t1 x t2| > threshold |t1| |t2|, and more than rounding can make it:
/// |t1| e2 + |t2| e1 + e1 e2, e the error of a tangent. So a tangent that vanished but for rounding has no
/// normal. [D12]
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
    const auto scaled_terms = [](const N& terms, const Vec3<N>& tangent) {
      return T::scale(terms,
                      -std::max({T::exponent(tangent.x), T::exponent(tangent.y), T::exponent(tangent.z)}));
    };
    const N s1 = scaled_terms(t.first_terms, t.first), s2 = scaled_terms(t.second_terms, t.second);
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

/// The normal of two tangents; where they fail, that of `fallback`, a vector that may be zero; else (0, 0,
/// 1). [D12]
template <class N>
Normal<N> unit_normal(const Tangents<N>& tangents, const Vec3<N>& fallback) {
  Vec3<N> n;
  N condition;
  if (has_normal(tangents, n, condition)) return {unit(n), NormalKind::kRegular, condition};
  if (dot(rescaled(fallback), fallback) > N(0)) return {unit(fallback), NormalKind::kFallback, {}};
  return {{N(0), N(0), N(1)}, NormalKind::kArbitrary, {}};
}

/// One subdivision step of a vertex and its ring, in place. [C29]
template <class N>
void subdivide_ring(Vec3<N>& v, std::vector<Vec3<N>>& ring, bool on_boundary,
                    Weights weights = Weights::kLoop) {
  const std::vector<Vec3<N>> old = ring;
  const Vec3<N> centre = v;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    ring[i] = on_boundary && (i == 0 || i + 1 == n)
                  ? boundary_edge_point(centre, old[i])
                  : interior_edge_point(centre, old[i], old[(i + n - 1) % n], old[(i + 1) % n]);
  v = on_boundary ? boundary_vertex_point(centre, old.front(), old.back())
                  : interior_vertex_point<N>(centre, old, weights);
}

/// Sum of the ring triangles' area-weighted normals (twice the area).
template <class N>
Vec3<N> area_normal(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary) {
  Vec3<N> sum{};
  for (std::size_t i = 0; i + (on_boundary ? 1 : 0) < ring.size(); ++i)
    sum += cross(ring[i] - v, ring[(i + 1) % ring.size()] - v);
  return sum;
}

/// Where the limit of a control vertex lies and which way it faces.
template <class N>
struct VertexLimit {
  Vec3<N> position;
  Tangents<N> tangents;
  Normal<N> normal;
};

/// Limit of a vertex from its ring (masks.h); D12 decides about normals that fail: the area-weighted normal
/// of the ring after one to three steps, else of the control ring, else (0, 0, 1).
///   error    in double a few ulp of the ring's largest coordinate for the position (see stam.h)
template <class N>
VertexLimit<N> vertex_limit(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary,
                            Weights weights = Weights::kLoop) {
  VertexLimit<N> result;
  result.position =
      on_boundary ? boundary_limit(v, ring.front(), ring.back()) : interior_limit(v, ring, weights);
  result.tangents = on_boundary ? boundary_tangents(v, ring) : interior_tangents(v, ring);
  result.normal = unit_normal(result.tangents, Vec3<N>{});
  if (result.normal.kind == NormalKind::kRegular) {
    if (on_boundary && ring.size() > 6) result.normal.kind = NormalKind::kNoTangentPlane;  // K >= 6  [D5]
    return result;
  }
  // The tangents fail: facet normals may still tell where the surface faces.
  Vec3<N> centre = v, largest = area_normal(v, ring, on_boundary);
  std::vector<Vec3<N>> moving(ring.begin(), ring.end());
  for (int step = 0; step < 3; ++step) {
    subdivide_ring(centre, moving, on_boundary, weights);
    const Vec3<N> sum = area_normal<N>(centre, moving, on_boundary);
    N size{};
    for (const Vec3<N>& r : moving) size += dot(r - centre, r - centre);
    const N threshold = N(NumberTraits<N>::kNormalThreshold);
    if (dot(sum, sum) > size * size * threshold * threshold) {
      result.normal = {unit(sum), NormalKind::kFallback, {}};
      return result;
    }
  }
  result.normal = unit_normal(Tangents<N>{}, largest);
  return result;
}

}  // namespace limitcheck::reference
