// SPDX-License-Identifier: MIT
// Catmull and Clark's subdivision masks, in an order of operations that gives shared points the same bits.
// [Catmull & Clark 1978; C21, D14]
#pragma once

#include "fast/rules/masks.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

// Every rule here keeps its bits under quarter turns, up to the signs of tangents, which turn exactly: a
// shared edge may be any side of either quad. So sums go over opposite pairs first. The rules of curves are
// those of Loop's scheme: midpoint() and curve_vertex() in masks.h.

/// The middle of a face with corners a, b, c, d in this order.
template <class N>
constexpr Vec3<N> quad_face_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
  return NumberTraits<N>::ratio(1, 4) * ((a + c) + (b + d));
}

/// Edge rule (a + b + f + g) / 4: a and b the ends, f and g the middles of the faces on both sides.
template <class N>
constexpr Vec3<N> quad_edge_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& f, const Vec3<N>& g) {
  using T = NumberTraits<N>;
  const Vec3<N> ends = a + b;
  return T::ratio(1, 2) * ends + T::ratio(1, 4) * ((f + g) - ends);
}

/// Eight points around one, counter-clockwise from e.
///
///        nw -- n -- ne
///         |    |    |
///         w -- v -- e
///         |    |    |
///        sw -- s -- se
template <class N>
struct QuadNeighbours {
  const Vec3<N>&e, &ne, &n, &nw, &w, &sw, &s, &se;

  constexpr Vec3<N> sides() const { return (e + w) + (n + s); }
  constexpr Vec3<N> diagonals() const { return (ne + sw) + (nw + se); }
};

/// Vertex rule for valence 4: half of v, a sixteenth of each neighbour along an edge and of each middle of a
/// face (which stand at the diagonals here).
template <class N>
constexpr Vec3<N> regular_quad_vertex(const Vec3<N>& v, const QuadNeighbours<N>& r) {
  using T = NumberTraits<N>;
  return v + T::ratio(1, 16) * ((r.sides() + r.diagonals()) - T::ratio(8, 1) * v);
}

/// The limit of a vertex of valence 4: (16 v + 4 sides + diagonals) / 36, and differences along both axes.
template <class N>
constexpr LimitFrame<N> regular_quad_limit(const Vec3<N>& v, const QuadNeighbours<N>& r) {
  using T = NumberTraits<N>;
  const auto four = T::ratio(4, 1);
  const Vec3<N> up = r.ne - r.sw, down = r.se - r.nw;
  return {v + T::ratio(1, 36) * ((four * r.sides() + r.diagonals()) - T::ratio(20, 1) * v),
          four * (r.e - r.w) + (up + down), four * (r.n - r.s) + (up - down)};
}

/// The limit of a boundary vertex of two faces, ring e, ne, n, nw, w: (4 v + e + w) / 6, along the boundary
/// e - w, across it (-4; -1, 4, -1; 1, 1).
template <class N>
constexpr LimitFrame<N> regular_quad_boundary_limit(const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& ne,
                                                    const Vec3<N>& n, const Vec3<N>& nw, const Vec3<N>& w) {
  using T = NumberTraits<N>;
  return {v + T::ratio(1, 6) * ((e + w) - T::ratio(2, 1) * v), e - w,
          T::ratio(4, 1) * (n - v) + ((ne - e) + (nw - w))};
}

/// a blended with b: weight 1 is a.
template <class N>
constexpr Vec3<N> blend(double weight, const Vec3<N>& a, const Vec3<N>& b) {
  return b + static_cast<typename NumberTraits<N>::Scalar>(weight) * (a - b);
}

}  // namespace limitcheck::fast
