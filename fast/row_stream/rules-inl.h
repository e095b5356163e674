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
HWY_ATTR HWY_INLINE V ring_sum(const Hexagon<V>& h) {
  return (h.e + h.w) + ((h.ne + h.nw) + (h.sw + h.se));
}

/// 8 (3/8 (a + b) + 1/8 (c + d)).
template <class N, class V>
HWY_ATTR HWY_INLINE V edge_rule(V a, V b, V c, V d) {
  return N::fma(N::splat(3), a + b, c + d);
}

/// 8 (5/8 v + 1/16 sum).
template <class N, class V>
HWY_ATTR HWY_INLINE V vertex_rule(V v, V sum) {
  return N::fma(N::splat(5), v, N::splat(.5) * sum);
}

/// The six neighbours of number k of row m, below s and above n; `lanes` numbers each, three to a point.
template <class N, Axis axis>
HWY_ATTR HWY_INLINE Hexagon<typename N::V> hexagon(const typename N::Scalar* s, const typename N::Scalar* m,
                                                   const typename N::Scalar* n) {
  constexpr int step = 3 * N::lanes;
  const auto e = N::load(m + step), w = N::load(m - step);
  const auto ne = N::load(n + step), nw = N::load(n);
  const auto sw = N::load(s - step), se = N::load(s);
  if constexpr (axis == Axis::kRow) return {e, ne, nw, w, sw, se};
  if constexpr (axis == Axis::kColumn) return {nw, w, sw, se, e, ne};
  if constexpr (axis == Axis::kDiagonal) return {ne, nw, w, sw, se, e};
}

/// Limit of a regular point: 12 position = 6 v + sum; of the tangents u = 2 (e - w) + ne - nw + se - sw along
/// the axis and across = ne + nw - sw - se, (u + across) / 2 is cheaper than u and spans the same plane with
/// it.  [C14, C17]
template <class V>
struct Limit {
  V position, slant, across;
};

template <class N, class V>
HWY_ATTR HWY_INLINE Limit<V> limit_rule(V v, const Hexagon<V>& h) {
  const V north = h.ne + h.nw, south = h.sw + h.se;
  return {N::fma(N::splat(6), v, (h.e + h.w) + (north + south)), (h.e - h.w) + (h.ne - h.sw), north - south};
}

/// 1 / sqrt(x) for normal x > 0, relative error 1.4e-7 (measured). The same operations on every machine,
/// unlike the processors' own estimates; square root and division would be exact but twice as slow. A seed
/// to 3.5 % from the halved exponent, then a step of third and one of second order on h = 1 - x y^2.
template <class N, class V>
HWY_ATTR HWY_INLINE V inverse_root(V x) {
  if constexpr (!N::kHasSeed) {
    return N::inverse_root(x);
  } else {
    V y = N::inverse_root_seed(x);
    V h = N::fnma(x * y, y, N::splat(1));
    y = N::fma(y, N::fma(h, N::splat(.375), N::splat(.5)) * h, y);
    h = N::fnma(x * y, y, N::splat(1));
    return N::fma(N::splat(.5) * y, h, y);
  }
}

/// a x b to out[0..2]. The bias makes a zero product (0, 0, 1); elsewhere it is below the rounding of any
/// product a mesh scaled to size 1 can have. It comes last: parallel tangents may have exact products, in
/// which it would drown. [claim D12]
template <class N, class V>
HWY_ATTR HWY_INLINE void normal_direction(const V (&a)[3], const V (&b)[3], V* out) {
  out[0] = N::fms(a[1], b[2], a[2] * b[1]);
  out[1] = N::fms(a[2], b[0], a[0] * b[2]);
  out[2] = N::fms(a[0], b[1], a[1] * b[0]) + N::splat(0x1p-60);
}

/// To unit length. Adding 0 turns -0 into +0.
template <class N, class V>
HWY_ATTR HWY_INLINE void normalise(V& x, V& y, V& z) {
  const V inverse = inverse_root<N>(N::fma(x, x, N::fma(y, y, z * z)));
  x = N::fma(x, inverse, N::splat(0));
  y = N::fma(y, inverse, N::splat(0));
  z = N::fma(z, inverse, N::splat(0));
}

/// What a point keeps of its tangents a and b: the unit normal, or a linear image of them.
template <class N, class V>
HWY_ATTR HWY_INLINE void normal_of(const V (&a)[3], const V (&b)[3], V (&normal)[3]) {
  if constexpr (N::kLinear) {
    for (int c = 0; c < 3; ++c) normal[c] = N::tangent(a[c], b[c]);
  } else {
    normal_direction<N>(a, b, normal);
    normalise<N>(normal[0], normal[1], normal[2]);
  }
}
