// SPDX-License-Identifier: MIT
// The engine of a batch: rows trickle down the levels, each point of each level is computed once; and a strip of
// three rows along a control edge, for the points of the edge alone.

#if defined(LIMITCHECK_FAST_STREAM_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#undef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#endif

#include <array>
#include <cstddef>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/rows-inl.h"
#include "fast/stream/kernel/rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

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
  HWY_ATTR EdgeStream(int depth, const KernelPlacement<Scalar>& placement, Scalar* work)
      : depth_(depth), placement_(placement), unit_(scaled(placement, depth).unit) {
    for (int end = 0; end < 2; ++end) block_[end] = work + end * edge_block_size(depth) * L;
    work += edge_input_size(depth) * L;
    const int length = 3 * ((1 << depth) + 2) * L;
    for (int k = 0; k < 2; ++k) {
      line_[k] = work + 3 * k * length + 3 * L;
      up_[k] = line_[k] + length;
      down_[k] = up_[k] + length;
    }
  }

  /// p, q: corner blocks of the ends; p_first, q_first: where in their windows those of the edge begin. The
  /// blocks are left alone.
  HWY_ATTR void refine(const Scalar* p, int p_first, const Scalar* q, int q_first) {
    V origin[3] = {N::splat(0), N::splat(0), N::splat(0)};
    if (placement_.has_local_origin(depth_))
      choose_middle<N>(p + CornerBlock::kCentre * L, q + CornerBlock::kCentre * L, origin);
    for (int c = 0; c < 3; ++c)
      centre_[c] = N::fma(origin[c], N::splat(placement_.unit), N::splat(placement_.centre[c]));
    take_block<N>(p, p_first, edge_window_width(depth_), origin, placement_.has_local_origin(depth_),
                  block_[0]);
    take_block<N>(q, q_first, edge_window_width(depth_), origin, placement_.has_local_origin(depth_),
                  block_[1]);

    take_ends(0);
    if (placement_.has_local_origin(depth_)) reconcile();
    for (int level = 0; level < depth_; ++level) refine_level(level);
  }

  /// Then position and normal of points 0 .. 2^depth: to out[6 k .. 6 k + 5], `lanes` numbers each,
  HWY_ATTR void store(Scalar* out) const {
    const int size = 1 << depth_;
    for (int k = 0; k < 6 * L; k += L) {
      N::store(N::load(end_limit(0) + k), out + k);
      N::store(N::load(end_limit(1) + k), out + 6 * size * L + k);
    }
    row(LaneRow<N>{nullptr, 0}).store(1, size, out);
  }
  /// or as a row.
  template <class Row>
  HWY_ATTR void scatter(const Row& to) const {
    row(to).run(1 << depth_, end_limit(0), 0, nullptr, end_limit(1));
  }

 private:
  const Scalar* end_limit(int end) const { return block_[end] + CornerBlock::kLimit * L; }

  // Seen as rows of a grid: up begins half an edge further right there.
  template <class Row>
  HWY_ATTR LimitRow<N, Row> row(const Row& to) const {
    const int k = depth_ % 2;
    return LimitRow<N, Row>(down_[k], line_[k], up_[k] - 3 * L, centre_, unit_, to);
  }

  // Window of an end at a level: three entries, the middle one along the edge, and more on either side.
  Scalar* window(int end, int entry) { return block_[end] + (CornerBlock::kWindow + 3 * entry) * L; }

  HWY_ATTR static void copy(const Scalar* from, Scalar* to) {
    for (int c = 0; c < 3; ++c) N::store(N::load(from + c * L), to + c * L);
  }

  // What the rings of the ends give a level: the ends, and the points next to them across the edge. At P the
  // left neighbour comes after the edge, at Q before it.
  HWY_ATTR void take_ends(int level) {
    const int size = 1 << level, middle = depth_ - level + 1, k = level % 2;
    copy(block_[0] + CornerBlock::kCentre * L, line_[k]);
    copy(block_[1] + CornerBlock::kCentre * L, line_[k] + 3 * size * L);
    copy(window(1, middle - 1), up_[k] + 3 * (size - 1) * L);
    copy(window(1, middle + 1), down_[k] + 3 * (size - 1) * L);
    copy(window(0, middle + 1), up_[k]);
    copy(window(0, middle - 1), down_[k]);
  }

  // With an origin of their own the two ends know their common neighbours to a last bit each; both faces take
  // the mean.
  HWY_ATTR void reconcile() {
    for (int c = 0; c < 3; ++c) {
      const V up = N::load(window(0, depth_ + 2) + c * L) + N::load(window(1, depth_) + c * L);
      const V down = N::load(window(0, depth_) + c * L) + N::load(window(1, depth_ + 2) + c * L);
      N::store(N::splat(.5) * up, up_[0] + c * L);
      N::store(N::splat(.5) * down, down_[0] + c * L);
    }
  }

  HWY_ATTR void refine_level(int level) {
    const int size = 1 << level, from = level % 2, to = 1 - from;
    for (int i = 0; i < size; ++i) {
      for (int c = 0; c < 3; ++c) {
        const int k = (3 * i + c) * L, child = (6 * i + c) * L, step = 3 * L;
        const V v = N::load(line_[from] + k), e = N::load(line_[from] + k + step);
        const V up = N::load(up_[from] + k), up_before = N::load(up_[from] + k - step);
        const V down = N::load(down_[from] + k), down_before = N::load(down_[from] + k - step);
        const V w = N::load(line_[from] + k - step);
        N::store(vertex_rule<N>(v, ring_sum(Hexagon<V>{e, up, up_before, w, down_before, down})),
                 line_[to] + child);
        N::store(edge_rule<N>(v, e, up, down), line_[to] + child + step);
        N::store(edge_rule<N>(v, up, e, up_before), up_[to] + child);
        N::store(edge_rule<N>(e, up, v, N::load(up_[from] + k + step)), up_[to] + child + step);
        N::store(edge_rule<N>(v, down, e, down_before), down_[to] + child);
        N::store(edge_rule<N>(e, down, v, N::load(down_[from] + k + step)), down_[to] + child + step);
      }
    }
    for (int end = 0; end < 2; ++end)
      refine_ring<N>(block_[end], window(end, 0), edge_window_width(depth_ - level) - 2);
    take_ends(level + 1);
  }

  int depth_;
  KernelPlacement<Scalar> placement_;
  Scalar unit_;
  V centre_[3];
  Scalar* block_[2];
  Scalar *line_[2], *up_[2], *down_[2];
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

  /// input: input_size(depth) * lanes numbers, windows are overwritten; work: work_size(depth) * lanes.
  /// Both aligned to 64 bytes; work holds finite numbers.
  HWY_ATTR Stream(Scalar* input, int depth, const KernelPlacement<Scalar>& placement, Scalar* work,
                  const To& target)
      : input_(input),
        border_(work + border_offset(depth) * L),
        strip_work_(work),
        strips_(work + strips_offset(depth) * L),
        depth_(depth),
        placement_(placement),
        unit_(scaled(placement, depth).unit),
        target_(target),
        edge_(depth, placement, strip_work_) {
    for (int level = 0; level <= depth; ++level) rows_[level] = work + (rows_offset(level) + 3) * L;
  }

  HWY_ATTR void run() {
    for (int c = 0; c < 3; ++c) centre_[c] = N::splat(placement_.centre[c]);
    if (placement_.has_local_origin(depth_)) move_origin();
    for (int corner = 0; corner < 4; ++corner) refine_corner(corner);
    for (int j = -1; j <= 2; ++j) receive(0, j);
  }

 private:
  enum Edge { kAD, kBC, kAC, kDC, kAB };  // the first four have their points kept

  Scalar* corner_block(int corner) const { return input_ + corner * corner_block_size(depth_) * L; }
  const Scalar* strip(Edge edge, int point) const {
    return strips_ + (edge * edge_output_size(depth_) + 6 * point) * L;
  }

  // A strip along an edge of the grid, from an origin of its own. first: where in a corner's window the
  // edge's begins, among the core entries after the flap.
  HWY_ATTR void refine_edge(Edge edge) {
    struct Ends {
      int p, p_first, q, q_first;
    };
    constexpr Ends ends[] = {{kA, 2, kD, 0}, {kB, 0, kC, 2}, {kA, 1, kC, 1}, {kD, 1, kC, 0}, {kA, 0, kB, 1}};
    const Ends& e = ends[edge];
    edge_.refine(corner_block(e.p), e.p_first, corner_block(e.q), e.q_first);
  }

  // The grid's edges before its inside: A B is row 0, the others are kept until their rows come. Then the
  // grid from an origin on its diagonal.
  HWY_ATTR void move_origin() {
    refine_edge(kAB);
    edge_.scatter(target_.row(0));
    target_.done(0);
    for (const Edge edge : {kAD, kBC, kAC, kDC}) {
      refine_edge(edge);
      edge_.store(strips_ + edge * edge_output_size(depth_) * L);
    }
    V origin[3];
    choose_middle<N>(corner_block(kA) + CornerBlock::kCentre * L, corner_block(kC) + CornerBlock::kCentre * L,
                     origin);
    for (int c = 0; c < 3; ++c) centre_[c] = N::fma(origin[c], N::splat(placement_.unit), centre_[c]);
    for (int corner = 0; corner < 4; ++corner) {
      Scalar* block = corner_block(corner);
      take_block<N>(block, 0, window_width(corner, depth_), origin, true, block);
    }
  }

  // One corner through all levels; what the rows of each level take from it is kept.
  HWY_ATTR void refine_corner(int corner) {
    Scalar* block = corner_block(corner);
    Scalar* window = block + CornerBlock::kWindow * L;
    for (int level = 0;; ++level) {
      const int first = depth_ - level;
      Scalar* kept = border(level, corner);
      for (int c = 0; c < 3 * L; c += L) {
        N::store(N::load(block + CornerBlock::kCentre * L + c), kept + c);
        N::store(N::load(window + 3 * first * L + c), kept + 3 * L + c);
        N::store(N::load(window + 3 * (first + core_width(corner) - 1) * L + c), kept + 6 * L + c);
      }
      if (level == depth_) return;
      refine_ring<N>(block, window, window_width(corner, first) - 2);
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
    const auto to = target_.row(j);
    const LimitRow<N, typename To::Row> row(s, m, n, centre_, unit_, to);
    if (placement_.has_local_origin(depth_)) {
      if (j == 0) return;
      if (j == size) {
        scatter_kept<N>(strip(kDC, 0), size, to);
      } else {
        row.run(size, strip(kAD, j), j, strip(kAC, j), strip(kBC, j));
      }
    } else if (j == 0) {
      row.run(size, corner_limit(kA), 0, nullptr, corner_limit(kB));
    } else if (j == size) {
      row.run(size, corner_limit(kD), size, corner_limit(kC), corner_limit(kC));
    } else {
      alignas(64) Scalar special[3][6 * L];
      row.template special<Axis::kColumn>(0, special[0]);
      row.template special<Axis::kDiagonal>(j, special[1]);
      row.template special<Axis::kColumn>(size, special[2]);
      row.run(size, special[0], j, special[1], special[2]);
    }
    target_.done(j);
  }

  const Scalar* corner_limit(int corner) const {
    return input_ + (corner * corner_block_size(depth_) + CornerBlock::kLimit) * L;
  }

  Scalar* input_;
  Scalar *border_, *strip_work_, *strips_;
  std::array<Scalar*, kMaxDepth + 1> rows_;  // point 0 of the first row of each level's window
  int depth_;
  KernelPlacement<Scalar> placement_;
  V centre_[3];
  Scalar unit_;
  To target_;
  EdgeStream<N> edge_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
