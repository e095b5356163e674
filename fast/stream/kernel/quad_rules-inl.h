// SPDX-License-Identifier: MIT
// Catmull-Clark's rules on the regular lattice, times 4 per level, and at a ring; the neighbourhood of a corner from
// level to level; and sides between two interior vertices of four quads, which are polynomials.
//
// Bits: every rule is first applied across a line and then along it. A point on a side, or next to one, takes
// the side for that line; half a turn about the point then swaps the operands of every addition and negates
// every difference, so two quads that share the side compute the same bits from it. Next to a corner two
// sides would disagree: those points come from the corner's ring, by rules that have no line. [claim D14]

#if defined(LIMITCHECK_FAST_STREAM_QUAD_RULES_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_RULES_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_RULES_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_RULES_INL_H_
#endif

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/rules-inl.h"
#include "fast/stream/kernel/vertex-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// 2 (a + 6 b + c) / 8: the child of b. The child between a and b is 2 (a + b) / 2 = a + b.
template <class N, class V>
HWY_ATTR HWY_INLINE V even_rule(V a, V b, V c) {
  return N::fma(N::splat(.25), (a + b) + (b + c), b);
}

/// a + 4 b + c: six times the limit at b.
template <class N, class V>
HWY_ATTR HWY_INLINE V limit_filter(V a, V b, V c) {
  return N::fma(N::splat(4), b, a + c);
}

/// 4 (c + e + f + e') / 4 of the quad between e and e'; by diagonals, so that all four of its corners agree.
template <class V>
HWY_ATTR HWY_INLINE V face_rule(V c, V e, V f, V after) {
  return (c + f) + (e + after);
}

/// 4 (c + e + F + F') / 4, where f and g are 4 F and 4 F'.
template <class N, class V>
HWY_ATTR HWY_INLINE V ring_edge_rule(V c, V e, V f, V g) {
  return N::fma(N::splat(.25), f + g, c + e);
}

/// One level of a corner: its centre, the sums of differences to its ring, and the ring's entries e f e f ...
/// from `first` to before `end`: a closed ring, or a window of it, which loses two entries at either end.
/// open: in lane k the entries ends[0] and ends[1] are the ends of the ring, on sharp edges.
template <class N, bool closed, bool open>
HWY_ATTR void refine_quad_ring(typename N::Scalar* block, int first, int end) {
  using V = typename N::V;
  using Block = QuadCornerBlock;
  constexpr int L = N::lanes;
  const auto number = [&](int k) HWY_ATTR { return N::load(block + k * L); };
  const V k0 = number(0), k1 = number(1), k2 = number(2), k3 = number(3), k4 = number(4);
  const V start = number(Block::kEnds), stop = number(Block::kEnds + 1);
  for (int c = 0; c < 3; ++c) {
    typename N::Scalar* entry = block + (Block::kWindow + c) * L;
    const auto at = [&](int t) { return entry + 3 * t * L; };
    const V v = number(Block::kCentre + c), de = number(Block::kEdges + c), df = number(Block::kFaces + c);

    V here = N::load(at(first));
    for (int t = first + 1; t + 1 < end; t += 2) {
      const V after = N::load(at(t + 1));
      N::store(face_rule(v, here, N::load(at(t)), after), at(t));
      here = after;
    }
    V before = N::load(at(first + 1));
    if constexpr (closed) {
      before = face_rule(v, here, N::load(at(end - 1)), N::load(at(first)));
      N::store(before, at(end - 1));
    }
    for (int t = closed ? first : first + 2; t + 1 < end; t += 2) {
      const V e = N::load(at(t)), f = N::load(at(t + 1));
      V refined = ring_edge_rule<N>(v, e, before, f);
      if constexpr (open) {
        const V position = N::splat(t), sharp = N::equal(position, start) + N::equal(position, stop);
        refined = N::select(sharp, N::splat(2) * (v + e), refined);
      }
      N::store(refined, at(t));
      before = f;
    }

    N::store(N::fma(k1, df, N::fma(k0, de, N::splat(4) * v)), block + (Block::kCentre + c) * L);
    const V both = k2 * de;
    N::store(N::fma(k3, df, both), block + (Block::kEdges + c) * L);
    N::store(N::fma(k4, df, both), block + (Block::kFaces + c) * L);
  }
}

/// A point of a side from its 3 x 3 neighbours in the side's own frame: x along it, the right of it in row 0,
/// the left in row 2. sharp: null, or 1 where the surface has nothing beyond; inner: the row of the inside, 0
/// or 2. Normal of any length.
template <class N>
HWY_ATTR HWY_INLINE void side_limit(const typename N::Scalar* const (&at)[3][3],
                                    const typename N::Scalar* sharp, int inner, const typename N::V* centre,
                                    typename N::V unit, Vertex<N>& out) {
  using V = typename N::V;
  V along[3], across[3];
  for (int c = 0; c < 3; ++c) {
    V p[3], q[3];
    for (int k = 0; k < 3; ++k) {
      const int shift = c * N::lanes;
      const V r = N::load(at[0][k] + shift), m = N::load(at[1][k] + shift), l = N::load(at[2][k] + shift);
      p[k] = limit_filter<N>(r, m, l);
      q[k] = l - r;
      if (sharp) {
        const V mask = N::load(sharp);
        p[k] = N::select(mask, N::splat(6) * m, p[k]);
        q[k] = N::select(mask, N::splat(2) * (inner == 2 ? l - m : m - r), q[k]);
      }
    }
    out.position[c] = N::fma(limit_filter<N>(p[0], p[1], p[2]), unit, centre[c]);
    along[c] = p[2] - p[0];
    across[c] = limit_filter<N>(q[0], q[1], q[2]);
  }
  out.set_normal(along, across);
}

/// Corner k of the quads of a batch, or a copy of it.
template <class N>
class QuadCorner {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  using Block = QuadCornerBlock;
  static constexpr int L = N::lanes;

  HWY_ATTR QuadCorner(const QuadBatch<Scalar>& batch, int corner)
      : block_(batch.input + corner * quad_block_size(batch.depth) * L),
        dart_(batch.darts >> corner & 1
                  ? batch.input + (quad_dart_offset(batch.depth) + corner * quad_dart_size(batch.depth)) * L
                  : nullptr),
        depth_(batch.depth),
        period_(batch.period[corner]),
        open_(batch.open >> corner & 1) {}

  const Scalar* centre() const { return block_ + Block::kCentre * L; }
  const Scalar* limit() const { return block_ + Block::kLimit * L; }
  /// Entry `core` of the ring, 0 for e- up to 7 for f''.
  const Scalar* ring(int core) const {
    const int t = period_ == 0 ? 2 * depth_ + core : core >= period_ ? core - period_ : core;
    return block_ + (Block::kWindow + 3 * t) * L;
  }
  const Scalar* point(RingPoint p) const { return p == kHub ? centre() : ring(p - 1); }

  /// Seen from an origin, in `to`, where it is from now on; that may be where it was. At level 0 only.
  HWY_ATTR void move(const V* origin, Scalar* to) {
    const int entries = period_ > 0 ? period_ : quad_window_width(depth_);
    if (to != block_) {
      for (int k = 0; k < Block::kWindow; ++k) N::store(N::load(block_ + k * L), to + k * L);
    }
    for (int c = 0; c < 3; ++c) {
      N::store(N::load(centre() + c * L) - origin[c], to + (Block::kCentre + c) * L);
      for (int t = Block::kWindow + c; t < Block::kWindow + 3 * entries; t += 3)
        N::store(N::load(block_ + t * L) - origin[c], to + t * L);
    }
    block_ = to;
  }

  /// From a level to the next.
  HWY_ATTR void refine(int level) {
    // A ring that is there as a whole stays whole.
    const int first = period_ > 0 ? 0 : 2 * level;
    const int end = period_ > 0 ? period_ : quad_window_width(depth_) - 2 * level;
    if (dart_ != nullptr) {
      V before[3];
      for (int c = 0; c < 3; ++c) before[c] = N::load(centre() + c * L);
      refine_ring(first, end);
      const V is_dart = N::load(dart_);
      for (int c = 0; c < 3; ++c) {
        const V moved = N::fma(N::splat(4), before[c], N::load(dart_ + (1 + 3 * level + c) * L));
        N::store(N::select(is_dart, moved, N::load(centre() + c * L)), block_ + (Block::kCentre + c) * L);
      }
    } else {
      refine_ring(first, end);
    }
  }

 private:
  HWY_ATTR HWY_INLINE void refine_ring(int first, int end) {
    if (open_) {
      refine_quad_ring<N, false, true>(block_, first, end);
    } else if (period_ > 0) {
      refine_quad_ring<N, true, false>(block_, first, end);
    } else {
      refine_quad_ring<N, false, false>(block_, first, end);
    }
  }

  Scalar* block_;
  const Scalar* dart_;
  int depth_, period_;
  bool open_;
};

/// Numbers of a side, see QuadCurve. at[r][k]: point k = -1 .. 2 along the side, which runs from 0 to 1; row
/// 0 is right of it, row 2 left. Half a turn gives the same points in the opposite order, with the same bits.
template <class N>
HWY_ATTR void make_curve(const typename N::Scalar* const (&at)[3][4],
                         const KernelPlacement<typename N::Scalar>& placement, typename N::Scalar* curve) {
  using V = typename N::V;
  constexpr int L = N::lanes;
  V origin[3];
  choose_middle<N>(at[1][1], at[1][2], origin);
  for (int c = 0; c < 3; ++c) {
    V p[4];
    for (int k = 0; k < 4; ++k) {
      const V r = N::load(at[0][k] + c * L) - origin[c], m = N::load(at[1][k] + c * L) - origin[c],
              l = N::load(at[2][k] + c * L) - origin[c];
      p[k] = limit_filter<N>(r, m, l);
      N::store(p[k], curve + (QuadCurve::kPoints + 3 * k + c) * L);
      N::store(l - r, curve + (QuadCurve::kAcross + 3 * k + c) * L);
    }
    for (int k = 0; k < 3; ++k) N::store(p[k + 1] - p[k], curve + (QuadCurve::kAlong + 3 * k + c) * L);
    N::store(N::fma(origin[c], N::splat(placement.unit), N::splat(placement.centre[c])),
             curve + (QuadCurve::kOrigin + c) * L);
  }
}

/// Position and direction of the normal at t = k / 2^depth. The weights are those of cubic and quadratic
/// B-splines, times 6 and 2; in float they are exact to depth 8, so the points of a depth are those of the
/// next, bit by bit.
template <class N>
HWY_ATTR HWY_INLINE void curve_point(const typename N::Scalar* curve, int k, int depth, typename N::V unit,
                                     Vertex<N>& out) {
  using V = typename N::V;
  constexpr int L = N::lanes;
  const double t = k / static_cast<double>(1 << depth), u = 1 - t;
  const auto outer = [](double x) { return x * x * x; };
  const auto inner = [](double x) { return 4 + x * x * (3 * x - 6); };
  const V w0 = N::splat(outer(u)), w1 = N::splat(inner(t)), w2 = N::splat(inner(u)), w3 = N::splat(outer(t));
  const V b0 = N::splat(u * u), b1 = N::splat(1 + 2 * (t * u)), b2 = N::splat(t * t);
  V along[3], across[3];
  for (int c = 0; c < 3; ++c) {
    const auto number = [&](int part, int i) HWY_ATTR { return N::load(curve + (part + 3 * i + c) * L); };
    const auto blend = [&](int part) HWY_ATTR {
      return (w0 * number(part, 0) + w3 * number(part, 3)) + (w1 * number(part, 1) + w2 * number(part, 2));
    };
    out.position[c] = N::fma(blend(QuadCurve::kPoints), unit, number(QuadCurve::kOrigin, 0));
    along[c] = (b0 * number(QuadCurve::kAlong, 0) + b2 * number(QuadCurve::kAlong, 2)) +
               b1 * number(QuadCurve::kAlong, 1);
    across[c] = blend(QuadCurve::kAcross);
  }
  out.set_normal(along, across);
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
