// SPDX-License-Identifier: MIT
// Loop's subdivision masks, in an order of operations that gives shared points the same bits. [mueller2000,
// 3.1; C10-C13, D1, D14]
#pragma once

#include <cmath>
#include <concepts>
#include <numbers>

#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// What the kernels need of a number type N besides + and -:
///   Scalar   what weights are made of; Scalar * N -> N
///   Wide     the number that a control vertex's ring is summed in, at least as precise as N
///   ratio    p / q, correctly rounded;   cosine, sine   of 2 pi p / q
/// Specialise it for numbers of your own. The masks branch on topology only, never on a value.
template <class N>
struct NumberTraits;

/// For float and double.
template <std::floating_point N>
struct NumberTraits<N> {
  using Scalar = N;
  using Wide = double;
  static constexpr Scalar ratio(int p, int q) { return static_cast<N>(p) / static_cast<N>(q); }
  static Scalar cosine(int p, int q) { return static_cast<N>(std::cos(2 * std::numbers::pi * p / q)); }
  static Scalar sine(int p, int q) { return static_cast<N>(std::sin(2 * std::numbers::pi * p / q)); }
  static constexpr Wide widen(N v) { return static_cast<Wide>(v); }
  static constexpr N narrow(Wide v) { return static_cast<N>(v); }
};

/// A vector of the number that rings are summed in.
template <class N>
using WideVec3 = Vec3<typename NumberTraits<N>::Wide>;

/// The same vector in the wide number, exactly.
template <class N>
constexpr WideVec3<N> widen(const Vec3<N>& v) {
  return {NumberTraits<N>::widen(v.x), NumberTraits<N>::widen(v.y), NumberTraits<N>::widen(v.z)};
}
/// The vector rounded to N.
template <class N>
constexpr Vec3<N> narrow(const WideVec3<N>& v) {
  return {NumberTraits<N>::narrow(v.x), NumberTraits<N>::narrow(v.y), NumberTraits<N>::narrow(v.z)};
}

/// The six neighbours of a regular vertex, counter-clockwise, seen from an axis W - v - E. A point on a
/// control edge takes that edge as its axis; then a half turn (the same edge seen from its other face) swaps
/// E with W, NE with SW, NW with SE, and every sum below keeps its bits.
///
///        NW --- NE
///        / \   / \            .
///       W --- v --- E
///        \ /   \ /
///        SW --- SE
template <class N>
struct AxisRing {
  const Vec3<N>&e, &ne, &nw, &w, &sw, &se;
};

// The rules below are written as a point plus a small difference: in float that halves the error of a level.

/// Edge rule (3 a + 3 b + c + d) / 8, a and b the ends, c and d opposite. [eq. 2; C12]
template <class N>
constexpr Vec3<N> edge_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
  using T = NumberTraits<N>;
  const Vec3<N> ends = a + b;
  return T::ratio(1, 2) * ends + T::ratio(1, 8) * ((c + d) - ends);
}

/// Edge rule on the boundary. [D1]
template <class N>
constexpr Vec3<N> midpoint(const Vec3<N>& a, const Vec3<N>& b) {
  return NumberTraits<N>::ratio(1, 2) * (a + b);
}

/// The sum of the six; it has the same bits from the opposite direction.
template <class N>
constexpr Vec3<N> axis_sum(const AxisRing<N>& r) {
  return (r.e + r.w) + ((r.ne + r.nw) + (r.sw + r.se));
}

/// Vertex rule for valence 6: (10 v + ring) / 16. [eq. 1; C10, C11]
template <class N>
constexpr Vec3<N> regular_vertex(const Vec3<N>& v, const AxisRing<N>& r) {
  using T = NumberTraits<N>;
  return v + T::ratio(1, 16) * (axis_sum(r) - T::ratio(6, 1) * v);
}

/// Vertex rule on the boundary: (6 v + e + w) / 8, e and w its neighbours along the boundary. [D1]
template <class N>
constexpr Vec3<N> curve_vertex(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& w) {
  using T = NumberTraits<N>;
  return v + T::ratio(1, 8) * ((e + w) - T::ratio(2, 1) * v);
}

/// a(n) = 5/8 - (3 + 2 c)^2 / 64 from c = cos(2 pi / n). [C11]
template <class S>
S loop_a(const S& c) {
  const S b = S(3) + S(2) * c;
  return S(5) / S(8) - b * b / S(64);
}

/// Vertex rule of an interior vertex of valence n: centre * v + ring * (r_0 + .. + r_{n-1}). [eq. 1; C10]
template <class N>
struct VertexWeights {
  using Scalar = typename NumberTraits<typename NumberTraits<N>::Wide>::Scalar;
  Scalar centre{}, ring{};
};

/// The weights for valence n >= 3.
template <class N>
VertexWeights<N> vertex_weights(int n) {
  using Wide = typename NumberTraits<N>::Wide;
  const auto a = loop_a(NumberTraits<Wide>::cosine(1, n));
  return {NumberTraits<Wide>::ratio(1, 1) - a, NumberTraits<Wide>::ratio(1, n) * a};
}

}  // namespace limitcheck::fast
