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

/// Corner k of the quads of a batch.
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

  /// What the lines of each level from 1 on take from it, seen from an origin if it is not null: c and the entries
  /// of its core, three numbers to a point; those of the next level `stride` numbers on. Short rings that are there as a
  /// whole stay in registers.
  HWY_ATTR void refine(const V* origin, Scalar* out, int stride) const {
    if (open_) return levels<0, true>(origin, out, stride);
    if (period_ == 6) return levels<6, false>(origin, out, stride);
    if (period_ == 8) return levels<8, false>(origin, out, stride);
    if (period_ == 10) return levels<10, false>(origin, out, stride);
    if (period_ == 12) return levels<12, false>(origin, out, stride);
    levels<0, false>(origin, out, stride);
  }

 private:
  // The centre, the sums of differences to its ring, and the ring's entries e f e f ..: all of a closed ring, as many
  // as `entries` if that is not 0, or a window, which loses two entries at either end with each level.
  template <int entries, bool open>
  HWY_ATTR void levels(const V* origin, Scalar* out, int stride) const {
    constexpr int most = entries > 0 ? entries : quad_window_width(kMaxDepth);
    const bool whole = entries > 0 || period_ > 0;
    const int size = entries > 0 ? entries : period_ > 0 ? period_ : quad_window_width(depth_);
    const auto number = [&](int k) HWY_ATTR { return N::load(block_ + k * L); };
    const V k0 = number(0), k1 = number(1), k2 = number(2), k3 = number(3), k4 = number(4);
    for (int c = 0; c < 3; ++c, out += L) {
      const auto seen = [&](const V& x) HWY_ATTR { return origin != nullptr ? x - origin[c] : x; };
      V ring[most];
      for (int t = 0; t < size; ++t) ring[t] = seen(number(Block::kWindow + 3 * t + c));
      V v = seen(number(Block::kCentre + c)), de = number(Block::kEdges + c), df = number(Block::kFaces + c);
      Scalar* to = out;
      for (int level = 0; level < depth_; ++level, to += stride) {
        const int first = whole ? 0 : 2 * level, end = size - first;
        for (int t = first + 1; t + 1 < end; t += 2)
          ring[t] = face_rule(v, ring[t - 1], ring[t], ring[t + 1]);
        if (whole) ring[size - 1] = face_rule(v, ring[size - 2], ring[size - 1], ring[0]);
        for (int t = whole ? 0 : first + 2; t + 1 < end; t += 2) {
          const V refined = ring_edge_rule<N>(v, ring[t], ring[t > 0 ? t - 1 : size - 1], ring[t + 1]);
          ring[t] = open ? sharp_or(refined, v, ring[t], t) : refined;
        }

        V moved = N::fma(k1, df, N::fma(k0, de, N::splat(4) * v));
        if (open && dart_ != nullptr) {
          const V dart = N::fma(N::splat(4), v, N::load(dart_ + (1 + 3 * level + c) * L));
          moved = N::select(N::load(dart_), dart, moved);
        }
        v = moved;
        const V both = k2 * de;
        de = N::fma(k3, df, both), df = N::fma(k4, df, both);

        N::store(v, to);
        for (int core = 0; core < kQuadCore; ++core) {
          const int t = !whole ? 2 * depth_ + core : core < size ? core : core - size;
          N::store(ring[t], to + 3 * (1 + core) * L);
        }
      }
    }
  }

  // In lane k the entries kEnds and kEnds + 1 of an open ring are its ends, on sharp edges.
  HWY_ATTR HWY_INLINE V sharp_or(V refined, V v, V e, int t) const {
    const V position = N::splat(t), start = N::load(block_ + Block::kEnds * L),
            stop = N::load(block_ + (Block::kEnds + 1) * L);
    return N::select(N::equal(position, start) + N::equal(position, stop), N::splat(2) * (v + e), refined);
  }

  const Scalar* block_;
  const Scalar* dart_;
  int depth_, period_;
  bool open_;
};

/// Numbers of a side, see QuadCurve. at[r][k]: point k = -1 .. 2 along the side, which runs from 0 to 1; row
/// 0 is right of it, row 2 left. Half a turn gives the same points in the opposite order, with the same bits.
template <class N>
HWY_ATTR void make_curve(const typename N::Scalar* const (&at)[3][4],
                         const Placement<typename N::Scalar>& placement, typename N::Scalar* curve) {
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
