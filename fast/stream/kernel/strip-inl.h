// SPDX-License-Identifier: MIT
// Loop's rules on the regular lattice, times 8 per level; and what is small and done often: the rings of corners from
// level to level, and strips of three rows along control edges, for the points of the edge alone. One coordinate at a
// time, so that a strip of few levels fits in registers.
//
// Bits: the edge rule is symmetric in its two ends and in its two apexes. The six-neighbour rules are written
// with an axis: half a turn about the point swaps the operands of every addition and negates every
// difference, so two grids that share an edge, and take it as the axis, compute the same bits from it.
// [claim D14]

#if defined(LIMITCHECK_FAST_STREAM_STRIP_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_STRIP_INL_H_
#undef LIMITCHECK_FAST_STREAM_STRIP_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_STRIP_INL_H_
#endif

#include <type_traits>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/regular_edge-inl.h"
#include "fast/stream/kernel/vertex-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

enum class Axis { kRow, kColumn, kDiagonal };

template <class V>
struct Hexagon {  // seen along the axis: e ahead, w behind
  V e, ne, nw, w, sw, se;
};

template <class V>
HWY_ATTR HWY_INLINE V ring_sum(const Hexagon<V>& h) {
  return (h.e + h.w) + ((h.ne + h.nw) + (h.sw + h.se));
}

/// 8 (3/8 (a + b) + 1/8 (c + d)).
template <class N, class V>
HWY_ATTR HWY_INLINE V edge_rule(V a, V b, V c, V d) {
  return N::fma(N::splat(3), a + b, c + d);
}

/// 8 (5/8 v + 1/16 sum).
template <class N, class V>
HWY_ATTR HWY_INLINE V vertex_rule(V v, V sum) {
  return N::fma(N::splat(5), v, N::splat(.5) * sum);
}

/// Neighbours seen along the row, seen along another axis.
template <Axis axis, class V>
HWY_ATTR HWY_INLINE Hexagon<V> turned(const Hexagon<V>& h) {
  if constexpr (axis == Axis::kRow) return h;
  if constexpr (axis == Axis::kColumn) return {h.nw, h.w, h.sw, h.se, h.e, h.ne};
  if constexpr (axis == Axis::kDiagonal) return {h.ne, h.nw, h.w, h.sw, h.se, h.e};
}

/// The six neighbours of number k of row m, below s and above n; `lanes` numbers each, three to a point.
template <class N, Axis axis>
HWY_ATTR HWY_INLINE Hexagon<typename N::V> hexagon(const typename N::Scalar* s, const typename N::Scalar* m,
                                                   const typename N::Scalar* n) {
  constexpr int step = 3 * N::lanes;
  return turned<axis>(Hexagon<typename N::V>{N::load(m + step), N::load(n + step), N::load(n),
                                             N::load(m - step), N::load(s - step), N::load(s)});
}

/// Limit of a regular point: 12 position = 6 v + sum; of the tangents u = 2 (e - w) + ne - nw + se - sw along
/// the axis and across = ne + nw - sw - se, (u + across) / 2 is cheaper than u and spans the same plane with
/// it. [C14, C17]
template <class V>
struct Limit {
  V position, slant, across;
};

template <class N, class V>
HWY_ATTR HWY_INLINE Limit<V> limit_rule(V v, const Hexagon<V>& h) {
  const V north = h.ne + h.nw, south = h.sw + h.se;
  return {N::fma(N::splat(6), v, (h.e + h.w) + (north + south)), (h.e - h.w) + (h.ne - h.sw), north - south};
}

/// run(depth) with a depth of 1 to 4 as a constant, or with 0 for any other and for numbers that fit in no register.
template <class N, class Run>
HWY_ATTR HWY_INLINE void with_known(int depth, const Run& run) {
  if constexpr (N::kInRegisters) {
    if (depth == 1) return run(std::integral_constant<int, 1>());
    if (depth == 2) return run(std::integral_constant<int, 2>());
    if (depth == 3) return run(std::integral_constant<int, 3>());
    if (depth == 4) return run(std::integral_constant<int, 4>());
  }
  run(std::integral_constant<int, 0>());
}

/// body(i) for i = first .. end - 1; if the bounds are known, written out, so that arrays with the index i become
/// registers.
template <bool known, class Body>
HWY_ATTR HWY_INLINE void each(int first, int end, const Body& body) {
  if constexpr (known) {
#pragma GCC unroll 32
    for (int i = first; i < end; ++i) body(i);
  } else {
    for (int i = first; i < end; ++i) body(i);
  }
}
/// The same for the first levels up to a known one, with loops inside; or up to any, if 0 is known.
template <int known, class Body>
HWY_ATTR HWY_INLINE void each_level(int end, const Body& body) {
  if constexpr (known > 1) each_level<known - 1>(known - 1, body);
  if constexpr (known > 0) {
    body(known - 1);
  } else {
    for (int level = 0; level < end; ++level) body(level);
  }
}

/// Numbers of the kernel by index: an array, or with count 0 as many as there are in memory.
template <class N, int count>
struct Numbers {
  typename N::V at[count];
  explicit Numbers(typename N::Scalar* /*memory*/) {}
  HWY_ATTR HWY_INLINE typename N::V get(int i) const { return at[i]; }
  HWY_ATTR HWY_INLINE void set(int i, const typename N::V& x) { at[i] = x; }
};
template <class N>
struct Numbers<N, 0> {
  typename N::Scalar* at;
  explicit Numbers(typename N::Scalar* memory) : at(memory) {}
  HWY_ATTR HWY_INLINE typename N::V get(int i) const { return N::load(at + i * N::lanes); }
  HWY_ATTR HWY_INLINE void set(int i, const typename N::V& x) { N::store(x, at + i * N::lanes); }
};

/// One coordinate of a corner on its way through the levels: its centre, the sum of differences to its ring, and the
/// window of ring entries, which loses one at either end with each level. most: so many entries, or 0 for any number.
template <class N, int most>
struct Ring {
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  V k0, k1, centre, difference;
  Numbers<N, most> entry;

  /// Of a corner block `width` entries of the window from number `first` on, seen from an origin if it is not null.
  HWY_ATTR HWY_INLINE Ring(const Scalar* block, int c, int first, int width, const V* origin, Scalar* memory)
      : k0(N::load(block)),
        k1(N::load(block + L)),
        centre(N::load(block + (CornerBlock::kCentre + c) * L)),
        difference(N::load(block + (CornerBlock::kDifference + c) * L)),
        entry(memory) {
    block += (CornerBlock::kWindow + 3 * first + c) * L;
    if (origin != nullptr) {
      const V from = origin[c];
      centre = centre - from;
      each<(most > 0)>(0, width, [&](int t) HWY_ATTR { entry.set(t, N::load(block + 3 * t * L) - from); });
    } else {
      each<(most > 0)>(0, width, [&](int t) HWY_ATTR { entry.set(t, N::load(block + 3 * t * L)); });
    }
  }

  /// To the next level, with so many entries there.
  HWY_ATTR HWY_INLINE void refine(int width) {
    V before = entry.get(0), here = entry.get(1);
    each<(most > 0)>(0, width, [&](int t) HWY_ATTR {
      const V after = entry.get(t + 2);
      entry.set(t, edge_rule<N>(centre, here, before, after));
      before = here, here = after;
    });
    centre = N::fma(k0, difference, N::splat(8) * centre);
    difference = k1 * difference;
  }
};

/// Points of a row that are there as positions and normals of any length, six vectors each, for begin_vertex().
template <class N>
struct KeptPoints {
  const typename N::Scalar* at;  // before the point to come
};
template <class N, bool odd>
HWY_ATTR HWY_INLINE void begin_vertex(KeptPoints<N>& points, Vertex<N>& v) {
  points.at += 6 * N::lanes;
  v.load(points.at);
  v.set_square();
}
template <class N, bool odd>
HWY_ATTR HWY_INLINE void begin_vertex(KeptPoints<N>& points, Vertex<N>& v, Vertex<N>& other) {
  other.end();
  begin_vertex<N, odd>(points, v);
}

/// `lanes` control edges P Q of one depth, N = 2^depth, at once. Work O(2^depth): the rows next to an edge
/// need nothing but themselves and the rings of its two ends, and the same operations give the same bits as a
/// grid that has the edge on its border or for its diagonal.
///
///      up 0   up 1   ..  up N-1        up: left of P Q, down: right of it.
///     P ---- 1 ---- 2 .. ---- Q
///      down 0 down 1 .. down N-1       Points beyond the ends come from their rings.
template <class N>
class EdgeStream {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// work: edge_work_size(depth) * lanes.
  HWY_ATTR EdgeStream(int depth, const BatchPlacement<Scalar>& placement, Scalar* work)
      : depth_(depth), placement_(placement), unit_(limit_unit(placement.unit, depth)), work_(work) {}

  /// Position, and a normal of any length, of points 1 .. 2^depth - 1: to out[6 k .. 6 k + 5], `lanes` numbers each.
  HWY_ATTR void points(const EdgeInput<Scalar>& edge, Scalar* out) {
    if (!edge.all_regular) stream(edge, out);
    if (edge.some_regular) take_regular(edge, out);
  }

  /// The same, and the ends, as a row.
  template <class Row>
  HWY_ATTR void scatter(const EdgeInput<Scalar>& edge, const Row& to) {
    points(edge, work_);
    scatter_kept(edge, work_, to);
  }
  template <class Row>
  HWY_ATTR void scatter_kept(const EdgeInput<Scalar>& edge, const Scalar* kept, const Row& to) const {
    Vertex<N> first, last;
    first.load(edge.p + CornerBlock::kLimit * L), last.load(edge.q + CornerBlock::kLimit * L);
    KeptPoints<N> points{kept};
    scatter_row<N>(points, 1 << depth_, first, last, to);
  }

 private:
  Scalar* across_of(int i) const { return work_ + (edge_output_size(depth_) + 3 * i) * L; }

  HWY_ATTR void stream(const EdgeInput<Scalar>& edge, Scalar* out) {
    V origin[3] = {N::splat(0), N::splat(0), N::splat(0)};
    if (placement_.local)
      choose_origin<N>(edge.own, edge.p + CornerBlock::kCentre * L, edge.q + CornerBlock::kCentre * L,
                       origin);
    with_known<N>(depth_, [&](auto known) HWY_ATTR {
      for (int c = 0; c < 3; ++c)
        coordinate<known()>(c, edge.p, edge.p_first, edge.q, edge.q_first, origin, out);
    });
    for (int i = 1; i < 1 << depth_; ++i) {
      const Scalar* across = across_of(i);
      Scalar* slant = out + (6 * i + 3) * L;
      V a[3], b[3];
      for (int c = 0; c < 3; ++c) a[c] = N::load(slant + c * L), b[c] = N::load(across + c * L);
      Vertex<N> v;
      v.set_normal(a, b);
      for (int c = 0; c < 3; ++c) N::store(v.normal[c], slant + c * L);
    }
  }

  // Regular edges, in the lanes that have such.
  HWY_ATTR void take_regular(const EdgeInput<Scalar>& edge, Scalar* out) const {
    const auto end = [&](const Scalar* block, int first) {
      return RegularEnd<N>{block, first + depth_ + 1, first + edge_window_width(depth_)};
    };
    const RegularEdge<N> regular(end(edge.p, edge.p_first), end(edge.q, edge.q_first), placement_);
    RegularEdgeRow<N> row(regular, depth_, 0);
    for (int i = 1; i < 1 << depth_; ++i) {
      Vertex<N> v, other;
      begin_vertex<N, true>(row, v);
      if (!edge.all_regular) {
        other.load(out + 6 * i * L);
        v.choose(N::load(edge.regular), other);
      }
      v.store(out + 6 * i * L);
    }
  }

  // One coordinate of the points and of their two tangents.
  template <int known>
  HWY_FLATTEN HWY_ATTR void coordinate(int c, const Scalar* p, int p_first, const Scalar* q, int q_first,
                                       const V* origin, Scalar* out) {
    constexpr bool k = known > 0;
    constexpr int kEntries = k ? edge_window_width(known) : 0, kPoints = k ? 1 << known : 0;
    const int depth = k ? known : depth_, end = 1 << depth, width = edge_window_width(depth);
    Scalar* memory = across_of(end + 1);
    Ring<N, kEntries> a(p, c, p_first, width, origin, memory);
    Ring<N, kEntries> b(q, c, q_first, width, origin, memory + width * L);
    memory += 2 * width * L;
    Numbers<N, k ? kPoints + 1 : 0> line(memory);
    Numbers<N, kPoints> up(memory + (end + 1) * L), down(memory + (2 * end + 1) * L);

    line.set(0, a.centre), line.set(1, b.centre);
    up.set(0, a.entry.get(depth + 2)), down.set(0, a.entry.get(depth));
    each_level<known>(depth, [&](int level) HWY_ATTR {
      refine_line<k>(1 << level, line, up, down);
      // What the rings of the ends give: the ends, and the points next to them across the edge. At P the left
      // neighbour comes after the edge, at Q before it.
      const int middle = depth - level, size = 2 << level;
      a.refine(2 * middle + 1), b.refine(2 * middle + 1);
      line.set(0, a.centre), line.set(size, b.centre);
      up.set(0, a.entry.get(middle + 1)), down.set(0, a.entry.get(middle - 1));
      up.set(size - 1, b.entry.get(middle - 1)), down.set(size - 1, b.entry.get(middle + 1));
    });

    const V unit = N::splat(unit_),
            centre = N::fma(origin[c], N::splat(placement_.unit), N::splat(placement_.centre[c]));
    V w = line.get(0), v = line.get(1), nw = up.get(0), sw = down.get(0);
    each<k>(1, end, [&](int i) HWY_ATTR {
      const V e = line.get(i + 1), ne = up.get(i), se = down.get(i);
      const Limit<V> limit = limit_rule<N>(v, Hexagon<V>{e, ne, nw, w, sw, se});
      N::store(N::fma(limit.position, unit, centre), out + (6 * i + c) * L);
      N::store(limit.slant, out + (6 * i + 3 + c) * L);
      N::store(limit.across, across_of(i) + c * L);
      w = v, v = e, nw = ne, sw = se;
    });
  }

  // From `size` edges to twice as many, in place, from the last on; but for what the rings of the ends give.
  template <bool known, class Line, class Side>
  HWY_ATTR HWY_INLINE static void refine_line(int size, Line& line, Side& up, Side& down) {
    V e = line.get(size), v = line.get(size - 1), above = up.get(size - 1), below = down.get(size - 1);
    V above_after = above, below_after = below;
    each<known>(0, size, [&](int back) HWY_ATTR {
      const int i = size - 1 - back;
      line.set(2 * i + 1, edge_rule<N>(v, e, above, below));
      if (back > 0) {
        up.set(2 * i + 1, edge_rule<N>(e, above, v, above_after));
        down.set(2 * i + 1, edge_rule<N>(e, below, v, below_after));
      }
      above_after = above, below_after = below;
      if (i == 0) return;
      const V w = line.get(i - 1);
      above = up.get(i - 1), below = down.get(i - 1);
      line.set(2 * i, vertex_rule<N>(v, ring_sum(Hexagon<V>{e, above_after, above, w, below, below_after})));
      up.set(2 * i, edge_rule<N>(v, above_after, e, above));
      down.set(2 * i, edge_rule<N>(v, below_after, e, below));
      e = v, v = w;
    });
  }

  int depth_;
  BatchPlacement<Scalar> placement_;
  Scalar unit_;
  Scalar* work_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
