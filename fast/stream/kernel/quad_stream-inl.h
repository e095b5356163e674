// SPDX-License-Identifier: MIT
// The engine of a batch of quads: rows trickle down the levels, each point of each level is computed once.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
#endif

#include <array>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/quad_rows-inl.h"
#include "fast/stream/kernel/quad_rules-inl.h"
#include "fast/stream/kernel/quad_side-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// `lanes` quads of one depth, of any valences, from their control points to their limit points, a row at a
/// time. A level keeps a window of three rows, so memory is O(2^depth) whatever the mesh; nothing is
/// allocated. Level 1 comes from the rings of the corners alone.
///
/// To: where they go, see LaneTarget.
template <class N, class To = QuadLaneTarget<N>>
class QuadStream {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// work: quad_work_size(depth) * lanes. It and the input, which is left alone, are aligned to 64 bytes
  /// and hold finite numbers.
  HWY_ATTR QuadStream(const QuadBatch<Scalar>& batch, const Placement<Scalar>& placement, Scalar* work,
                      const To& target)
      : batch_(batch),
        depth_(batch.depth),
        fused_(batch.depth >= kFusedFrom && !requires { N::kNeverFused; }),
        side_work_(work),
        border_(work + quad_border_offset(batch.depth) * L),
        curves_(work + quad_curves_offset(batch.depth) * L),
        strips_(work + quad_strips_offset(batch.depth) * L),
        placement_(placement),
        target_(target) {
    rows_[0] = work;
    for (int level = 1; level <= depth_; ++level) rows_[level] = work + (quad_rows_offset(level) + 3) * L;
    for (int c = 0; c < 3; ++c) centre_[c] = N::splat(placement.centre[c]);
    unit_ = quad_unit(placement.unit, depth_);
  }

  HWY_ATTR void run() {
    if (depth_ == 0) {
      corners(kA, kB, 0);
      corners(kD, kC, 1);
      return;
    }
    for (int side = 0; side < 4; ++side) {
      if (batch_.some_polynomial >> side & 1) curve(side);
    }
    if (batch_.local) move_origin();
    for (int k = 0; k < 4; ++k)
      corner(k).refine(batch_.local ? origin_ : nullptr, border(1, k), 4 * kQuadBorder * L);
    for (int j = -1; j <= 3; ++j) receive(1, j);
  }

  /// The side A B alone, which is row 0. The input of the other corners and sides is not looked at.
  HWY_ATTR void run_side() {
    if (depth_ > 0 && (batch_.some_polynomial & 1)) curve(kAB);
    run_first_side();
  }

 private:
  QuadCorner<N> corner(int k) const { return {batch_, k}; }
  QuadSideLimit<N> limit_next_to(int side) const {
    return {batch_, side, placement_, curve_of(side), centre_};
  }
  Scalar* curve_of(int side) const { return curves_ + side * QuadCurve::kSize * L; }
  const Scalar* sharp(int side) const {
    return batch_.sharp >> side & 1 ? batch_.input + (quad_sharp_offset(depth_) + side) * L : nullptr;
  }

  HWY_ATTR void run_first_side() {
    const QuadSideStream<N> first(batch_, kAB, placement_, curve_of(kAB), side_work_);
    first.scatter(target_.row(0));
    target_.done(0);
  }

  // The sides before the inside: A B is row 0, the others are kept until their rows come. Then the quad from
  // an origin on its diagonal.
  HWY_ATTR void move_origin() {
    run_first_side();
    for (const int side : {kBC, kCD, kDA}) {
      const QuadSideStream<N> stream(batch_, side, placement_, curve_of(side), side_work_);
      stream.scatter(KeptRow<N>{strip(side, 0)});
    }
    choose_origin<N>(batch_.input + (quad_parts_offset(depth_) + kInside) * L, corner(kA).centre(),
                     corner(kC).centre(), origin_);
    for (int c = 0; c < 3; ++c) centre_[c] = N::fma(origin_[c], N::splat(placement_.unit), centre_[c]);
  }
  // Point k of a side that has an origin of its own.
  Scalar* strip(int side, int k) const {
    return strips_ + ((side - kBC) * edge_output_size(depth_) + 6 * k) * L;
  }

  HWY_ATTR void corners(int first, int last, int j) {
    Vertex<N> a, b;
    a.load(corner(first).limit()), b.load(corner(last).limit());
    target_.row(j).couple(0, a, b);
    target_.done(j);
  }

  // The 12 points around a side.
  HWY_ATTR void curve(int side) {
    const QuadCorner<N> p = corner(side), q = corner((side + 1) % 4);
    const Scalar* const at[3][4] = {{p.ring(7), p.ring(0), q.ring(6), q.ring(7)},
                                    {p.ring(6), p.centre(), q.centre(), q.ring(0)},
                                    {p.ring(5), p.ring(4), q.ring(2), q.ring(1)}};
    make_curve<N>(at, placement_, curve_of(side));
  }

  // What the rows of a level take from a corner.
  Scalar* border(int level, int corner) const { return border_ + kQuadBorder * (4 * level + corner) * L; }
  Scalar* row(int level, int j) const { return rows_[level] + (j + 1) % 4 * quad_row_size(level) * L; }

  HWY_ATTR void take(int level, int corner, RingPoint p, Scalar* to_row, int i) const {
    const Scalar* from = border(level, corner) + 3 * p * L;
    for (int c = 0; c < 3; ++c) N::store(N::load(from + c * L), to_row + (3 * i + c) * L);
  }

  HWY_ATTR void take_bottom(int level, int j) const {
    const int size = 1 << level;
    Scalar* r = row(level, j);
    const auto a = [&](RingPoint p, int i) HWY_ATTR { take(level, kA, p, r, i); };
    const auto b = [&](RingPoint p, int i) HWY_ATTR { take(level, kB, p, r, i); };
    if (j == -1) a(kEBefore, 0), a(kFBefore, 1), b(kFAfter, size - 1), b(kEBeyond, size);
    if (j == 0) {
      a(kEBeyond, -1), a(kHub, 0), a(kE, 1);
      b(kEAfter, size - 1), b(kHub, size), b(kEBefore, size + 1);
    }
    if (j == 1) {
      a(kFAfter, -1), a(kEAfter, 0), a(kF, 1);
      b(kF, size - 1), b(kE, size), b(kFBefore, size + 1);
    }
  }
  HWY_ATTR void take_top(int level, int j) const {
    const int size = 1 << level;
    Scalar* r = row(level, j);
    const auto c = [&](RingPoint p, int i) HWY_ATTR { take(level, kC, p, r, i); };
    const auto d = [&](RingPoint p, int i) HWY_ATTR { take(level, kD, p, r, i); };
    if (j == size - 1) {
      d(kFBefore, -1), d(kE, 0), d(kF, 1);
      c(kF, size - 1), c(kEAfter, size), c(kFAfter, size + 1);
    }
    if (j == size) {
      d(kEBefore, -1), d(kHub, 0), d(kEAfter, 1);
      c(kE, size - 1), c(kHub, size), c(kEBeyond, size + 1);
    }
    if (j == size + 1) d(kEBeyond, 0), d(kFAfter, 1), c(kFBefore, size - 1), c(kEBefore, size);
  }

  // Row j of a level is complete but for what the corners own.
  HWY_ATTR void receive(int level, int j) {
    take_bottom(level, j), take_top(level, j);
    if (j < 0) return;
    Scalar *const middle = row(level, j - 1), *const above = row(level, j);
    Scalar* const below = j >= 1 ? row(level, j - 2) : nullptr;
    if (level == depth_) {
      if (below) limit(below, middle, above, j - 1);
      return;
    }
    const int size = 1 << level;
    if (level + 1 == depth_ && fused_) ghosts(level, j);
    if (below) {
      refine_even(below, middle, above, size, j - 1, row(level + 1, 2 * j - 2));
      receive(level + 1, 2 * j - 2);
    }
    refine_odd(middle, above, size, j - 1, row(level + 1, 2 * j - 1));
    receive(level + 1, 2 * j - 1);
  }

  // Whether row j of the level after one of this size is needed between its first and last columns: limits of
  // rows 0 and 1, and at the other end likewise, are made from it.
  bool whole(int size, int j) const {
    return !fused_ || 2 * size != 1 << depth_ || j <= 2 || j >= 2 * size - 2;
  }

  // Beyond a sharp column: what continues the surface inside.
  HWY_ATTR void ghosts(int level, int j) const {
    Scalar* left = row(level, j);
    Scalar* right = left + 3 * (1 << level) * L;
    for (int c = 0; c < 3 * L; c += L) {
      const auto ghost = [&](const Scalar* mask, Scalar* to, const Scalar* edge,
                             const Scalar* inner) HWY_ATTR {
        const V v = N::load(edge + c);
        N::store(N::select(N::load(mask), (v + v) - N::load(inner + c), N::load(to + c)), to + c);
      };
      if (const Scalar* mask = sharp(kDA)) ghost(mask, left - 3 * L, left, left + 3 * L);
      if (const Scalar* mask = sharp(kBC)) ghost(mask, right + 3 * L, right, right - 3 * L);
    }
  }

  // Rows and columns along the sides take these for their line. Next to a corner its ring has the last word.
  static MemoryLine<N> line(Scalar* row) { return {row, 3 * L}; }
  HWY_ATTR void refine_even(Scalar* s, Scalar* m, Scalar* n, int size, int j, Scalar* even) {
    const Scalar* mask = j == 0 ? sharp(kAB) : j == size ? sharp(kCD) : nullptr;
    for (int c = 0; c < 3 * L && whole(size, 2 * j); c += L)
      refine_even_line<N>(line(s + c), line(m + c), line(n + c), size, mask, line(even + c));
    if (j == 0 || j == size) return;
    refine_even_column<N>(s - 3 * L, m - 3 * L, n - 3 * L, sharp(kDA), even - 3 * L);
    const int right = 3 * (size - 1) * L;
    refine_even_column<N>(s + right, m + right, n + right, sharp(kBC), even + 3 * (2 * size - 1) * L);
  }
  HWY_ATTR void refine_odd(Scalar* m, Scalar* n, int size, int j, Scalar* odd) {
    for (int c = 0; c < 3 * L && whole(size, 2 * j + 1); c += L)
      refine_odd_line<N>(line(m + c), line(n + c), size, line(odd + c));
    if (j < 1 || j >= size - 1) return;
    refine_odd_column<N>(m - 3 * L, n - 3 * L, sharp(kDA), odd - 3 * L);
    const int right = 3 * (size - 1) * L;
    refine_odd_column<N>(m + right, n + right, sharp(kBC), odd + 3 * (2 * size - 1) * L);
  }

  // The ends of row j inside the grid: seen up the column, its right is the right.
  HWY_ATTR HWY_INLINE void column_point(int side, const Scalar* s, const Scalar* m, const Scalar* n, int i,
                                        int j, Vertex<N>& out) const {
    const int k = 3 * i * L, step = 3 * L;
    const Scalar* const at[3][3] = {{s + k + step, m + k + step, n + k + step},
                                    {s + k, m + k, n + k},
                                    {s + k - step, m + k - step, n + k - step}};
    limit_next_to(side).point(side == kBC ? j : (1 << depth_) - j, at, side == kBC ? 2 : 0, out);
  }

  HWY_ATTR void limit(const Scalar* s, const Scalar* m, const Scalar* n, int j) {
    const int size = 1 << depth_;
    if (batch_.local && j == 0) return;
    if (batch_.local && j == size) {
      last_row();
    } else if (j == 0 || j == size) {
      side_row(j == 0 ? kAB : kCD, s, m, n);
    } else {
      Vertex<N> first, last;
      if (batch_.local) {
        first.load(strip(kDA, size - j)), last.load(strip(kBC, j));
      } else {
        column_point(kDA, s, m, n, 0, j, first), column_point(kBC, s, m, n, size, j, last);
      }
      inside(s, m, n, j, first, last);
    }
    target_.done(j);
  }

  // The points of C D, from the last.
  HWY_ATTR void last_row() const {
    const int size = 1 << depth_;
    const auto to = target_.row(size);
    Vertex<N> a, b;
    for (int i = 0; i < size; i += 2) {
      a.load(strip(kCD, size - i)), b.load(strip(kCD, size - i - 1));
      to.couple(i, a, b);
    }
    a.load(strip(kCD, 0));
    to.vertex(size, a);
  }

  // A row that is a side.
  HWY_ATTR void side_row(int side, const Scalar* s, const Scalar* m, const Scalar* n) {
    const int size = 1 << depth_, step = 3 * L;
    const auto to = target_.row(side == kAB ? 0 : size);
    const QuadSideLimit<N> limits = limit_next_to(side);
    Vertex<N> first, last;
    first.load(corner(side == kAB ? kA : kD).limit()), last.load(corner(side == kAB ? kB : kC).limit());
    if (limits.plain()) {
      QuadLimitRow<N> row(s, m, n, 1, centre_, unit_);
      return scatter_row<N>(row, size, first, last, to);
    }
    const auto point = [&](int i, Vertex<N>& v) HWY_ATTR {
      const int k = 3 * i * L;
      const Scalar* const at[3][3] = {{s + k - step, s + k, s + k + step},
                                      {m + k - step, m + k, m + k + step},
                                      {n + k - step, n + k, n + k + step}};
      limits.point(side == kAB ? i : size - i, at, side == kAB ? 2 : 0, v);
    };
    scatter_points<N>(point, size, first, last, to);
  }

  HWY_ATTR void inside(const Scalar* s, const Scalar* m, const Scalar* n, int j, const Vertex<N>& first,
                       const Vertex<N>& last) const {
    const int size = 1 << depth_, q = j / 2;
    const auto to = target_.row(j);
    if (!fused_ || j == 1 || j == size - 1) {
      QuadLimitRow<N> points(s, m, n, 1, centre_, unit_);
      return scatter_row<N>(points, size, first, last, to);
    }
    const auto before = [&](int i) { return row(depth_ - 1, i); };
    const Scalar unit = quad_unit(placement_.unit, depth_ - 1);
    if (j % 2 == 0) {
      FusedLimitRow<N, false> points(before(q - 1), before(q), before(q + 1), before(q + 1), centre_, unit);
      scatter_row<N>(points, size, first, last, to, true);
    } else {
      FusedLimitRow<N, true> points(before(q - 1), before(q), before(q + 1), before(q + 2), centre_, unit);
      scatter_row<N>(points, size, first, last, to, true);
    }
  }

  QuadBatch<Scalar> batch_;
  int depth_;
  bool fused_;
  Scalar *side_work_, *border_, *curves_, *strips_;
  std::array<Scalar*, kMaxDepth + 1> rows_;  // point 0 of the first row of each level's window
  Placement<Scalar> placement_;
  V origin_[3], centre_[3];
  Scalar unit_;
  To target_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
