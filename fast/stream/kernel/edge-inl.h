// SPDX-License-Identifier: MIT
// A strip of three rows along a control edge: the points of the edge alone, at any depth.

#if defined(LIMITCHECK_FAST_STREAM_EDGE_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_EDGE_INL_H_
#undef LIMITCHECK_FAST_STREAM_EDGE_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_EDGE_INL_H_
#endif

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
    if (placement_.has_local_origin(depth_)) choose_origin<N>(p, q, origin);
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

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
