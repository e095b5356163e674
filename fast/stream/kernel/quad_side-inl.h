// SPDX-License-Identifier: MIT
// A side of a quad, from three rows along it: its points alone, at any depth.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#endif

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/quad_rows-inl.h"
#include "fast/stream/kernel/quad_rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// What makes limit points of the last level's points next to one side of the quads of a batch.
template <class N>
class QuadSideLimit {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// curve: of the side, if it is a polynomial in some lane; centre: where the points' origin is in the
  /// caller's coordinates. Both are kept by pointer.
  HWY_ATTR QuadSideLimit(const QuadBatch<Scalar>& batch, int side, const Placement<Scalar>& placement,
                         const Scalar* curve, const V* centre)
      : sharp_(mask(batch, quad_sharp_offset(batch.depth), batch.sharp, side)),
        polynomial_(mask(batch, quad_polynomial_offset(batch.depth), batch.some_polynomial, side)),
        all_polynomial_(batch.all_polynomial >> side & 1),
        depth_(batch.depth),
        curve_(curve),
        centre_(centre),
        unit_(quad_unit(placement.unit, batch.depth)),
        curve_unit_(quad_unit(placement.unit, 0)) {}

  /// 1 in the lanes in which the side is sharp; null: in none.
  const Scalar* sharp() const { return sharp_; }
  bool some_polynomial() const { return polynomial_ != nullptr; }
  bool all_polynomial() const { return all_polynomial_; }
  /// Whether its points are as those of any other row.
  bool plain() const { return sharp_ == nullptr && polynomial_ == nullptr; }
  Scalar unit() const { return unit_; }

  /// Sum and difference across the side of the numbers right of it, on it and left of it, of which those of the inside
  /// are left if `inner` is 2.
  HWY_ATTR HWY_INLINE void filter(V r, V m, V l, int inner, V& sum, V& difference) const {
    sum = limit_filter<N>(r, m, l);
    difference = l - r;
    if (sharp_ == nullptr) return;
    const V mask = N::load(sharp_);  // there is nothing beyond
    sum = N::select(mask, N::splat(6) * m, sum);
    difference = N::select(mask, N::splat(2) * (inner == 2 ? l - m : m - r), difference);
  }

  /// Point k counted from the side's beginning; at: its 3 x 3 neighbours in the side's own frame: x along it, the right
  /// of it in row 0, the left in row 2; inner: the row of the inside, 0 or 2. Normal of length 1.
  HWY_ATTR HWY_INLINE void point(int k, const Scalar* const (&at)[3][3], int inner, Vertex<N>& out) const {
    if (all_polynomial_) {
      curve(k, out);
    } else {
      V along[3], across[3];
      for (int c = 0; c < 3; ++c) {
        V p[3], q[3];
        for (int i = 0; i < 3; ++i) {
          const auto number = [&](int row) HWY_ATTR { return N::load(at[row][i] + c * L); };
          filter(number(0), number(1), number(2), inner, p[i], q[i]);
        }
        out.position[c] = N::fma(limit_filter<N>(p[0], p[1], p[2]), N::splat(unit_), centre_[c]);
        along[c] = p[2] - p[0];
        across[c] = limit_filter<N>(q[0], q[1], q[2]);
      }
      out.set_normal(along, across);
      choose(k, out);
    }
    out.finish();
  }
  /// The same where it is a polynomial, and of a point that has been made otherwise; normal of any length.
  HWY_ATTR HWY_INLINE void curve(int k, Vertex<N>& out) const {
    curve_point<N>(curve_, k, depth_, N::splat(curve_unit_), out);
  }
  HWY_ATTR HWY_INLINE void choose(int k, Vertex<N>& out) const {
    if (polynomial_ == nullptr) return;
    const Vertex<N> other = out;
    curve(k, out);
    out.choose(N::load(polynomial_), other);
  }

 private:
  static const Scalar* mask(const QuadBatch<Scalar>& batch, int offset, unsigned sides, int side) {
    return sides >> side & 1 ? batch.input + (offset + side) * L : nullptr;
  }

  const Scalar *sharp_, *polynomial_;
  bool all_polynomial_;
  int depth_;
  const Scalar* curve_;
  const V* centre_;
  Scalar unit_, curve_unit_;
};

/// The points of a side from those of all levels next to it: the rows next to a side need nothing but
/// themselves and the rings of its two ends. From a depth on they are seen from an origin near the side, the
/// same from either end. The same operations give the same bits as a quad that has the side for a row or
/// column. [claim D14]
template <class N>
class QuadSideStream {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// work: quad_side_work_size(depth) * lanes.
  HWY_ATTR QuadSideStream(const QuadBatch<Scalar>& batch, int side, const Placement<Scalar>& placement,
                          const Scalar* curve, Scalar* work)
      : p_(batch, side),
        q_(batch, (side + 1) % 4),
        depth_(batch.depth),
        ends_(work),
        points_(work + 2 * kQuadBorder * batch.depth * L),
        limit_(batch, side, placement, curve, centre_) {
    V origin[3] = {N::splat(0), N::splat(0), N::splat(0)};
    if (batch.local)
      choose_origin<N>(batch.input + (quad_parts_offset(depth_) + side) * L, p_.centre(), q_.centre(),
                       origin);
    for (int c = 0; c < 3; ++c)
      centre_[c] = N::fma(origin[c], N::splat(placement.unit), N::splat(placement.centre[c]));
    if (!limit_.all_polynomial() && depth_ > 0) refine(batch.local ? origin : nullptr);
  }
  QuadSideStream(const QuadSideStream&) = delete;

  /// Points 0 .. 2^depth as a row.
  template <class Row>
  HWY_ATTR void scatter(const Row& to) const {
    const int size = 1 << depth_;
    Vertex<N> a, b;
    a.load(p_.limit()), b.load(q_.limit());
    if (size == 1) return to.couple(0, a, b);
    if (!limit_.some_polynomial()) {
      Kept points{points_};
      return scatter_row<N>(points, size, a, b, to);
    }
    scatter_points<N>([&](int k, Vertex<N>& v) HWY_ATTR { point(k, v); }, size, a, b, to);
  }

 private:
  // Position and two tangents of points 1 .. size - 1, in turn; see begin_vertex().
  struct Kept {
    const Scalar* at;
    template <bool odd>
    HWY_ATTR HWY_INLINE void advance() {
      at += 9 * L;
    }
    template <bool odd>
    HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&along)[3], V (&across)[3]) const {
      v.position[c] = N::load(at + c * L);
      along[c] = N::load(at + (3 + c) * L);
      across[c] = N::load(at + (6 + c) * L);
    }
  };
  HWY_ATTR HWY_INLINE void point(int k, Vertex<N>& out) const {
    if (limit_.all_polynomial()) {
      limit_.curve(k, out);
    } else {
      Kept points{points_ + 9 * (k - 1) * L};
      begin_vertex<N, true>(points, out);
      limit_.choose(k, out);
    }
    out.finish();
  }

  HWY_ATTR void refine(const V* origin) {
    p_.refine(origin, ends_, 2 * kQuadBorder * L);
    q_.refine(origin, ends_ + kQuadBorder * L, 2 * kQuadBorder * L);
    if (depth_ == 1) return short_lines<1>();
    if (depth_ == 2) return short_lines<2>();
    if (depth_ == 3) return short_lines<3>();
    if (depth_ == 4) return short_lines<4>();
    long_lines(points_ + 9 * (1 << depth_) * L);
  }

  // The rows right of the side, on it and left of it.
  template <int depth>
  HWY_ATTR void short_lines() {
    for (int c = 0; c < 3; ++c) {
      V none[3][2];
      descend<1, depth>(c, none);
    }
  }
  template <int level, int depth>
  HWY_ATTR HWY_INLINE void descend(int c, V (&before)[3][(1 << (level - 1)) + 1]) {
    V now[3][(1 << level) + 1];
    const LocalLine<N> from[3] = {{before[0]}, {before[1]}, {before[2]}},
                       to[3] = {{now[0]}, {now[1]}, {now[2]}};
    refine_lines(c, level, from, to);
    if constexpr (level < depth)
      descend<level + 1, depth>(c, now);
    else
      make_points(c, 1 << level, to);
  }
  HWY_ATTR void long_lines(Scalar* work) {
    const int pitch = ((1 << depth_) + 1) * L;
    for (int c = 0; c < 3; ++c) {
      MemoryLine<N> from[3] = {}, to[3] = {};
      for (int level = 1; level <= depth_; ++level) {
        for (int r = 0; r < 3; ++r) from[r] = to[r], to[r] = {work + (level % 2 * 3 + r) * pitch, L};
        refine_lines(c, level, from, to);
      }
      make_points(c, 1 << depth_, to);
    }
  }

  template <class Line>
  HWY_ATTR HWY_INLINE void refine_lines(int c, int level, const Line (&from)[3], const Line (&to)[3]) const {
    const int last = 1 << level;
    if (level > 1) {
      refine_odd_line<N>(from[0], from[1], last / 2, to[0]);
      refine_even_line<N>(from[0], from[1], from[2], last / 2, limit_.sharp(), to[1]);
      refine_odd_line<N>(from[1], from[2], last / 2, to[2]);
    }
    // What the rings of the ends own: all within two points of them.
    const auto p = [&](RingPoint at)
                       HWY_ATTR { return N::load(ends_ + (kQuadBorder * 2 * (level - 1) + 3 * at + c) * L); };
    const auto q = [&](RingPoint at)
                       HWY_ATTR { return N::load(ends_ + (kQuadBorder * (2 * level - 1) + 3 * at + c) * L); };
    to[0].set(0, p(kEBefore)), to[0].set(1, p(kFBefore));
    to[1].set(0, p(kHub)), to[1].set(1, p(kE));
    to[2].set(0, p(kEAfter)), to[2].set(1, p(kF));
    to[0].set(last - 1, q(kFAfter)), to[0].set(last, q(kEBeyond));
    to[1].set(last - 1, q(kEAfter)), to[1].set(last, q(kHub));
    to[2].set(last - 1, q(kF)), to[2].set(last, q(kE));
  }
  template <class Line>
  HWY_ATTR HWY_INLINE void make_points(int c, int size, const Line (&line)[3]) const {
    const V unit = N::splat(limit_.unit());
    V p[3], q[3];
    const auto filter = [&](int i, V& sum, V& difference) HWY_ATTR {
      limit_.filter(line[0].get(i), line[1].get(i), line[2].get(i), 2, sum, difference);
    };
    filter(0, p[0], q[0]), filter(1, p[1], q[1]);
    Scalar* to = points_ + (9 + c) * L;
    for (int k = 1; k < size; ++k, to += 9 * L) {
      filter(k + 1, p[2], q[2]);
      N::store(N::fma(limit_filter<N>(p[0], p[1], p[2]), unit, centre_[c]), to);
      N::store(p[2] - p[0], to + 3 * L);
      N::store(limit_filter<N>(q[0], q[1], q[2]), to + 6 * L);
      p[0] = p[1], p[1] = p[2], q[0] = q[1], q[1] = q[2];
    }
  }

  QuadCorner<N> p_, q_;
  int depth_;
  Scalar* ends_;    // of the corners, level by level
  Scalar* points_;  // of the side, from number 0 on, which is not there
  V centre_[3];
  QuadSideLimit<N> limit_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
