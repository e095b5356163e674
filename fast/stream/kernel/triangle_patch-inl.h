// SPDX-License-Identifier: MIT
// Pairs of triangles with four regular corners: two quartic polynomials, row by row.

#if defined(LIMITCHECK_FAST_STREAM_TRIANGLE_PATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_TRIANGLE_PATCH_INL_H_
#undef LIMITCHECK_FAST_STREAM_TRIANGLE_PATCH_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_TRIANGLE_PATCH_INL_H_
#endif

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/regular_edge-inl.h"
#include "fast/stream/kernel/stream-inl.h"
#include "fast/stream/kernel/vertex-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// `lanes` pairs of one depth. Differences are formed on the control net, seen from an origin of
/// the pair's own, so the normals are as good at every depth. Coordinates count from the middle of the pair, so half a turn
/// about that negates the odd coefficients, exactly: rows from C have the bits of rows from A.
template <class N, class To = LaneTarget<N>>
class TrianglePatch {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// input: as for a Stream of depth kPatchWindow, left alone.
  HWY_ATTR TrianglePatch(const Scalar* input, int depth, const Placement<Scalar>& placement, const To& target)
      : input_(input),
        depth_(depth),
        target_(target),
        edge_{edge(kAB, placement), edge(kBC, placement), edge(kCD, placement), edge(kDA, placement),
              edge(kAC, placement)},
        unit_(limit_unit(placement.unit, 0)) {
    V origin[3];
    choose_middle<N>(block(kA) + CornerBlock::kCentre * L, block(kC) + CornerBlock::kCentre * L, origin);
    for (int c = 0; c < 3; ++c) {
      prepare(c, origin[c]);
      centre_[c] = N::fma(origin[c], N::splat(placement.unit), N::splat(placement.centre[c]));
    }
  }

  HWY_ATTR void run() {
    const int size = 1 << depth_;
    for (int j = 0; j <= size; ++j) {
      const auto to = target_.row(j);
      Vertex<N> first, last, diagonal;
      if (j == 0 || j == size) {
        first.load(limit_of(j == 0 ? kA : kD)), last.load(limit_of(j == 0 ? kB : kC));
        RegularEdgeRow<N> row(edge_[j == 0 ? kAB : kCD], depth_, 0);
        scatter_row<N>(row, size, first, last, to);
      } else {
        const auto on = [&](Part edge, Vertex<N>& v) HWY_ATTR {
          begin_vertex<N, true>(RegularEdgeRow<N>(edge_[edge], depth_, j - 1), v);
        };
        on(kDA, first), first.end(), on(kBC, last), last.end(), on(kAC, diagonal);
        alignas(64) Scalar given[6 * L];
        diagonal.store(given);
        make_row(j);
        InnerRow row(*this, j, given);
        scatter_row<N>(row, size, first, last, to, depth_ >= 5);
      }
      target_.done(j);
    }
  }

 private:
  // Coefficients by powers of x and y, of 12 times the position. Those of the second degree and below are the same on
  // both sides of the diagonal; the others are there twice, those of the lower right triangle first.
  enum Power { k1, kY, kY2, kX, kXY, kX2, kShared, kX3 = 0, kX2Y, kXY2, kY3, kX4, kY4, kOwn };
  // Of a row, by powers of x: of 12 times the position, and of its derivative across the row.
  static constexpr int kSlope = 5, kRow = 9;

  const Scalar* block(int corner) const { return input_ + corner * corner_block_size(kPatchWindow) * L; }
  const Scalar* limit_of(int corner) const { return block(corner) + CornerBlock::kLimit * L; }
  HWY_ATTR RegularEdge<N> edge(Part part, const Placement<Scalar>& placement) const {
    const EdgeEnds& at = kEdgeEnds[part];
    const auto end = [&](int corner, int first) {
      return RegularEnd<N>{block(corner), first + kPatchWindow + 1, window_width(corner, kPatchWindow)};
    };
    return {end(at.p, at.p_first), end(at.q, at.q_first), placement};
  }

  // One coordinate of the control points, seen from an origin, to that of the coefficients.
  HWY_FLATTEN HWY_ATTR void prepare(int c, const V& origin) {
    V p[4][4];  // point (i, j) is [j + 1][i + 1]
    const auto at = [&](int i, int j) HWY_ATTR { return p[j + 1][i + 1]; };
    const auto put = [&](int i, int j, int corner, int number)
                         HWY_ATTR { p[j + 1][i + 1] = N::load(block(corner) + (number + c) * L) - origin; };
    const auto entry = [](int t) { return CornerBlock::kWindow + 3 * t; };
    put(0, 0, kA, CornerBlock::kCentre), put(1, 0, kB, CornerBlock::kCentre);
    put(1, 1, kC, CornerBlock::kCentre), put(0, 1, kD, CornerBlock::kCentre);
    put(0, -1, kA, entry(1)), put(-1, 0, kA, entry(5)), put(-1, -1, kA, entry(6));
    put(1, 2, kC, entry(1)), put(2, 1, kC, entry(5)), put(2, 2, kC, entry(6));
    put(2, 0, kB, entry(0)), put(1, -1, kB, entry(5)), put(-1, 1, kD, entry(0)), put(0, 2, kD, entry(5));

    // Differences of the second order along the rows, the columns and the diagonal.
    const V three = N::splat(3);
    const auto second = [](const V& before, const V& v, const V& after)
                            HWY_ATTR { return N::fma(N::splat(-2), v, before + after); };
    const auto x = [&](int i, int j) HWY_ATTR { return second(at(i - 1, j), at(i, j), at(i + 1, j)); };
    const auto y = [&](int i, int j) HWY_ATTR { return second(at(i, j - 1), at(i, j), at(i, j + 1)); };
    const auto z = [&](int i) HWY_ATTR { return second(at(i - 1, i - 1), at(i, i), at(i + 1, i + 1)); };
    const V xa = x(0, 0), xc = x(1, 1), ya = y(0, 0), yc = y(1, 1);

    const V ac = at(0, 0) + at(1, 1), bd = at(1, 0) + at(0, 1), to_c = at(1, 1) - at(0, 0),
            to_b = at(1, 0) - at(0, 1), far_c = at(2, 2) - at(-1, -1), e = at(2, 1) - at(-1, 0),
            n = at(1, 2) - at(0, -1);
    const V outer = (at(-1, 0) + at(2, 1)) + (at(0, -1) + at(1, 2));
    const V sums = N::fma(N::splat(26), bd, N::fma(N::splat(63), ac, three * outer));
    const auto keep = [&](int k, const V& value) HWY_ATTR { N::store(value, power_ + (3 * k + c) * L); };
    const auto slope = [&](const V& side, const V& far, const V& other) HWY_ATTR {
      const V corners = N::fma(N::splat(4.5), side, N::splat(3.25) * to_c);
      return N::fma(N::splat(.25), far_c - other, N::fma(N::splat(1.25), far, corners));
    };
    keep(k1, N::splat(1. / 16) * (sums + (at(-1, -1) + at(2, 2))));
    keep(kX, slope(to_b, e, n)), keep(kY, slope(N::splat(-1) * to_b, n, e));
    keep(kX2, three * (xa + xc)), keep(kY2, three * (ya + yc));
    keep(kXY, N::splat(1.5) * N::fma(N::splat(4), ac - bd, (z(0) + z(1)) - ((xa + xc) + (ya + yc))));

    // a, c: of the triangle's own ends of the diagonal; b: of its third corner; beyond: of the one across the opposite
    // side. Half a turn makes one triangle the other.
    const auto own = [&](int triangle, const V& x_a, const V& x_c, const V& x_b, const V& x_beyond,
                         const V& y_a, const V& y_c, const V& y_b, const V& y_beyond) HWY_ATTR {
      const V sign = N::splat(triangle == 0 ? 1 : -1), thrice = N::splat(triangle == 0 ? 3 : -3);
      const auto keep_own = [&](int k, const V& value)
                                HWY_ATTR { keep(kShared + triangle * kOwn + k, value); };
      keep_own(kX3, sign * N::fma(N::splat(-3), x_a, (x_c + x_b) + x_beyond));
      keep_own(kX2Y, thrice * ((x_a - x_b) + (x_c - x_beyond)));
      keep_own(kXY2, thrice * ((y_b - y_a) + (y_beyond - y_c)));
      keep_own(kY3, sign * N::fma(three, y_c, N::splat(-1) * ((y_b + y_a) + y_beyond)));
      keep_own(kX4, (x_a + x_b) - (x_c + x_beyond));
      keep_own(kY4, (y_c + y_b) - (y_a + y_beyond));
    };
    own(0, xa, xc, x(1, 0), x(0, -1), ya, yc, y(1, 0), y(2, 1));
    own(1, xc, xa, x(0, 1), x(1, 2), yc, ya, y(0, 1), y(-1, 0));
  }

  // The polynomials of row j in the direction of the row.
  HWY_FLATTEN HWY_ATTR void make_row(int j) {
    const double from_middle = j / static_cast<double>(1 << depth_) - .5;
    const V y = N::splat(from_middle), minus_two = N::splat(-2), minus_two_y = N::splat(-2 * from_middle);
    for (int triangle = 0; triangle < 2; ++triangle) {
      for (int c = 0; c < 3; ++c) {
        const Scalar* shared = power_ + c * L;
        const Scalar* own = shared + 3 * (kShared + triangle * kOwn) * L;
        const auto of = [](const Scalar* list, int k) HWY_ATTR { return N::load(list + 3 * k * L); };
        const auto keep = [&](int k, const V& value)
                              HWY_ATTR { N::store(value, row_ + (3 * (triangle * kRow + k) + c) * L); };
        const V x4 = of(own, kX4), y4 = of(own, kY4), x2y = of(own, kX2Y);
        V value = N::fma(y4, y, of(own, kY3)), slope = N::fma(y4, y, value);
        value = N::fma(value, y, of(shared, kY2)), slope = N::fma(slope, y, value);
        value = N::fma(value, y, of(shared, kY)), slope = N::fma(slope, y, value);
        keep(0, N::fma(value, y, of(shared, k1))), keep(kSlope, slope);
        value = N::fma(y4, minus_two_y, of(own, kXY2)), slope = N::fma(y4, minus_two_y, value);
        value = N::fma(value, y, of(shared, kXY)), slope = N::fma(slope, y, value);
        keep(1, N::fma(value, y, of(shared, kX))), keep(kSlope + 1, slope);
        keep(2, N::fma(x2y, y, of(shared, kX2))), keep(kSlope + 2, x2y);
        keep(3, N::fma(x4, minus_two_y, of(own, kX3))), keep(kSlope + 3, minus_two * x4);
        keep(4, x4);
      }
    }
  }

  // The inside of a row, and the point on the diagonal, which is there.
  class InnerRow {
   public:
    HWY_ATTR HWY_INLINE InnerRow(const TrianglePatch& patch, int j, const Scalar* diagonal)
        : left_(j),
          row_(patch.row_ + 3 * kRow * L),
          x_(N::splat(-.5)),
          step_(N::splat(1. / (1 << patch.depth_))),
          unit_(N::splat(patch.unit_)),
          diagonal_(diagonal) {
      for (int c = 0; c < 3; ++c) centre_[c] = patch.centre_[c];
    }
    template <bool odd>
    HWY_ATTR HWY_INLINE void advance() {
      x_ = x_ + step_;  // exact
      --left_;
    }
    HWY_ATTR HWY_INLINE bool given(Vertex<N>& v) {
      if (left_ != 0) return false;
      row_ -= 3 * kRow * L;  // that of the lower right triangle
      v.load(diagonal_);
      return true;
    }
    template <bool odd>
    HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&along)[3], V (&across)[3]) const {
      const auto number = [&](int k) HWY_ATTR { return N::load(row_ + (3 * k + c) * L); };
      const V x4 = number(4), p = N::fma(x4, x_, number(3)), q = N::fma(p, x_, number(2)),
              r = N::fma(q, x_, number(1));
      v.position[c] = N::fma(N::fma(r, x_, number(0)), unit_, centre_[c]);
      along[c] = N::fma(N::fma(N::fma(x4, x_, p), x_, q), x_, r);
      across[c] = N::fma(N::fma(N::fma(number(kSlope + 3), x_, number(kSlope + 2)), x_, number(kSlope + 1)),
                         x_, number(kSlope));
    }

   private:
    int left_;
    const Scalar* row_;
    V x_, step_, unit_, centre_[3];
    const Scalar* diagonal_;
  };

  const Scalar* input_;
  int depth_;
  To target_;
  RegularEdge<N> edge_[kInside];
  Scalar unit_;
  V centre_[3];
  alignas(64) Scalar power_[3 * (kShared + 2 * kOwn) * L];
  alignas(64) Scalar row_[3 * 2 * kRow * L];
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
