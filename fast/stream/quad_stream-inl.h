// SPDX-License-Identifier: MIT
// The engine of a batch of quads: rows trickle down the levels, each point of each level is computed once.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
#endif

#include <array>
#include <cstddef>

#include "fast/stream/quad_curve-inl.h"
#include "fast/stream/quad_layout.h"
#include "fast/stream/quad_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// `lanes` quads of one depth, of any valences, from their control points to their limit points, a row at a
/// time. A level keeps a window of three rows, so memory is O(2^depth) whatever the mesh; nothing is
/// allocated. Level 1 comes from the rings of the corners alone.
template <class N>
class QuadStream {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  using Block = QuadCornerBlock;
  static constexpr int L = N::lanes;

  /// work: quad_work_size(depth) * lanes. It and the input are aligned to 64 bytes and hold finite numbers;
  /// the input's rings are overwritten.
  HWY_ATTR QuadStream(const QuadBatch<Scalar>& batch, const KernelPlacement<Scalar>& placement, Scalar* work,
                      const QuadTarget<Scalar>& target)
      : batch_(batch),
        depth_(batch.depth),
        fused_(batch.depth >= kFusedFrom),
        border_(work + quad_border_offset(batch.depth) * L),
        curves_(work + quad_curves_offset(batch.depth) * L),
        placement_(placement),
        target_(target) {
    rows_[0] = work;
    for (int level = 1; level <= depth_; ++level) rows_[level] = work + (quad_rows_offset(level) + 3) * L;
    for (int c = 0; c < 3; ++c) centre_[c] = N::splat(placement.centre[c]);
    unit_ = quad_unit(placement.unit, depth_);
    curve_unit_ = quad_unit(placement.unit, 0);
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
    for (int corner = 0; corner < 4; ++corner) refine_corner(corner);
    for (int j = -1; j <= 3; ++j) receive(1, j);
  }

  /// The side A B alone, which is row 0: the rows next to a side need nothing but themselves and the rings of
  /// its two ends. The input of the other corners and sides is not looked at.
  HWY_ATTR void run_side() {
    if (depth_ == 0) return corners(kA, kB, 0);
    if (batch_.some_polynomial & 1) curve(kAB);
    refine_corner(kA), refine_corner(kB);
    for (int level = 1; level <= depth_; ++level) {
      const Scalar *s = row(level - 1, -1), *m = row(level - 1, 0), *n = row(level - 1, 1);
      if (level > 1) {
        const int size = 1 << (level - 1);
        refine_odd_quads<N>(s, m, size, row(level, -1));
        refine_even_quads<N>(s, m, n, size, sharp(kAB), row(level, 0));
        refine_odd_quads<N>(m, n, size, row(level, 1));
      }
      for (int j = -1; j <= 1; ++j) take_bottom(level, j);
    }
    limit(row(depth_, -1), row(depth_, 0), row(depth_, 1), 0);
  }

 private:
  Scalar* block(int corner) const { return batch_.input + corner * quad_block_size(depth_) * L; }
  const Scalar* limit_of(int corner) const { return block(corner) + Block::kLimit * L; }
  const Scalar* mask(int offset, unsigned sides, int side) const {
    return sides >> side & 1 ? batch_.input + (offset + side) * L : nullptr;
  }
  const Scalar* sharp(int side) const { return mask(quad_sharp_offset(depth_), batch_.sharp, side); }

  // Entry `core` of a corner's ring, 0 for e- up to 7 for f''.
  const Scalar* ring(int corner, int core) const {
    const int period = batch_.period[corner];
    const int t = period == 0 ? 2 * depth_ + core : core >= period ? core - period : core;
    return block(corner) + (Block::kWindow + 3 * t) * L;
  }

  HWY_ATTR void corners(int first, int last, int j) {
    Vertex<N> a, b;
    a.load(limit_of(first)), b.load(limit_of(last));
    N::scatter_couple(a, b, target_.lane, target_.row_offset(j));
    if (target_.row) target_.row(target_.context, j);
  }

  // The 12 points around a side, before the rings are overwritten.
  HWY_ATTR void curve(int side) {
    const int p = side, q = (side + 1) % 4;
    const Scalar* const at[3][4] = {
        {ring(p, 7), ring(p, 0), ring(q, 6), ring(q, 7)},
        {ring(p, 6), block(p) + Block::kCentre * L, block(q) + Block::kCentre * L, ring(q, 0)},
        {ring(p, 5), ring(p, 4), ring(q, 2), ring(q, 1)}};
    make_curve<N>(at, placement_, curves_ + side * QuadCurve::kSize * L);
  }

  // One corner through all levels; what the rows of each level take from it is kept.
  HWY_ATTR void refine_corner(int corner) {
    const int period = batch_.period[corner];
    for (int level = 0; level < depth_; ++level) {
      // A ring that is there as a whole stays whole.
      const int first = period > 0 ? 0 : 2 * level;
      const int end = period > 0 ? period : quad_window_width(depth_) - 2 * level;
      if (batch_.open >> corner & 1) {
        refine_quad_ring<N, false, true>(block(corner), first, end);
      } else if (period > 0) {
        refine_quad_ring<N, true, false>(block(corner), first, end);
      } else {
        refine_quad_ring<N, false, false>(block(corner), first, end);
      }
      if (batch_.darts >> corner & 1) {
        const Scalar* dart = batch_.input + (quad_dart_offset(depth_) + corner * quad_dart_size(depth_)) * L;
        Scalar* centre = block(corner) + Block::kCentre * L;
        for (int c = 0; c < 3; ++c) {
          const V given = N::load(dart + (1 + 3 * level + c) * L);
          N::store(N::select(N::load(dart), given, N::load(centre + c * L)), centre + c * L);
        }
      }
      Scalar* kept = border(level + 1, corner);
      for (int c = 0; c < 3 * L; c += L) N::store(N::load(block(corner) + Block::kCentre * L + c), kept + c);
      for (int k = 0; k < kQuadCore; ++k) {
        for (int c = 0; c < 3 * L; c += L) N::store(N::load(ring(corner, k) + c), kept + 3 * (k + 1) * L + c);
      }
    }
  }

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
    const Scalar *middle = row(level, j - 1), *above = row(level, j);
    const Scalar* below = j >= 1 ? row(level, j - 2) : nullptr;
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
  HWY_ATTR void refine_even(const Scalar* s, const Scalar* m, const Scalar* n, int size, int j,
                            Scalar* even) {
    const Scalar* mask = j == 0 ? sharp(kAB) : j == size ? sharp(kCD) : nullptr;
    if (whole(size, 2 * j)) refine_even_quads<N>(s, m, n, size, mask, even);
    if (j == 0 || j == size) return;
    refine_even_column<N>(s - 3 * L, m - 3 * L, n - 3 * L, sharp(kDA), even - 3 * L);
    const int right = 3 * (size - 1) * L;
    refine_even_column<N>(s + right, m + right, n + right, sharp(kBC), even + 3 * (2 * size - 1) * L);
  }
  HWY_ATTR void refine_odd(const Scalar* m, const Scalar* n, int size, int j, Scalar* odd) {
    if (whole(size, 2 * j + 1)) refine_odd_quads<N>(m, n, size, odd);
    if (j < 1 || j >= size - 1) return;
    refine_odd_column<N>(m - 3 * L, n - 3 * L, sharp(kDA), odd - 3 * L);
    const int right = 3 * (size - 1) * L;
    refine_odd_column<N>(m + right, n + right, sharp(kBC), odd + 3 * (2 * size - 1) * L);
  }

  // Point k of a side counted from its beginning; at: its 3 x 3 neighbours seen along the row or column.
  HWY_ATTR HWY_INLINE void side_point(int side, int k, const Scalar* const (&at)[3][3],
                                      Vertex<N>& out) const {
    const bool all = batch_.all_polynomial >> side & 1;
    const Scalar* curve = curves_ + side * QuadCurve::kSize * L;
    if (all) {
      curve_point<N>(curve, k, depth_, N::splat(curve_unit_), out);
    } else {
      const int inner = side == kAB || side == kBC ? 2 : 0;
      side_limit<N>(at, sharp(side), inner, centre_, N::splat(unit_), out);
      if (const Scalar* some = mask(quad_polynomial_offset(depth_), batch_.some_polynomial, side)) {
        const V polynomial = N::load(some);
        Vertex<N> other;
        curve_point<N>(curve, k, depth_, N::splat(curve_unit_), other);
        for (int c = 0; c < 3; ++c) {
          out.position[c] = N::select(polynomial, other.position[c], out.position[c]);
          out.normal[c] = N::select(polynomial, other.normal[c], out.normal[c]);
        }
      }
    }
    out.finish();
  }

  // The ends of row j inside the grid: seen up the column, its right is the right.
  HWY_ATTR HWY_INLINE void column_point(int side, const Scalar* s, const Scalar* m, const Scalar* n, int i,
                                        int j, Vertex<N>& out) const {
    const int k = 3 * i * L, step = 3 * L;
    const Scalar* const at[3][3] = {{s + k + step, m + k + step, n + k + step},
                                    {s + k, m + k, n + k},
                                    {s + k - step, m + k - step, n + k - step}};
    side_point(side, side == kBC ? j : (1 << depth_) - j, at, out);
  }

  // A row that is a side.
  struct SideRow {
    const QuadStream& stream;
    int side;
    const Scalar *s, *m, *n;
    int i = 1;
    HWY_ATTR HWY_INLINE void begin(Vertex<N>& v) {
      const int k = 3 * i * L, step = 3 * L;
      const Scalar* const at[3][3] = {{s + k - step, s + k, s + k + step},
                                      {m + k - step, m + k, m + k + step},
                                      {n + k - step, n + k, n + k + step}};
      stream.side_point(side, side == kAB ? i : (1 << stream.depth_) - i, at, v);
      ++i;
    }
  };

  HWY_ATTR void limit(const Scalar* s, const Scalar* m, const Scalar* n, int j) {
    const int size = 1 << depth_;
    const std::ptrdiff_t offset = target_.row_offset(j);
    Vertex<N> first, last;
    if (j == 0 || j == size) {
      first.load(limit_of(j == 0 ? kA : kD)), last.load(limit_of(j == 0 ? kB : kC));
      const int side = j == 0 ? kAB : kCD;
      if (((batch_.sharp | batch_.some_polynomial) >> side & 1) == 0) {
        QuadLimitRow<N> row(s, m, n, 1, centre_, unit_);
        scatter_row<N>(row, size, first, last, target_.lane, offset);
      } else {
        SideRow row{*this, side, s, m, n};
        Vertex<N> a = first, b;
        for (int i = 0; i < size; i += 2) {
          row.begin(b);
          N::scatter_couple(a, b, target_.lane, offset + 6 * i);
          if (i + 2 < size) row.begin(a);
        }
        N::scatter_vertex(last, target_.lane, offset + 6 * size);
      }
    } else {
      column_point(kDA, s, m, n, 0, j, first);
      column_point(kBC, s, m, n, size, j, last);
      inside(s, m, n, j, first, last);
    }
    if (target_.row) target_.row(target_.context, j);
  }

  HWY_ATTR void inside(const Scalar* s, const Scalar* m, const Scalar* n, int j, const Vertex<N>& first,
                       const Vertex<N>& last) const {
    const int size = 1 << depth_, q = j / 2;
    const std::ptrdiff_t offset = target_.row_offset(j);
    if (!fused_ || j == 1 || j == size - 1) {
      QuadLimitRow<N> points(s, m, n, 1, centre_, unit_);
      return scatter_row<N>(points, size, first, last, target_.lane, offset);
    }
    const auto before = [&](int i) { return row(depth_ - 1, i); };
    const Scalar unit = quad_unit(placement_.unit, depth_ - 1);
    if (j % 2 == 0) {
      FusedLimitRow<N, false> points(before(q - 1), before(q), before(q + 1), before(q + 1), centre_, unit);
      scatter_row<N, true>(points, size, first, last, target_.lane, offset);
    } else {
      FusedLimitRow<N, true> points(before(q - 1), before(q), before(q + 1), before(q + 2), centre_, unit);
      scatter_row<N, true>(points, size, first, last, target_.lane, offset);
    }
  }

  QuadBatch<Scalar> batch_;
  int depth_;
  bool fused_;
  Scalar *border_, *curves_;
  std::array<Scalar*, kMaxDepth + 1> rows_;  // point 0 of the first row of each level's window
  KernelPlacement<Scalar> placement_;
  V centre_[3];
  Scalar unit_, curve_unit_;
  QuadTarget<Scalar> target_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
