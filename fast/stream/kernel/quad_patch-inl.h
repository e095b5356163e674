// SPDX-License-Identifier: MIT
// Regular quads: bicubic polynomials, row by row.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_PATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_PATCH_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_PATCH_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_PATCH_INL_H_
#endif

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/quad_rows-inl.h"
#include "fast/stream/kernel/quad_rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// `lanes` quads of one depth whose four vertices are interior and of four quads each. Differences are formed
/// on the control net, seen from an origin of the quad's own, so the normals are as good at every depth.
template <class N, class To = QuadLaneTarget<N>>
class QuadPatch {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// input: kPatchSize * lanes numbers, left alone; work as for QuadStream.
  HWY_ATTR QuadPatch(const QuadBatch<Scalar>& batch, const Placement<Scalar>& placement, Scalar* work,
                     const To& target)
      : input_(batch.input),
        depth_(batch.depth),
        curves_(work + quad_curves_offset(batch.depth) * L),
        power_(work + quad_patch_offset(batch.depth) * L),
        row_(power_ + 48 * L),
        placement_(placement),
        target_(target) {
    unit_ = quad_unit(placement.unit, 0);
  }

  HWY_ATTR void run() {
    prepare();
    const int size = 1 << depth_;
    for (int j = 0; j <= size; ++j) {
      const auto to = target_.row(j);
      Vertex<N> first, last;
      if (j == 0 || j == size) {
        first.load(limit_of(j == 0 ? 0 : 3)), last.load(limit_of(j == 0 ? 1 : 2));
        side_row(j == 0 ? kAB : kCD, first, last, to);
      } else {
        curve(kDA, size - j, first), curve(kBC, j, last);
        first.finish(), last.finish();
        make_row(j);
        Inside row(row_, centre_, unit_, 1. / size);
        scatter_row<N>(row, size, first, last, to);
      }
      target_.done(j);
    }
  }

 private:
  const Scalar* point(int r, int k) const { return input_ + 3 * (4 * r + k) * L; }
  const Scalar* limit_of(int corner) const { return input_ + (kPatchLimits + 6 * corner) * L; }
  HWY_ATTR void curve(int side, int k, Vertex<N>& out) const {
    curve_point<N>(curves_ + side * QuadCurve::kSize * L, k, depth_, N::splat(unit_), out);
  }

  HWY_ATTR void prepare() {
    // Point k of row r of a side, seen from its beginning with the side to the right, is this one of the
    // grid.
    for (int side = 0; side < 4; ++side) {
      const Scalar* at[3][4];
      for (int r = 0; r < 3; ++r) {
        for (int k = 0; k < 4; ++k) {
          const int turned[4][2] = {{r, k}, {k, 3 - r}, {3 - r, 3 - k}, {3 - k, r}};
          at[r][k] = point(turned[side][0], turned[side][1]);
        }
      }
      make_curve<N>(at, placement_, curves_ + side * QuadCurve::kSize * L);
    }

    V origin[3];
    choose_middle<N>(point(1, 1), point(2, 2), origin);
    for (int c = 0; c < 3; ++c) {
      V p[4][4];
      for (int r = 0; r < 4; ++r)
        for (int k = 0; k < 4; ++k) p[r][k] = N::load(point(r, k) + c * L) - origin[c];
      for (int r = 0; r < 4; ++r) to_powers(p[r][0], p[r][1], p[r][2], p[r][3]);
      for (int k = 0; k < 4; ++k) to_powers(p[0][k], p[1][k], p[2][k], p[3][k]);
      for (int r = 0; r < 4; ++r)
        for (int k = 0; k < 4; ++k) N::store(p[r][k], power_ + (12 * k + 3 * r + c) * L);
      centre_[c] = N::fma(origin[c], N::splat(placement_.unit), N::splat(placement_.centre[c]));
    }
  }

  // Control points of a uniform cubic B-spline to the coefficients of 1, t, t^2, t^3, times 6.
  HWY_ATTR HWY_INLINE static void to_powers(V& a, V& b, V& c, V& d) {
    const V three = N::splat(3), ab = b - a, bc = c - b, cd = d - c;
    a = N::fma(N::splat(6), b, bc - ab);
    b = three * (ab + bc);
    d = (ab + cd) - N::splat(2) * bc;
    c = three * (bc - ab);
  }

  // The polynomials of row j in the direction of the row, as coefficients: of the surface, of its derivative
  // across.
  HWY_ATTR void make_row(int j) {
    const V t = N::splat(j / static_cast<double>(1 << depth_));
    for (int k = 0; k < 4; ++k) {
      for (int c = 0; c < 3; ++c) {
        const Scalar* p = power_ + (12 * k + c) * L;
        V value, slope;
        evaluate(N::load(p), N::load(p + 3 * L), N::load(p + 6 * L), N::load(p + 9 * L), t, value, slope);
        N::store(value, row_ + (3 * k + c) * L);
        N::store(slope, row_ + (12 + 3 * k + c) * L);
      }
    }
  }

  HWY_ATTR HWY_INLINE static void evaluate(V a, V b, V c, V d, V t, V& value, V& slope) {
    const V p = N::fma(d, t, c), q = N::fma(p, t, b);
    slope = N::fma(N::fma(d, t, p), t, q);
    value = N::fma(q, t, a);
  }

  // The inside of a row, see begin_vertex().
  class Inside {
   public:
    HWY_ATTR HWY_INLINE Inside(const Scalar* row, const V* centre, Scalar unit, double step)
        : row_(row), unit_(N::splat(unit)), t_(N::splat(0)), step_(N::splat(step)) {
      for (int c = 0; c < 3; ++c) centre_[c] = centre[c];
    }
    template <bool odd>
    HWY_ATTR HWY_INLINE void advance() {
      t_ = t_ + step_;  // exact
    }
    template <bool odd>
    HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&along)[3], V (&across)[3]) {
      V value;
      evaluate(number(c), number(3 + c), number(6 + c), number(9 + c), t_, value, along[c]);
      v.position[c] = N::fma(value, unit_, centre_[c]);
      across[c] =
          N::fma(N::fma(N::fma(number(21 + c), t_, number(18 + c)), t_, number(15 + c)), t_, number(12 + c));
    }

   private:
    HWY_ATTR HWY_INLINE V number(int k) const { return N::load(row_ + k * L); }

    const Scalar* row_;
    V centre_[3], unit_, t_, step_;
  };

  HWY_ATTR void side_row(int side, const Vertex<N>& first, const Vertex<N>& last,
                         const typename To::Row& to) {
    const int size = 1 << depth_;
    if (size == 1) return to.couple(0, first, last);
    const auto point = [&](int i, Vertex<N>& v) HWY_ATTR {
      curve(side, side == kAB ? i : size - i, v);
      v.finish();
    };
    scatter_points<N>(point, size, first, last, to);
  }

  const Scalar* input_;
  int depth_;
  Scalar *curves_, *power_, *row_;
  Placement<Scalar> placement_;
  V centre_[3];
  Scalar unit_;
  To target_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
