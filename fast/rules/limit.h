// SPDX-License-Identifier: MIT
// Limit positions, tangents and normals.                [mueller2000, eq. 3-5; C14-C17, D1, D2, D12, D14]
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "fast/rules/masks.h"
#include "fast/rules/surface_vertex.h"
#include "fast/rules/vertex_normal.h"

namespace limitcheck::fast {

/// Position and two tangents of the limit surface, all linear in the control points; du x dv points outward.
template <class N>
struct LimitFrame {
  Vec3<N> position, du, dv;
};

/// At a vertex of valence 6, (6 v + ring) / 12, du = 2 C and dv = 2 S / sqrt(3) of the ring started at e.
/// Both tangents are sums of differences of near points. A half turn of the ring negates both exactly.
///
///        1 --- 1             -1 --- 1              1 --- 1
///       / \   / \            / \   / \            / \   / \            .
///      1 --- 6 --- 1       -2 --- 0 --- 2        0 --- 0 --- 0
///       \ /   \ /            \ /   \ /            \ /   \ /
///        1 --- 1             -1 --- 1             -1 --- -1
template <class N>
constexpr LimitFrame<N> regular_limit(const Vec3<N>& v, const AxisRing<N>& r) {
  using T = NumberTraits<N>;
  return {v + T::ratio(1, 12) * (axis_sum(r) - T::ratio(6, 1) * v),
          T::ratio(2, 1) * (r.e - r.w) + ((r.ne - r.nw) + (r.se - r.sw)), (r.ne - r.se) + (r.nw - r.sw)};
}

/// At a boundary vertex of three faces, ring e, ne, nw, w counter-clockwise: (4 v + e + w) / 6, along the
/// boundary e - w, across it (-2; -1, 2, 2, -1). [D1, D2]
template <class N>
constexpr LimitFrame<N> regular_boundary_limit(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& ne,
                                               const Vec3<N>& nw, const Vec3<N>& w) {
  using T = NumberTraits<N>;
  return {v + T::ratio(1, 6) * ((e + w) - T::ratio(2, 1) * v), e - w,
          T::ratio(2, 1) * ((ne - v) + (nw - v)) - ((e - v) + (w - v))};
}

/// At a control vertex. `ring` counter-clockwise from outside in a canonical order: any start for an interior
/// vertex (n >= 3), r_0 .. r_K along the boundary from end to end (`open`, n = K + 1 >= 2). Summed in the
/// wide number from differences to v.
template <class N>
LimitFrame<typename NumberTraits<N>::Wide> vertex_limit(const Vec3<N>& v, std::span<const Vec3<N>> ring,
                                                        bool open) {
  using W = typename NumberTraits<N>::Wide;
  using T = NumberTraits<W>;
  const Vec3<W> c = widen<N>(v);
  const int n = static_cast<int>(ring.size());
  const auto difference = [&](int i) { return widen<N>(ring[static_cast<std::size_t>(i)]) - c; };
  if (!open) {
    // v + sum (r_i - v) / (w + n), w = 3 n / (8 a)
    const auto a8 = T::ratio(8, 1) * loop_a<W>(n);
    const auto weight = a8 / (T::ratio(n, 1) * (T::ratio(3, 1) + a8));
    Vec3<W> sum{}, cosines{}, sines{};
    for (int i = 0; i < n; ++i) {
      const Vec3<W> d = difference(i);
      sum = sum + d;
      cosines = cosines + T::cosine(i, n) * d;
      sines = sines + T::sine(i, n) * d;
    }
    return {c + weight * sum, cosines, sines};
  }
  // theta = pi / K; inner sin(i theta), ends -c (1 + c) / ((1 + 2 c) s); K = 1 and 2 as limits of that
  const int faces = n - 1;
  const Vec3<W> first = difference(0), last = difference(faces);
  Vec3<W> across{};
  if (faces == 1) {
    across = first + last;
  } else if (faces == 2) {
    across = difference(1);
  } else {
    const auto cosine = T::cosine(1, 2 * faces), sine = T::sine(1, 2 * faces);
    const auto one = T::ratio(1, 1), two = T::ratio(2, 1);
    const auto end = cosine * (one + cosine) / ((one + two * cosine) * sine);
    across = T::ratio(-1, 1) * (end * (first + last));
    for (int i = 1; i < faces; ++i) across = across + T::sine(i, 2 * faces) * difference(i);
  }
  return {c + T::ratio(1, 6) * (first + last), first - last, across};
}

/// The unit vertex of a frame inside a patch. If the tangents vanish or are parallel (kParallel), the normal
/// is what `substitute` returns, a unit vector in the wide number, and `zero_normals` counts it. Never NaN
/// for finite input. [D12]
template <class N>
class LimitSurface {
 public:
  using Vertex = SurfaceVertex<N>;

  template <class Substitute>
  static Vertex vertex(const LimitFrame<N>& frame, Substitute&& substitute, std::int64_t& zero_normals) {
    Vec3<N> normal = cross(frame.du, frame.dv);
    const N square = dot(normal, normal);
    // + 0 turns a negative zero into zero: its sign would depend on the direction of the axis.
    const Vec3<N> zero{N(0), N(0), N(0)};
    if (!(square > kSquare * dot(frame.du, frame.du) * dot(frame.dv, frame.dv)) || square < kSmallest)
        [[unlikely]] {
      ++zero_normals;
      return {frame.position, narrow<N>(substitute()) + zero};
    }
    using std::sqrt;
    return {frame.position, N(1) / sqrt(square) * normal + zero};
  }

 private:
  static constexpr N kSquare = N(kParallel<N> * kParallel<N>);
  static constexpr N kSmallest = std::numeric_limits<N>::min();
};

}  // namespace limitcheck::fast
