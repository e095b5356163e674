// SPDX-License-Identifier: MIT
// One row of a level of quads to the two rows of the next that it begins, and to its limit.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_ROWS_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_ROWS_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_ROWS_INL_H_
#endif

#include <cstddef>

#include "fast/stream/kernel/quad_rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// A line of points, one coordinate of each: in memory, or in what will be registers.
template <class N>
struct MemoryLine {
  typename N::Scalar* to;
  int step;
  HWY_ATTR HWY_INLINE typename N::V get(int i) const { return N::load(to + i * step); }
  HWY_ATTR HWY_INLINE void set(int i, typename N::V v) const { N::store(v, to + i * step); }
};
template <class N>
struct LocalLine {
  typename N::V* to;
  HWY_ATTR HWY_INLINE typename N::V get(int i) const { return to[i]; }
  HWY_ATTR HWY_INLINE void set(int i, typename N::V v) const { to[i] = v; }
};

/// The children of a line that has been refined across, in points 2 .. 2 size - 2: across(i) is point i of it.
template <class N, class Across, class Line>
HWY_ATTR HWY_INLINE void refine_along(const Across& across, int size, const Line& child) {
  typename N::V here = across(1), before = across(0) + here;  // point i, and the sum of points i - 1 and i
  for (int k = 2; k <= size; ++k) {
    const auto next = across(k), after = here + next;
    child.set(2 * k - 2, N::fma(N::splat(.25), before + after, here));
    if (k < size) child.set(2 * k - 1, after);
    here = next, before = after;
  }
}

/// Line 2j of the next level from lines s, m, n = j-1, j, j+1 of a level of size = 2^level >= 2, points 2 .. 2
/// size - 2. sharp: null, or 1 in the lanes where line j is a sharp side.
template <class N, class Line>
HWY_ATTR HWY_INLINE void refine_even_line(const Line& s, const Line& m, const Line& n, int size,
                                          const typename N::Scalar* sharp, const Line& even) {
  const auto across = [&](int i) HWY_ATTR {
    const auto v = m.get(i), refined = even_rule<N>(s.get(i), v, n.get(i));
    return sharp ? N::select(N::load(sharp), v + v, refined) : refined;
  };
  refine_along<N>(across, size, even);
}
/// Line 2j+1, between lines m = j and n = j+1.
template <class N, class Line>
HWY_ATTR HWY_INLINE void refine_odd_line(const Line& m, const Line& n, int size, const Line& odd) {
  refine_along<N>([&](int i) HWY_ATTR { return m.get(i) + n.get(i); }, size, odd);
}

/// A column's side, whose points -1, 0 and 1 of a row begin at `at`: refined across it. The three children.
template <class N>
HWY_ATTR HWY_INLINE void refine_across(const typename N::Scalar* at, const typename N::Scalar* sharp,
                                       typename N::V (&out)[3]) {
  using V = typename N::V;
  constexpr int step = 3 * N::lanes;
  const V a = N::load(at), b = N::load(at + step), c = N::load(at + 2 * step);
  out[0] = a + b;
  out[2] = b + c;
  out[1] = N::fma(N::splat(.25), out[0] + out[2], b);
  if (sharp) out[1] = N::select(N::load(sharp), b + b, out[1]);
}

/// The three children of a column's side in an even row; `from` leads to the parents in row m, `to` to the
/// children.
template <class N>
HWY_ATTR HWY_INLINE void refine_even_column(const typename N::Scalar* s, const typename N::Scalar* m,
                                            const typename N::Scalar* n, const typename N::Scalar* sharp,
                                            typename N::Scalar* to) {
  constexpr int L = N::lanes;
  for (int c = 0; c < 3; ++c) {
    typename N::V below[3], here[3], above[3];
    refine_across<N>(s + c * L, sharp, below);
    refine_across<N>(m + c * L, sharp, here);
    refine_across<N>(n + c * L, sharp, above);
    for (int k = 0; k < 3; ++k) N::store(even_rule<N>(below[k], here[k], above[k]), to + (3 * k + c) * L);
  }
}
template <class N>
HWY_ATTR HWY_INLINE void refine_odd_column(const typename N::Scalar* m, const typename N::Scalar* n,
                                           const typename N::Scalar* sharp, typename N::Scalar* to) {
  constexpr int L = N::lanes;
  for (int c = 0; c < 3; ++c) {
    typename N::V here[3], above[3];
    refine_across<N>(m + c * L, sharp, here);
    refine_across<N>(n + c * L, sharp, above);
    for (int k = 0; k < 3; ++k) N::store(here[k] + above[k], to + (3 * k + c) * L);
  }
}

/// One row to its limit, from left to right; the row's own line is the one that is filtered along.
template <class N>
class QuadLimitRow {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// The first point to come is `first` >= 1.
  HWY_ATTR HWY_INLINE QuadLimitRow(const Scalar* s, const Scalar* m, const Scalar* n, int first,
                                   const V* centre, Scalar unit)
      : s_(s + 3 * (first - 1) * L),
        m_(m + 3 * (first - 1) * L),
        n_(n + 3 * (first - 1) * L),
        unit_(N::splat(unit)),
        four_(N::splat(4)) {
    for (int c = 0; c < 3; ++c) {
      centre_[c] = centre[c];
      filter(c * L, p0_[c], q0_[c]);
    }
    s_ += 3 * L, m_ += 3 * L, n_ += 3 * L;
    for (int c = 0; c < 3; ++c) filter(c * L, p1_[c], q1_[c]);
  }

  /// See begin_vertex().
  template <bool odd>
  HWY_ATTR HWY_INLINE void advance() {
    s_ += 3 * L, m_ += 3 * L, n_ += 3 * L;
  }
  template <bool odd>
  HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&along)[3], V (&across)[3]) {
    V p, q;
    filter(c * L, p, q);
    v.position[c] = N::fma(N::fma(four_, p1_[c], p0_[c] + p), unit_, centre_[c]);
    along[c] = p - p0_[c];
    across[c] = N::fma(four_, q1_[c], q0_[c] + q);
    p0_[c] = p1_[c], p1_[c] = p;
    q0_[c] = q1_[c], q1_[c] = q;
  }

 private:
  HWY_ATTR HWY_INLINE void filter(int k, V& p, V& q) const {
    const V s = N::load(s_ + k), n = N::load(n_ + k);
    p = N::fma(four_, N::load(m_ + k), s + n);
    q = n - s;
  }

  const Scalar *s_, *m_, *n_;
  V p0_[3], p1_[3], q0_[3], q1_[3], centre_[3], unit_, four_;
};

/// One row of the last level to its limit without that level's points: from the level before, of which a
/// point of the last level is a point or lies halfway between two. s, m, n, o: rows q-1 .. q+2 for row 2q+1;
/// for row 2q o is not looked at.
template <class N, bool odd_row>
class FusedLimitRow {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// unit: of limit points of the level before. The first point to come is 1.
  HWY_ATTR HWY_INLINE FusedLimitRow(const Scalar* s, const Scalar* m, const Scalar* n, const Scalar* o,
                                    const V* centre, Scalar unit)
      : s_(s - 3 * L),
        m_(m - 3 * L),
        n_(n - 3 * L),
        o_(o - 3 * L),
        even_unit_(N::splat(unit * Scalar(odd_row ? .125 : 1))),
        odd_unit_(N::splat(unit * Scalar(odd_row ? 1. / 64 : .125))) {
    for (int c = 0; c < 3; ++c) {
      centre_[c] = centre[c];
      filter(c * L, p_[c][0], q_[c][0]);
    }
    next();
    for (int c = 0; c < 3; ++c) filter(c * L, p_[c][1], q_[c][1]);
    next();
    for (int c = 0; c < 3; ++c) filter(c * L, p_[c][2], q_[c][2]);
  }

  /// See begin_vertex().
  template <bool odd>
  HWY_ATTR HWY_INLINE void advance() {
    if constexpr (odd) next();
  }
  template <bool odd>
  HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&along)[3], V (&across)[3]) {
    V *p = p_[c], *q = q_[c];
    if constexpr (odd) {
      V p3, q3;
      filter(c * L, p3, q3);
      v.position[c] = N::fma(halfway(p[0], p[1], p[2], p3), odd_unit_, centre_[c]);
      along[c] = slope_halfway(p[0], p[1], p[2], p3);
      across[c] = halfway(q[0], q[1], q[2], q3);
      p[0] = p[1], p[1] = p[2], p[2] = p3;
      q[0] = q[1], q[1] = q[2], q[2] = q3;
    } else {
      v.position[c] = N::fma(limit_filter<N>(p[0], p[1], p[2]), even_unit_, centre_[c]);
      along[c] = p[2] - p[0];
      across[c] = limit_filter<N>(q[0], q[1], q[2]);
    }
  }

 private:
  // Halfway: a + 23 b + 23 c + d, 48 times the value, and d + 5 (c - b) - a, 8 times the derivative.
  HWY_ATTR HWY_INLINE static V halfway(V a, V b, V c, V d) { return N::fma(N::splat(23), b + c, a + d); }
  HWY_ATTR HWY_INLINE static V slope_halfway(V a, V b, V c, V d) { return N::fma(N::splat(5), c - b, d - a); }

  HWY_ATTR HWY_INLINE void filter(int k, V& p, V& q) const {
    const V s = N::load(s_ + k), m = N::load(m_ + k), n = N::load(n_ + k);
    if constexpr (odd_row) {
      const V o = N::load(o_ + k);
      p = halfway(s, m, n, o);
      q = slope_halfway(s, m, n, o);
    } else {
      p = limit_filter<N>(s, m, n);
      q = n - s;
    }
  }
  HWY_ATTR HWY_INLINE void next() { s_ += 3 * L, m_ += 3 * L, n_ += 3 * L, o_ += 3 * L; }

  const Scalar *s_, *m_, *n_, *o_;
  V p_[3][3], q_[3][3], centre_[3], even_unit_, odd_unit_;
};

/// A row to memory of each lane's own, see LaneRow.
template <class N>
struct QuadLaneRow {
  typename N::Scalar* const* lane;
  std::ptrdiff_t offset;
  HWY_ATTR HWY_INLINE void couple(int i, const Vertex<N>& a, const Vertex<N>& b) const {
    N::scatter_couple(a, b, place(i));
  }
  HWY_ATTR HWY_INLINE void vertex(int i, const Vertex<N>& a) const { N::scatter_vertex(a, place(i)); }
  HWY_ATTR HWY_INLINE void expect(int i) const { N::expect(place(i)); }

 private:
  HWY_ATTR HWY_INLINE auto place(int i) const {
    return [to = lane, at = offset + 6 * i](int r, int b) HWY_ATTR { return to[r + 4 * b] + at; };
  }
};
template <class N>
struct QuadLaneTarget {
  using Row = QuadLaneRow<N>;
  QuadTarget<typename N::Scalar> to;
  HWY_ATTR HWY_INLINE Row row(int j) const { return {to.lane, to.row_offset(j)}; }
  HWY_ATTR HWY_INLINE void done(int j) const {
    if (to.row) to.row(to.context, j);
  }
};

/// A row to memory of the kernel's own, six vectors to a point.
template <class N>
struct KeptRow {
  typename N::Scalar* out;
  HWY_ATTR HWY_INLINE void vertex(int i, const Vertex<N>& a) const { a.store(out + 6 * i * N::lanes); }
  HWY_ATTR HWY_INLINE void couple(int i, const Vertex<N>& a, const Vertex<N>& b) const {
    vertex(i, a), vertex(i + 1, b);
  }
  HWY_ATTR HWY_INLINE void expect(int /*i*/) const {}
};

/// Any points of a row of even size, of which the ends are given: point(i, v) makes point i.
template <class N, class Point, class Row>
HWY_ATTR HWY_INLINE void scatter_points(const Point& point, int size, const Vertex<N>& first,
                                        const Vertex<N>& last, const Row& to) {
  Vertex<N> a = first, b;
  for (int i = 0; i < size; i += 2) {
    if (i > 0) point(i, a);
    point(i + 1, b);
    to.couple(i, a, b);
  }
  to.vertex(size, last);
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
