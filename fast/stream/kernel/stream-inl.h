// SPDX-License-Identifier: MIT
// One row of a level to the two rows of the next that it begins, and to its limit; and the engine of a batch:
// rows trickle down the levels, each point of each level is computed once.

#if defined(LIMITCHECK_FAST_STREAM_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#undef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#endif

#include <array>
#include <cstddef>
#include <type_traits>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/strip-inl.h"
#include "fast/stream/kernel/vertex-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// Row 2j of the next level from rows j-1, j, j+1 of a level of 2^level = size, 0 <= j <= size. Neighbours stay in
/// registers from point to point.
template <class N>
HWY_FLATTEN HWY_ATTR void refine_even_row(const typename N::Scalar* s, const typename N::Scalar* m,
                                          const typename N::Scalar* n, int size, int j,
                                          typename N::Scalar* even) {
  using V = typename N::V;
  constexpr int L = N::lanes, step = 3 * L;
  constexpr std::integral_constant<Axis, Axis::kRow> row;
  constexpr std::integral_constant<Axis, Axis::kColumn> column;
  constexpr std::integral_constant<Axis, Axis::kDiagonal> diagonal;
  for (int c = 0; c < 3; ++c, s += L, m += L, n += L, even += L) {
    V w = N::load(m - step), v = N::load(m), sw = N::load(s - step), nw = N::load(n);
    N::store(edge_rule<N>(w, v, nw, sw), even - step);  // left of the grid: only odd columns count there
    int k = 0;
    const auto children_before = [&](int end, auto axis) HWY_ATTR {
      for (; k < end * step; k += step) {
        const V e = N::load(m + k + step), ne = N::load(n + k + step), se = N::load(s + k);
        const Hexagon<V> around{e, ne, nw, w, sw, se};
        N::store(vertex_rule<N>(v, ring_sum(turned<decltype(axis)::value>(around))), even + 2 * k);
        N::store(edge_rule<N>(v, e, ne, se), even + 2 * k + step);
        w = v, v = e, nw = ne, sw = se;
      }
    };
    const bool border = j == 0 || j == size;
    if (!border) {
      children_before(1, column);
      children_before(j, row);
      children_before(j + 1, diagonal);
      children_before(size, row);
    }
    border ? children_before(size + 1, row) : children_before(size + 1, column);
  }
}

/// Row 2j+1 of the next level, between rows m = j and n = j+1, -1 <= j <= size: edge points only.
template <class N>
HWY_ATTR void refine_odd_row(const typename N::Scalar* m, const typename N::Scalar* n, int size,
                             typename N::Scalar* odd) {
  using V = typename N::V;
  constexpr int L = N::lanes, step = 3 * L;
  for (int c = 0; c < 3; ++c, m += L, n += L, odd += L) {
    V w = N::load(m - step), v = N::load(m), nw = N::load(n);
    N::store(edge_rule<N>(w, nw, v, N::load(n - step)), odd - step);
    for (int k = 0; k <= size * step; k += step) {
      const V e = N::load(m + k + step), ne = N::load(n + k + step);
      N::store(edge_rule<N>(v, nw, w, ne), odd + 2 * k);
      N::store(edge_rule<N>(v, ne, e, nw), odd + 2 * k + step);
      w = v, v = e, nw = ne;
    }
  }
}

/// Where a row goes. Here to the lanes' memory, which lies at equal distances; a row has
///   couple(i, a, b)   its points i and i + 1,
///   vertex(i, a)      its point i alone, the last.
/// They come in their order.
template <class N>
struct LaneRow {
  typename N::Scalar* out;
  std::ptrdiff_t lane_stride;
  HWY_ATTR HWY_INLINE void couple(int i, const Vertex<N>& a, const Vertex<N>& b) const {
    N::scatter_couple(a, b, place(i));
  }
  HWY_ATTR HWY_INLINE void vertex(int i, const Vertex<N>& a) const { N::scatter_vertex(a, place(i)); }
  /// Point i will be written soon.
  HWY_ATTR HWY_INLINE void expect(int i) const { N::expect(place(i)); }

 private:
  HWY_ATTR HWY_INLINE auto place(int i) const {
    auto* to = out + 6 * i;
    __asm__("" : "+r"(to));  // else compilers keep the place of each store of the loop, on the stack
    return [to, stride = lane_stride](int r, int b) HWY_ATTR { return to + r * stride + 4 * b * stride; };
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

/// One row of a level to its limit, see begin_vertex(): points from 1 on. centre: of each lane in the caller's
/// coordinates; unit: from the scaled placement.
template <class N>
class LimitRow {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  HWY_ATTR HWY_INLINE LimitRow(const Scalar* s, const Scalar* m, const Scalar* n, const V* centre,
                               Scalar unit)
      : s_(s), m_(m), n_(n), unit_(N::splat(unit)) {
    for (int c = 0; c < 3; ++c) centre_[c] = centre[c];
  }

  /// Point i is there already: its position, and a normal of any length, six vectors.
  HWY_ATTR HWY_INLINE void give(int i, const Scalar* point) { given_at_ = m_ + 3 * i * L, given_ = point; }

  /// Point i seen along an axis.
  template <Axis axis>
  HWY_ATTR HWY_INLINE void along(int i, Vertex<N>& v) const {
    V a[3], b[3];
    for (int c = 0; c < 3; ++c) put<axis>((3 * i + c) * L, c, v, a, b);
    v.set_normal(a, b);
  }

  template <bool odd>
  HWY_ATTR HWY_INLINE void advance() {
    s_ += 3 * L, m_ += 3 * L, n_ += 3 * L;
  }
  HWY_ATTR HWY_INLINE bool given(Vertex<N>& v) const {
    if (m_ != given_at_) return false;
    v.load(given_);
    return true;
  }
  template <bool odd>
  HWY_ATTR HWY_INLINE void coordinate(int c, Vertex<N>& v, V (&slant)[3], V (&across)[3]) const {
    put<Axis::kRow>(c * L, c, v, slant, across);
  }

 private:
  template <Axis axis>
  HWY_ATTR HWY_INLINE void put(int k, int c, Vertex<N>& v, V (&slant)[3], V (&across)[3]) const {
    const Limit<V> limit = limit_rule<N>(N::load(m_ + k), hexagon<N, axis>(s_ + k, m_ + k, n_ + k));
    v.position[c] = N::fma(limit.position, unit_, centre_[c]);
    slant[c] = limit.slant;
    across[c] = limit.across;
  }

  const Scalar *s_, *m_, *n_;
  V centre_[3], unit_;
  const Scalar *given_at_ = nullptr, *given_ = nullptr;
};

/// `lanes` grids of one depth, from their control points to their limit points, a row at a time. A level
/// keeps a window of three rows, so memory is O(2^depth) whatever the mesh; nothing is allocated.
///
/// To: where they go, see LaneTarget.
template <class N, class To = LaneTarget<N>>
class Stream {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// input: input_size(depth) * lanes numbers; work: work_size(depth) * lanes.
  /// Both aligned to 64 bytes; work holds finite numbers.
  HWY_ATTR Stream(Scalar* input, int depth, const BatchPlacement<Scalar>& placement, Scalar* work,
                  const To& target)
      : input_(input),
        border_(work + border_offset(depth) * L),
        strip_work_(work),
        strips_(work + strips_offset(depth) * L),
        depth_(depth),
        placement_(placement),
        unit_(limit_unit(placement.unit, depth)),
        target_(target),
        edge_(depth, placement, strip_work_) {
    for (int level = 0; level <= depth; ++level) rows_[level] = work + (rows_offset(level) + 3) * L;
  }

  HWY_ATTR void run() {
    for (int c = 0; c < 3; ++c) centre_[c] = N::splat(placement_.centre[c]);
    V moved[3];
    const V* origin = nullptr;
    if (placement_.local) {
      move_origin(moved);
      origin = moved;
    }
    with_known<N>(depth_, [&](auto known) HWY_ATTR {
      for (const int corner : {kA, kC}) refine_corner<known(), core_width(kA)>(corner, origin);
      for (const int corner : {kB, kD}) refine_corner<known(), core_width(kB)>(corner, origin);
    });
    for (int j = -1; j <= 2; ++j) receive(0, j);
  }

 private:
  Scalar* corner_block(int corner) const { return input_ + corner * corner_block_size(depth_) * L; }
  const Scalar* own(Part part) const { return input_ + (parts_offset(depth_) + part) * L; }
  Scalar* strip(Part edge, int point) const {
    return strips_ + ((edge - kBC) * edge_output_size(depth_) + 6 * point) * L;
  }

  EdgeInput<Scalar> input_of(Part edge) const {
    const EdgeEnds& at = kEdgeEnds[edge];
    return {corner_block(at.p),
            at.p_first,
            corner_block(at.q),
            at.q_first,
            own(edge),
            input_ + (regular_offset(depth_) + edge) * L,
            (placement_.some_regular >> edge & 1) != 0,
            (placement_.all_regular >> edge & 1) != 0};
  }

  // The grid's edges before its inside, each from an origin of its own: A B is row 0, the others are kept until their rows
  // come. Then the grid has an origin on its diagonal.
  HWY_ATTR void move_origin(V* origin) {
    edge_.scatter(input_of(kAB), target_.row(0));
    target_.done(0);
    for (const Part edge : {kBC, kCD, kDA, kAC}) edge_.points(input_of(edge), strip(edge, 0));
    choose_origin<N>(own(kInside), corner_block(kA) + CornerBlock::kCentre * L,
                     corner_block(kC) + CornerBlock::kCentre * L, origin);
    for (int c = 0; c < 3; ++c) centre_[c] = N::fma(origin[c], N::splat(placement_.unit), centre_[c]);
  }

  // One corner through all levels; what the rows of each level take from it is kept. origin: null if it is not moved.
  template <int known, int core>
  HWY_FLATTEN HWY_ATTR void refine_corner(int corner, const V* origin) {
    const int depth = known > 0 ? known : depth_;
    for (int c = 0; c < 3; ++c) {
      Ring<N, known == 0 ? 0 : core + 2 * known> ring(corner_block(corner), c, 0, core + 2 * depth, origin,
                                                      strip_work_);
      each_level<(known > 0 ? known + 1 : 0)>(depth + 1, [&](int level) HWY_ATTR {
        const int first = depth - level;
        Scalar* kept = border(level, corner) + c * L;
        N::store(ring.centre, kept);
        N::store(ring.entry.get(first), kept + 3 * L);
        N::store(ring.entry.get(first + core - 1), kept + 6 * L);
        if (level < depth) ring.refine(core + 2 * first - 2);
      });
    }
  }

  Scalar* border(int level, int corner) const { return border_ + kBorderSize * (4 * level + corner) * L; }
  Scalar* row(int level, int j) const { return rows_[level] + (j + 1) % 3 * row_size(level) * L; }

  HWY_ATTR void copy_point(const Scalar* from, Scalar* to_row, int i) const {
    for (int c = 0; c < 3; ++c) N::store(N::load(from + c * L), to_row + (3 * i + c) * L);
  }

  // Points next to the corners come from their rings, whose valence is the corner's own. B and D first: with
  // 2^level = 1 they share entries with A and C, and only those are right beside a singleton's diagonal.
  HWY_ATTR void take_border(int level, int j) const {
    const int size = 1 << level;
    Scalar* r = row(level, j);
    constexpr int kFirst = 3 * L, kLast = 6 * L;
    const Scalar *a = border(level, kA), *b = border(level, kB), *c = border(level, kC),
                 *d = border(level, kD);
    if (j == -1) copy_point(b + kLast, r, size - 1), copy_point(a + kFirst, r, 0);
    if (j == size - 1) copy_point(d + kFirst, r, -1);
    if (j == 1) copy_point(b + kFirst, r, size + 1);
    if (j == 0) copy_point(a + kLast, r, -1), copy_point(a, r, 0), copy_point(b, r, size);
    if (j == size) copy_point(c + kLast, r, size + 1), copy_point(c, r, size), copy_point(d, r, 0);
    if (j == size + 1) copy_point(d + kLast, r, 1), copy_point(c + kFirst, r, size);
  }

  // Row j of a level is complete but for what the corners own.
  HWY_ATTR void receive(int level, int j) {
    take_border(level, j);
    if (j < 0) return;
    const Scalar *middle = row(level, j - 1), *above = row(level, j);
    const Scalar* below = j >= 1 ? row(level, j - 2) : nullptr;
    const int size = 1 << level;
    if (level == depth_) {
      if (below) limit(below, middle, above, j - 1);
      return;
    }
    if (below) {
      refine_even_row<N>(below, middle, above, size, j - 1, row(level + 1, 2 * j - 2));
      receive(level + 1, 2 * j - 2);
    }
    refine_odd_row<N>(middle, above, size, row(level + 1, 2 * j - 1));
    receive(level + 1, 2 * j - 1);
  }

  HWY_ATTR void limit(const Scalar* s, const Scalar* m, const Scalar* n, int j) {
    const int size = 1 << depth_;
    const bool local = placement_.local, border = j == 0 || j == size;
    if (local && j == 0) return;
    const auto to = target_.row(j);
    if (local && j == size) {
      edge_.scatter_kept(input_of(kCD), strip(kCD, 0), to);
      return target_.done(j);
    }
    alignas(64) Scalar special[6 * L];
    const Scalar* diagonal = special;
    Vertex<N> first, last;
    if (local) {
      diagonal = strip(kAC, j);
      first.load(strip(kDA, j)), first.finish();
      last.load(strip(kBC, j)), last.finish();
    } else if (border) {
      first.load(corner_limit(j == 0 ? kA : kD)), last.load(corner_limit(j == 0 ? kB : kC));
    } else {
      const LimitRow<N> row(s, m, n, centre_, unit_);
      Vertex<N> v;
      row.template along<Axis::kColumn>(0, first), first.finish();
      row.template along<Axis::kDiagonal>(j, v), v.store(special);
      row.template along<Axis::kColumn>(size, last), last.finish();
    }
    LimitRow<N> row(s, m, n, centre_, unit_);
    if (!border) row.give(j, diagonal);
    scatter_row<N>(row, size, first, last, to, depth_ >= 5);
    target_.done(j);
  }

  const Scalar* corner_limit(int corner) const {
    return input_ + (corner * corner_block_size(depth_) + CornerBlock::kLimit) * L;
  }

  Scalar* input_;
  Scalar *border_, *strip_work_, *strips_;
  std::array<Scalar*, kMaxDepth + 1> rows_;  // point 0 of the first row of each level's window
  int depth_;
  BatchPlacement<Scalar> placement_;
  V centre_[3];
  Scalar unit_;
  To target_;
  EdgeStream<N> edge_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
