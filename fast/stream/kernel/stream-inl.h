// SPDX-License-Identifier: MIT
// The engine of a batch: rows trickle down the levels, each point of each level is computed once.

#if defined(LIMITCHECK_FAST_STREAM_STREAM_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#undef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#endif

#include <array>
#include <cstddef>

#include "fast/stream/kernel/edge-inl.h"
#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/rows-inl.h"
#include "fast/stream/kernel/rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

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
    choose_origin<N>(corner_block(kA), corner_block(kC), origin);
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
