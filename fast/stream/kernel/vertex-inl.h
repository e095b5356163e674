// SPDX-License-Identifier: MIT
// Limit points on their way out: their normals, and rows of them in an order that keeps the processor busy.
//
// This file and the others of the kernel are compiled once for each of Highway's targets, and once for
// numbers that are no vectors (kernel.h). So their include guards are those of Highway's own -inl.h files.

#if defined(LIMITCHECK_FAST_STREAM_VERTEX_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_VERTEX_INL_H_
#undef LIMITCHECK_FAST_STREAM_VERTEX_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_VERTEX_INL_H_
#endif

#ifndef HWY_NAMESPACE  // kernel.h has one of its own
#include <hwy/highway.h>
#endif

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// a x b to out[0..2]. The bias makes a zero product (0, 0, 1); it is below the rounding of products above 2^-36.
/// It comes last: parallel tangents may have exact products, in which it would drown. [claim D12]
/// Where faces are 1e18 times smaller than the mesh, which is scaled to size 1, a product may cancel the bias: the
/// square of what is left is subnormal, and the length of the normal off, by 0.68 at worst seen.
template <class N, class V>
HWY_ATTR HWY_INLINE void normal_direction(const V (&a)[3], const V (&b)[3], V* out) {
  out[0] = N::fms(a[1], b[2], a[2] * b[1]);
  out[1] = N::fms(a[2], b[0], a[0] * b[2]);
  out[2] = N::fms(a[0], b[1], a[1] * b[0]) + N::splat(0x1p-60);
}

/// Half the sum of p and q, with few enough digits that moving there and back costs hardly any. The same in
/// either order. Numbers without rounding have no digits to save.
template <class N, class V>
HWY_ATTR HWY_INLINE void choose_middle(const typename N::Scalar* p, const typename N::Scalar* q, V* origin) {
  const V magic = N::splat(0x1.8p11);  // a float of that size ends at 2^-12, a double at 2^-41
  for (int c = 0; c < 3; ++c)
    origin[c] = (N::splat(.5) * (N::load(p + c * N::lanes) + N::load(q + c * N::lanes)) + magic) - magic;
}
/// The same in the lanes in which a part has an origin of its own, see Part; elsewhere 0.
template <class N, class V>
HWY_ATTR HWY_INLINE void choose_origin(const typename N::Scalar* own, const typename N::Scalar* p,
                                       const typename N::Scalar* q, V* origin) {
  choose_middle<N>(p, q, origin);
  for (int c = 0; c < 3; ++c) origin[c] = N::select(N::load(own), origin[c], N::splat(0));
}

/// A vertex on its way: limit position, a normal of any length and its square. Its way to unit length is a
/// chain of dependent steps, longer than what a processor can look ahead; so it is cut in pieces, between
/// which the caller puts the arithmetic of another vertex.
///
/// 1 / sqrt(square), relative error 2.2e-7 (measured): the same operations on every machine, unlike the
/// processors' own estimates; square root and division would be exact but slower. A seed to 3 % from the
/// halved exponent, up to a factor; Newton's step y (C - x y^2) with the C that makes it flat, to 0.07 %;
/// then y p(x y^2), where p takes the factor out.
template <class N>
struct Vertex {
  using V = typename N::V;
  V position[3], normal[3], square, y, t;

  /// From tangents a and b; see kLinear in number.h.
  HWY_ATTR HWY_INLINE void set_normal(const V (&a)[3], const V (&b)[3]) {
    if constexpr (N::kLinear) {
      for (int c = 0; c < 3; ++c) normal[c] = N::tangent(a[c], b[c]);
    } else {
      normal_direction<N>(a, b, normal);
    }
  }
  HWY_ATTR HWY_INLINE void set_square() {
    if constexpr (!N::kLinear)
      square = N::fma(normal[0], normal[0], N::fma(normal[1], normal[1], normal[2] * normal[2]));
  }
  HWY_ATTR HWY_INLINE void root_1() {
    if constexpr (N::kHasSeed) {
      y = N::inverse_root_seed(square);
      t = square * y;
    } else if constexpr (!N::kLinear) {
      y = N::inverse_root(square);
    }
  }
  HWY_ATTR HWY_INLINE void root_2() {
    if constexpr (N::kHasSeed) y = y * N::fnma(t, y, N::splat(0x1.2f0a56p+2));
  }
  HWY_ATTR HWY_INLINE void root_3() {
    if constexpr (N::kHasSeed) t = (square * y) * y;
  }
  HWY_ATTR HWY_INLINE void root_4() {
    if constexpr (N::kHasSeed) {
      y = y *
          N::fma(N::fma(N::splat(0x1.9228c2p-12), t, N::splat(-0x1.48fedep-6)), t, N::splat(0x1.e474dp-2));
    }
  }
  /// Adding 0 turns -0 into +0.
  HWY_ATTR HWY_INLINE void scale() {
    if constexpr (N::kLinear) return;
    for (int c = 0; c < 3; ++c) normal[c] = N::fma(normal[c], y, N::splat(0));
  }

  HWY_ATTR HWY_INLINE void end() { root_1(), root_2(), root_3(), root_4(), scale(); }
  HWY_ATTR HWY_INLINE void finish() { set_square(), end(); }
  /// Stays in the lanes that are chosen; elsewhere it is the other. Normals of any length.
  HWY_ATTR HWY_INLINE void choose(const V& chosen, const Vertex& other) {
    for (int c = 0; c < 3; ++c) {
      position[c] = N::select(chosen, position[c], other.position[c]);
      normal[c] = N::select(chosen, normal[c], other.normal[c]);
    }
  }
  HWY_ATTR HWY_INLINE void store(typename N::Scalar* to) const {
    for (int c = 0; c < 3; ++c) {
      N::store(position[c], to + c * N::lanes);
      N::store(normal[c], to + (3 + c) * N::lanes);
    }
  }
  HWY_ATTR HWY_INLINE void load(const typename N::Scalar* from) {
    for (int c = 0; c < 3; ++c) {
      position[c] = N::load(from + c * N::lanes);
      normal[c] = N::load(from + (3 + c) * N::lanes);
    }
  }
};

/// Position and direction of the normal of the next point of a row: points.coordinate<odd>(c, v, a, b) gives coordinate
/// c of its position and of two tangents; or points.given(v) the point, if it is there already.
template <class N, bool odd, class Points>
HWY_ATTR HWY_INLINE void begin_vertex(Points&& points, Vertex<N>& v) {
  typename N::V a[3], b[3];
  points.template advance<odd>();
  if constexpr (requires { points.given(v); })
    if (points.given(v)) return v.set_square();
  for (int c = 0; c < 3; ++c) points.template coordinate<odd>(c, v, a, b);
  v.set_normal(a, b);
  v.set_square();
}
/// The same, and the end of another vertex.
template <class N, bool odd, class Points>
HWY_ATTR HWY_INLINE void begin_vertex(Points&& points, Vertex<N>& v, Vertex<N>& other) {
  typename N::V a[3], b[3];
  points.template advance<odd>();
  if constexpr (requires { points.given(v); }) {
    if (points.given(v)) {
      other.end();
      return v.set_square();
    }
  }
  other.root_1();
  points.template coordinate<odd>(0, v, a, b);
  other.root_2();
  points.template coordinate<odd>(1, v, a, b);
  other.root_3();
  points.template coordinate<odd>(2, v, a, b);
  other.root_4();
  v.set_normal(a, b);
  other.scale();
  v.set_square();
}

/// The inside of a row, points 1 .. size - 1, with its ends given; size even, or 1. `points` gives them from 1 on in
/// turn, see begin_vertex(), and is told which are odd. The normal of a point is brought to length beside the
/// arithmetic of the next: it is one chain of dependent steps. far: the rows leave no room for the output in the first-level
/// cache.
template <class N, class Points, class Row>
HWY_ATTR HWY_INLINE void scatter_row(Points& points, int size, const Vertex<N>& first, const Vertex<N>& last,
                                     const Row& to, bool far = false) {
  if (size == 1) return to.couple(0, first, last);
  Vertex<N> a = first, b, after;
  begin_vertex<N, true>(points, b);
  for (int i = 0; i + 2 < size; i += 2) {
    begin_vertex<N, false>(points, after, b);
    if (far) to.expect(i + 8);
    to.couple(i, a, b);
    a = after;
    begin_vertex<N, true>(points, b, a);
  }
  b.end();
  to.couple(size - 2, a, b);
  to.vertex(size, last);
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
