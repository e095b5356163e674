// SPDX-License-Identifier: MIT
// One row of a level to the two rows of the next that it begins, and to its limit.

#if defined(LIMITCHECK_FAST_STREAM_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#undef LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#endif

#include <cstddef>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// A corner block with `width` entries of its window from number `first` on, seen from the origin. May be in
/// place.
template <class N, class V>
HWY_ATTR void take_block(const typename N::Scalar* from, int first, int width, const V* origin, bool relative,
                         typename N::Scalar* to) {
  constexpr int L = N::lanes;
  if (from != to) {
    for (int k = 0; k < CornerBlock::kWindow; ++k) N::store(N::load(from + k * L), to + k * L);
  }
  from += (CornerBlock::kWindow + 3 * first) * L;
  for (int c = 0; c < 3; ++c) {
    typename N::Scalar* centre = to + (CornerBlock::kCentre + c) * L;
    V v = N::splat(0);
    if (relative) {
      v = N::load(centre) - origin[c];
      N::store(v, centre);
    }
    for (int t = c; t < 3 * width; t += 3) {
      const V entry = N::load(from + t * L);
      N::store(relative ? entry + v : entry, to + (CornerBlock::kWindow + t) * L);
    }
  }
}

/// One level of a corner: its centre, the sum of differences to its ring, and the window of ring entries,
/// which comes out `width` wide, one less at either end.
template <class N>
HWY_ATTR void refine_ring(typename N::Scalar* block, typename N::Scalar* window, int width) {
  using V = typename N::V;
  constexpr int L = N::lanes;
  const V k0 = N::load(block), k1 = N::load(block + L);
  for (int c = 0; c < 3; ++c, window += L) {
    typename N::Scalar* centre = block + (CornerBlock::kCentre + c) * L;
    typename N::Scalar* difference = block + (CornerBlock::kDifference + c) * L;
    const V v = N::load(centre), d = N::load(difference);
    V before = N::load(window), here = N::load(window + 3 * L);
    for (int t = 0; t < width; ++t) {
      const V after = N::load(window + 3 * (t + 2) * L);
      N::store(edge_rule<N>(v, here, before, after), window + 3 * t * L);
      before = here, here = after;
    }
    N::store(N::fma(k0, d, N::splat(8) * v), centre);
    N::store(k1 * d, difference);
  }
}

/// Rows s, m, n are rows j-1, j, j+1, each pointing at point 0. Writes the children of even row that point i
/// of row m begins: (2i, 2j) and (2i+1, 2j).
template <class N, Axis axis>
HWY_ATTR HWY_INLINE void refine_even(const typename N::Scalar* s, const typename N::Scalar* m,
                                     const typename N::Scalar* n, int i, typename N::Scalar* even) {
  constexpr int L = N::lanes;
  s += 3 * i * L, m += 3 * i * L, n += 3 * i * L, even += 6 * i * L;
  for (int c = 0; c < 3; ++c, s += L, m += L, n += L, even += L) {
    const auto v = N::load(m);
    N::store(vertex_rule<N>(v, ring_sum(hexagon<N, axis>(s, m, n))), even);
    N::store(edge_rule<N>(v, N::load(m + 3 * L), N::load(n + 3 * L), N::load(s)), even + 3 * L);
  }
}

/// Row 2j of the next level from rows j-1, j, j+1 of a level of 2^level = size, 0 <= j <= size.
template <class N>
HWY_ATTR void refine_even_row(const typename N::Scalar* s, const typename N::Scalar* m,
                              const typename N::Scalar* n, int size, int j, typename N::Scalar* even) {
  constexpr int L = N::lanes;
  for (int c = 0; c < 3; ++c) {  // the column left of the grid: only odd columns count there
    const int k = (c - 3) * L;
    N::store(edge_rule<N>(N::load(m + k), N::load(m + c * L), N::load(n + c * L), N::load(s + k)), even + k);
  }
  if (j == 0 || j == size) {
    for (int i = 0; i <= size; ++i) refine_even<N, Axis::kRow>(s, m, n, i, even);
    return;
  }
  refine_even<N, Axis::kColumn>(s, m, n, 0, even);
  for (int i = 1; i < j; ++i) refine_even<N, Axis::kRow>(s, m, n, i, even);
  refine_even<N, Axis::kDiagonal>(s, m, n, j, even);
  for (int i = j + 1; i < size; ++i) refine_even<N, Axis::kRow>(s, m, n, i, even);
  refine_even<N, Axis::kColumn>(s, m, n, size, even);
}

/// Row 2j+1 of the next level, between rows m = j and n = j+1, -1 <= j <= size: edge points only.
template <class N>
HWY_ATTR void refine_odd_row(const typename N::Scalar* m, const typename N::Scalar* n, int size,
                             typename N::Scalar* odd) {
  constexpr int L = N::lanes;
  for (int c = 0; c < 3; ++c) {
    const int k = (c - 3) * L;
    N::store(edge_rule<N>(N::load(m + k), N::load(n + c * L), N::load(m + c * L), N::load(n + k)), odd + k);
  }
  for (int i = 0; i <= size; ++i, m += 3 * L, n += 3 * L, odd += 6 * L) {
    for (int c = 0; c < 3; ++c) {
      const auto v = N::load(m + c * L), e = N::load(m + (c + 3) * L), w = N::load(m + (c - 3) * L);
      const auto nw = N::load(n + c * L), ne = N::load(n + (c + 3) * L);
      N::store(edge_rule<N>(v, nw, w, ne), odd + c * L);
      N::store(edge_rule<N>(v, ne, e, nw), odd + (c + 3) * L);
    }
  }
}

/// A point seen along an axis, from rows s, m and n, for begin_vertex().
template <class N, Axis axis>
struct PointAlong {
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  const Scalar *s, *m, *n;
  const V* centre;
  V unit;

  template <bool odd>
  HWY_ATTR HWY_INLINE void advance() const {}
  template <bool odd>
  HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&slant)[3], V (&across)[3]) const {
    const int k = c * N::lanes;
    const Limit<V> limit = limit_rule<N>(N::load(m + k), hexagon<N, axis>(s + k, m + k, n + k));
    v.position[c] = N::fma(limit.position, unit, centre[c]);
    slant[c] = limit.slant;
    across[c] = limit.across;
  }
};

/// Where a row goes. Here to the lanes' memory, which lies at equal distances; a row has
///   couple(i, a, b)   its points i and i + 1,
///   vertex(i, a)      its point i alone, the last,
///   from(i)           the row from point i on.
/// They come in their order.
template <class N>
struct LaneRow {
  typename N::Scalar* out;
  std::ptrdiff_t lane_stride;
  HWY_ATTR HWY_INLINE LaneRow from(int i) const { return {out + 6 * i, lane_stride}; }
  HWY_ATTR HWY_INLINE void couple(int i, const Vertex<N>& a, const Vertex<N>& b) const {
    N::scatter_couple(a, b, out + 6 * i, lane_stride);
  }
  HWY_ATTR HWY_INLINE void vertex(int i, const Vertex<N>& a) const {
    N::scatter_vertex(a, out + 6 * i, lane_stride);
  }
};

/// Where a batch goes: row(j), and done(j) when it is there.
template <class N>
struct LaneTarget {
  using Row = LaneRow<N>;
  Target<typename N::Scalar> to;
  HWY_ATTR HWY_INLINE Row row(int j) const { return {to.base + to.row_offset(j), to.lane_stride}; }
  HWY_ATTR HWY_INLINE void done(int j) const {
    if (to.row) to.row(to.context, j);
  }
};

/// Points 0 .. size, six vectors each.
template <class N, class Row>
HWY_ATTR void scatter_kept(const typename N::Scalar* from, int size, const Row& to) {
  constexpr int L = N::lanes;
  Vertex<N> a, b;
  for (int i = 0; i < size; i += 2, from += 12 * L) {
    a.load(from), b.load(from + 6 * L);
    to.couple(i, a, b);
  }
  a.load(from);
  to.vertex(size, a);
}

/// One row of a level to its limit, two points at a time. centre: of each lane in the caller's coordinates;
/// unit: from the scaled placement.
template <class N, class Row = LaneRow<N>>
class LimitRow {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  HWY_ATTR LimitRow(const Scalar* s, const Scalar* m, const Scalar* n, const V* centre, Scalar unit,
                    const Row& to)
      : s_(s), m_(m), n_(n), to_(to), unit_(N::splat(unit)) {
    for (int c = 0; c < 3; ++c) centre_[c] = centre[c];
  }

  /// Points 0 .. size, of which three are given, six vectors each: the ends, and the one on the diagonal.
  HWY_ATTR void run(int size, const Scalar* first, int diagonal_at, const Scalar* diagonal,
                    const Scalar* last) const {
    const Given given{size, first, diagonal_at, diagonal, last};
    const int couple = diagonal_at & ~1;
    mixed(0, given);
    if (couple > 2) plain(2, couple);
    if (couple >= 2 && couple < size) mixed(couple, given);
    if (couple + 2 < size) plain(couple + 2, size);
    if (size % 2 == 0) {
      Vertex<N> v;
      v.load(last);
      to_.vertex(size, v);
    }
  }

  /// Points from `first` to before `end`, six vectors each, that of point i to to[6 i].
  HWY_ATTR void store(int first, int end, Scalar* to) const {
    if (first >= end) return;
    Vertex<N> a, b;
    begin_vertex<N, false>(row_point(first), a);
    for (int i = first + 1; i < end; ++i) {
      begin_vertex<N, false>(row_point(i), b, a);
      a.store(to + 6 * (i - 1) * L);
      a = b;
    }
    a.end();
    a.store(to + 6 * (end - 1) * L);
  }

  /// Point i seen along an axis, six vectors.
  template <Axis axis>
  HWY_ATTR void special(int i, Scalar* to) const {
    Vertex<N> v;
    point<axis>(i, v);
    v.store(to);
  }

 private:
  struct Given {
    int size;
    const Scalar* first;
    int diagonal_at;
    const Scalar *diagonal, *last;
    const Scalar* at(int i) const {
      return i == 0 ? first : i == diagonal_at ? diagonal : i == size ? last : nullptr;
    }
  };

  template <Axis axis>
  HWY_ATTR HWY_INLINE void point(int i, Vertex<N>& v) const {
    const int k = 3 * i * L;
    begin_vertex<N, false>(PointAlong<N, axis>{s_ + k, m_ + k, n_ + k, centre_, unit_}, v);
    v.end();
  }
  HWY_ATTR HWY_INLINE PointAlong<N, Axis::kRow> row_point(int i) const {
    return {s_ + 3 * i * L, m_ + 3 * i * L, n_ + 3 * i * L, centre_, unit_};
  }

  HWY_ATTR void mixed(int i, const Given& given) const {
    Vertex<N> v[2];
    for (int k = 0; k < 2; ++k) {
      if (const Scalar* from = given.at(i + k)) {
        v[k].load(from);
      } else {
        point<Axis::kRow>(i + k, v[k]);
      }
    }
    to_.couple(i, v[0], v[1]);
  }

  // Points from even `first` to before even `end`. The tangents of a point go with the normalisation of the
  // point before, its own normalisation with the tangents of the next.
  HWY_ATTR void plain(int first, int end) const {
    Row to = to_.from(first);
    const V centre[3] = {centre_[0], centre_[1], centre_[2]};
    PointAlong<N, Axis::kRow> points = row_point(first);
    points.centre = centre;
    const auto next = [&]() HWY_ATTR { points.s += 3 * L, points.m += 3 * L, points.n += 3 * L; };
    Vertex<N> a, b;
    begin_vertex<N, false>(points, a);
    for (int i = first;; i += 2) {
      next();
      begin_vertex<N, false>(points, b, a);
      next();
      if (i + 2 == end) break;
      Vertex<N> after;
      begin_vertex<N, false>(points, after, b);
      to.couple(0, a, b);
      to = to.from(2);
      a = after;
    }
    b.end();
    to.couple(0, a, b);
  }

  const Scalar *s_, *m_, *n_;
  Row to_;
  V centre_[3], unit_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
