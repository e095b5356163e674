// SPDX-License-Identifier: MIT
// Sides between two interior vertices of four quads: polynomials of the control points.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_CURVE_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_CURVE_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_CURVE_INL_H_
#endif

#include "fast/stream/kernel/quad_rules-inl.h"
#include "fast/stream/kernel/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

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
