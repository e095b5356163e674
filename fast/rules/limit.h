// SPDX-License-Identifier: MIT
// Limits of regular points inside a patch: position, tangents and unit normal. vertex_limit.h has those of
// control vertices. [mueller2000, eq. 3-5; C14-C17, D1, D2, D12, D14]
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "fast/rules/masks.h"
#include "fast/rules/surface_vertex.h"
#include "fast/rules/vertex_normal.h"

namespace limitcheck::fast {

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

/// The vertex of a limit frame. If the tangents vanish or are parallel (kParallel<N>), the normal is what
/// `substitute` returns, a unit vector in the wide number, and `zero_normals` counts it. Never NaN for finite
/// input. [D12]
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
