// SPDX-License-Identifier: MIT
// The neighbourhood of a corner of a quad, from level to level.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_CORNER_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_CORNER_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_CORNER_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_CORNER_INL_H_
#endif

#include "fast/stream/kernel/quad_layout.h"
#include "fast/stream/kernel/quad_rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// Corner k of the quads of a batch, or a copy of it.
template <class N>
class QuadCorner {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  using Block = QuadCornerBlock;
  static constexpr int L = N::lanes;

  HWY_ATTR QuadCorner(const QuadBatch<Scalar>& batch, int corner)
      : block_(batch.input + corner * quad_block_size(batch.depth) * L),
        dart_(batch.darts >> corner & 1
                  ? batch.input + (quad_dart_offset(batch.depth) + corner * quad_dart_size(batch.depth)) * L
                  : nullptr),
        depth_(batch.depth),
        period_(batch.period[corner]),
        open_(batch.open >> corner & 1) {}

  const Scalar* centre() const { return block_ + Block::kCentre * L; }
  const Scalar* limit() const { return block_ + Block::kLimit * L; }
  /// Entry `core` of the ring, 0 for e- up to 7 for f''.
  const Scalar* ring(int core) const {
    const int t = period_ == 0 ? 2 * depth_ + core : core >= period_ ? core - period_ : core;
    return block_ + (Block::kWindow + 3 * t) * L;
  }
  const Scalar* point(RingPoint p) const { return p == kHub ? centre() : ring(p - 1); }

  /// Seen from an origin, in `to`, where it is from now on; that may be where it was. At level 0 only.
  HWY_ATTR void move(const V* origin, Scalar* to) {
    const int entries = period_ > 0 ? period_ : quad_window_width(depth_);
    if (to != block_) {
      for (int k = 0; k < Block::kWindow; ++k) N::store(N::load(block_ + k * L), to + k * L);
    }
    for (int c = 0; c < 3; ++c) {
      N::store(N::load(centre() + c * L) - origin[c], to + (Block::kCentre + c) * L);
      for (int t = Block::kWindow + c; t < Block::kWindow + 3 * entries; t += 3)
        N::store(N::load(block_ + t * L) - origin[c], to + t * L);
    }
    block_ = to;
  }

  /// From a level to the next.
  HWY_ATTR void refine(int level) {
    // A ring that is there as a whole stays whole.
    const int first = period_ > 0 ? 0 : 2 * level;
    const int end = period_ > 0 ? period_ : quad_window_width(depth_) - 2 * level;
    if (dart_ != nullptr) {
      V before[3];
      for (int c = 0; c < 3; ++c) before[c] = N::load(centre() + c * L);
      refine_ring(first, end);
      const V is_dart = N::load(dart_);
      for (int c = 0; c < 3; ++c) {
        const V moved = N::fma(N::splat(4), before[c], N::load(dart_ + (1 + 3 * level + c) * L));
        N::store(N::select(is_dart, moved, N::load(centre() + c * L)), block_ + (Block::kCentre + c) * L);
      }
    } else {
      refine_ring(first, end);
    }
  }

 private:
  HWY_ATTR HWY_INLINE void refine_ring(int first, int end) {
    if (open_) {
      refine_quad_ring<N, false, true>(block_, first, end);
    } else if (period_ > 0) {
      refine_quad_ring<N, true, false>(block_, first, end);
    } else {
      refine_quad_ring<N, false, false>(block_, first, end);
    }
  }

  Scalar* block_;
  const Scalar* dart_;
  int depth_, period_;
  bool open_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
