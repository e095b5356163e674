// SPDX-License-Identifier: MIT
// Edges between two interior vertices of six triangles each, which are polynomials.
//
// Bits: with t counted from the middle of an edge, half a turn about that negates t, the odd coefficients of a position
// and the even ones of a tangent, exactly: so two grids that share the edge compute the same bits from it. [claim D14]

#if defined(LIMITCHECK_FAST_STREAM_REGULAR_EDGE_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_REGULAR_EDGE_INL_H_
#undef LIMITCHECK_FAST_STREAM_REGULAR_EDGE_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_REGULAR_EDGE_INL_H_
#endif

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/vertex-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// A regular vertex at an end of an edge.
template <class N>
struct RegularEnd {
  using V = typename N::V;
  const typename N::Scalar* block;  // see CornerBlock
  int other, width;                 // which entry of its window the other end is, of how many

  HWY_ATTR HWY_INLINE V centre(int c) const { return N::load(block + (CornerBlock::kCentre + c) * N::lanes); }
  /// The six points around it counter-clockwise, number 0 the other end.
  HWY_ATTR HWY_INLINE V ring(int k, int c) const {
    const int t = other + k < width ? other + k : other + k - 6;
    return N::load(block + (CornerBlock::kWindow + 3 * t + c) * N::lanes);
  }
};

/// The quartic that the surface is along an edge P Q, and the quadratic that its derivative across is: from the ten
/// points around, seen from an origin near the edge.
///
///        l0    l1    l2          Both in t = -1/2 .. 1/2, the position times 12.
///     m0    P     Q     m3
///        r0    r1    r2
template <class N>
class RegularEdge {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  HWY_ATTR RegularEdge(const RegularEnd<N>& p, const RegularEnd<N>& q, const Placement<Scalar>& placement)
      : unit_(N::splat(limit_unit(placement.unit, 0))) {
    V origin[3];
    choose_middle<N>(p.block + CornerBlock::kCentre * L, q.block + CornerBlock::kCentre * L, origin);
    for (int c = 0; c < 3; ++c) {
      const auto seen = [&](const V& x) HWY_ATTR { return x - origin[c]; };
      const V m0 = seen(p.ring(3, c)), m1 = seen(p.centre(c)), m2 = seen(q.centre(c)),
              m3 = seen(q.ring(3, c));
      const V l0 = seen(p.ring(2, c)), l1 = seen(p.ring(1, c)), l2 = seen(q.ring(4, c));
      const V r0 = seen(p.ring(4, c)), r1 = seen(p.ring(5, c)), r2 = seen(q.ring(2, c));
      const V near = m1 + m2, far = m0 + m3, u1 = l1 + r1, u02 = (l0 + r0) + (l2 + r2), v1 = l1 - r1,
              v02 = (l0 - r0) + (l2 - r2);
      const V ahead = m2 - m1, far_ahead = m3 - m0;
      const V bend = far - near, side_bend = N::fma(N::splat(-2), u1, u02);
      const V sums = N::fma(N::splat(63), near, N::fma(N::splat(26), u1, N::splat(3) * u02));
      put(kPosition, c, N::splat(1. / 16) * (far + sums));
      put(kPosition + 1, c,
          N::fma(N::splat(.5), far_ahead, N::fma(N::splat(6.5), ahead, (l2 + r2) - (l0 + r0))));
      put(kPosition + 2, c, N::splat(1.5) * (bend + side_bend));
      put(kPosition + 3, c, N::splat(2) * N::fma(N::splat(-3), ahead, far_ahead));
      put(kPosition + 4, c, bend - side_bend);
      put(kAcross, c, N::fma(N::splat(1.5), v1, N::splat(.25) * v02));
      put(kAcross + 1, c, (l2 - r2) - (l0 - r0));
      put(kAcross + 2, c, N::fma(N::splat(-2), v1, v02));
      put(kOrigin, c, N::fma(origin[c], N::splat(placement.unit), N::splat(placement.centre[c])));
    }
  }

  /// One coordinate of the point at t, whose square is given, too; see begin_vertex().
  HWY_ATTR HWY_INLINE void coordinate(V t, V square, int c, Vertex<N>& v, V (&along)[3],
                                      V (&across)[3]) const {
    const V two = N::splat(2), c2 = get(kPosition + 2, c), c3 = get(kPosition + 3, c),
            c4 = get(kPosition + 4, c);
    const V even = N::fma(c4, square, c2), odd = N::fma(c3, square, get(kPosition + 1, c));
    const V position = N::fma(t, odd, N::fma(even, square, get(kPosition, c)));
    v.position[c] = N::fma(position, unit_, get(kOrigin, c));
    along[c] = N::fma(t, two * N::fma(c4, square, even), N::fma(two * c3, square, odd));
    across[c] = N::fma(t, get(kAcross + 1, c), N::fma(get(kAcross + 2, c), square, get(kAcross, c)));
  }

 private:
  static constexpr int kPosition = 0, kAcross = 5, kOrigin = 8, kSize = 9;
  HWY_ATTR HWY_INLINE void put(int k, int c, const V& x) { N::store(x, numbers_ + (3 * k + c) * L); }
  HWY_ATTR HWY_INLINE V get(int k, int c) const { return N::load(numbers_ + (3 * k + c) * L); }

  alignas(64) Scalar numbers_[3 * kSize * L];
  V unit_;
};

/// Points k + 1 .. of 2^depth of an edge in turn, see begin_vertex(). k / 2^depth and its square are exact: so the points
/// of a depth are those of the next, bit by bit.
template <class N>
class RegularEdgeRow {
 public:
  using V = typename N::V;

  HWY_ATTR HWY_INLINE RegularEdgeRow(const RegularEdge<N>& edge, int depth, int k)
      : edge_(edge), step_(1. / (1 << depth)), t_(k * step_ - .5) {}
  template <bool odd>
  HWY_ATTR HWY_INLINE void advance() {
    t_ += step_;
  }
  template <bool odd>
  HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&along)[3], V (&across)[3]) const {
    edge_.coordinate(N::splat(t_), N::splat(t_ * t_), c, v, along, across);
  }

 private:
  const RegularEdge<N>& edge_;
  double step_, t_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
