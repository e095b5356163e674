// SPDX-License-Identifier: MIT
// Loop's rules on the regular lattice, times 8 per level. Included by kernel.h and targets.cpp, each in a
// namespace of its own.
//
// Bits: the edge rule is symmetric in its two ends and in its two apexes. The six-neighbour rules are written
// with an axis: half a turn about the point swaps the operands of every addition and negates every
// difference, so two pairs that share an edge, and take it as the axis, compute the same bits from it. [claim
// D14]

enum class Axis { kRow, kColumn, kDiagonal };

template <class V>
struct Hexagon {  // seen along the axis: e ahead, w behind
  V e, ne, nw, w, sw, se;
};

template <class V>
HWY_ATTR inline V ring_sum(const Hexagon<V>& h) {
  return (h.e + h.w) + ((h.ne + h.nw) + (h.sw + h.se));
}

/// 8 (3/8 (a + b) + 1/8 (c + d)).
template <class N, class V>
HWY_ATTR inline V edge_rule(V a, V b, V c, V d) {
  return N::fma(N::splat(3), a + b, c + d);
}

/// 8 (5/8 v + 1/16 sum).
template <class N, class V>
HWY_ATTR inline V vertex_rule(V v, V sum) {
  return N::fma(N::splat(5), v, N::splat(.5) * sum);
}

/// The six neighbours of number k of row m, below s and above n; `lanes` numbers each, three to a point.
template <class N, Axis axis>
HWY_ATTR inline Hexagon<typename N::V> hexagon(const typename N::Scalar* s, const typename N::Scalar* m,
                                               const typename N::Scalar* n) {
  constexpr int step = 3 * N::lanes;
  const auto e = N::load(m + step), w = N::load(m - step);
  const auto ne = N::load(n + step), nw = N::load(n);
  const auto sw = N::load(s - step), se = N::load(s);
  if constexpr (axis == Axis::kRow) return {e, ne, nw, w, sw, se};
  if constexpr (axis == Axis::kColumn) return {nw, w, sw, se, e, ne};
  if constexpr (axis == Axis::kDiagonal) return {ne, nw, w, sw, se, e};
}

/// Limit of a regular point: 12 position = 6 v + sum, and two tangents along and across the axis.   [eq. 3;
/// C14, C17]
template <class V>
struct Limit {
  V position, along, across;
};

template <class N, class V>
HWY_ATTR inline Limit<V> limit_rule(V v, const Hexagon<V>& h) {
  const V north = h.ne + h.nw, south = h.sw + h.se;
  return {N::fma(N::splat(6), v, (h.e + h.w) + (north + south)),
          N::fma(N::splat(2), h.e - h.w, (h.ne - h.nw) + (h.se - h.sw)), north - south};
}

/// Unit vector along a x b. The bias keeps a zero product from becoming NaN: it then yields (0, 0, 1);
/// elsewhere it is below the rounding of any product a mesh scaled to size 1 can have. Adding 0 turns -0 into
/// +0.
template <class N, class V>
HWY_ATTR inline void unit_normal(const V (&a)[3], const V (&b)[3], V (&out)[3]) {
  V c[3] = {N::fms(a[1], b[2], a[2] * b[1]), N::fms(a[2], b[0], a[0] * b[2]),
            N::fms(a[0], b[1], N::fms(a[1], b[0], N::splat(0x1p-60)))};
  const V inverse = N::inverse_root(N::fma(c[0], c[0], N::fma(c[1], c[1], c[2] * c[2])));
  for (int k = 0; k < 3; ++k) out[k] = N::fma(c[k], inverse, N::splat(0));
}
