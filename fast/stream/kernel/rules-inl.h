// SPDX-License-Identifier: MIT
// Loop's rules on the regular lattice, times 8 per level.
//
// Bits: the edge rule is symmetric in its two ends and in its two apexes. The six-neighbour rules are written
// with an axis: half a turn about the point swaps the operands of every addition and negates every
// difference, so two grids that share an edge, and take it as the axis, compute the same bits from it.
// [claim D14]
//
// This file and the others of the kernel are compiled once for each of Highway's targets, and once for
// numbers that are no vectors (kernel.h). So their include guards are those of Highway's own -inl.h files.

#if defined(LIMITCHECK_FAST_STREAM_RULES_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_RULES_INL_H_
#undef LIMITCHECK_FAST_STREAM_RULES_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_RULES_INL_H_
#endif

#ifndef HWY_NAMESPACE  // kernel.h has one of its own
#include <hwy/highway.h>
#endif

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

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

/// Neighbours seen along the row, seen along another axis.
template <Axis axis, class V>
HWY_ATTR HWY_INLINE Hexagon<V> turned(const Hexagon<V>& h) {
  if constexpr (axis == Axis::kRow) return h;
  if constexpr (axis == Axis::kColumn) return {h.nw, h.w, h.sw, h.se, h.e, h.ne};
  if constexpr (axis == Axis::kDiagonal) return {h.ne, h.nw, h.w, h.sw, h.se, h.e};
}

/// The six neighbours of number k of row m, below s and above n; `lanes` numbers each, three to a point.
template <class N, Axis axis>
HWY_ATTR HWY_INLINE Hexagon<typename N::V> hexagon(const typename N::Scalar* s, const typename N::Scalar* m,
                                                   const typename N::Scalar* n) {
  constexpr int step = 3 * N::lanes;
  return turned<axis>(Hexagon<typename N::V>{N::load(m + step), N::load(n + step), N::load(n),
                                             N::load(m - step), N::load(s - step), N::load(s)});
}

/// Limit of a regular point: 12 position = 6 v + sum; of the tangents u = 2 (e - w) + ne - nw + se - sw along
/// the axis and across = ne + nw - sw - se, (u + across) / 2 is cheaper than u and spans the same plane with
/// it. [C14, C17]
template <class V>
struct Limit {
  V position, slant, across;
};

template <class N, class V>
HWY_ATTR HWY_INLINE Limit<V> limit_rule(V v, const Hexagon<V>& h) {
  const V north = h.ne + h.nw, south = h.sw + h.se;
  return {N::fma(N::splat(6), v, (h.e + h.w) + (north + south)), (h.e - h.w) + (h.ne - h.sw), north - south};
}

/// Half the sum of p and q, with few enough digits that moving there and back costs hardly any. The same in
/// either order. Numbers without rounding have no digits to save.
template <class N, class V>
HWY_ATTR HWY_INLINE void choose_middle(const typename N::Scalar* p, const typename N::Scalar* q, V* origin) {
  const V magic = N::splat(0x1.8p11);  // a float of that size ends at 2^-12, a double at 2^-41
  for (int c = 0; c < 3; ++c)
    origin[c] = (N::splat(.5) * (N::load(p + c * N::lanes) + N::load(q + c * N::lanes)) + magic) - magic;
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
