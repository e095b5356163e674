// SPDX-License-Identifier: MIT
// A side of a quad, from three rows along it: its points alone, at any depth.

#if defined(LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#endif

#include <cstddef>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/quad_rows-inl.h"
#include "fast/stream/kernel/quad_rules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

/// What makes limit points of the last level's points next to one side of the quads of a batch.
template <class N>
class QuadSideLimit {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// curve: of the side, if it is a polynomial in some lane; centre: where the points' origin is in the
  /// caller's coordinates. Both are kept by pointer.
  HWY_ATTR QuadSideLimit(const QuadBatch<Scalar>& batch, int side, const KernelPlacement<Scalar>& placement,
                         const Scalar* curve, const V* centre)
      : sharp_(mask(batch, quad_sharp_offset(batch.depth), batch.sharp, side)),
        polynomial_(mask(batch, quad_polynomial_offset(batch.depth), batch.some_polynomial, side)),
        all_polynomial_(batch.all_polynomial >> side & 1),
        depth_(batch.depth),
        curve_(curve),
        centre_(centre),
        unit_(quad_unit(placement.unit, batch.depth)),
        curve_unit_(quad_unit(placement.unit, 0)) {}

  /// 1 in the lanes in which the side is sharp; null: in none.
  const Scalar* sharp() const { return sharp_; }
  bool all_polynomial() const { return all_polynomial_; }
  /// Whether its points are as those of any other row.
  bool plain() const { return sharp_ == nullptr && polynomial_ == nullptr; }
  Scalar unit() const { return unit_; }

  /// Point k counted from the side's beginning; at: its 3 x 3 neighbours, and inner the row of the inside, as
  /// for side_limit. Normal of length 1.
  HWY_ATTR HWY_INLINE void point(int k, const Scalar* const (&at)[3][3], int inner, Vertex<N>& out) const {
    if (all_polynomial_) {
      curve_point<N>(curve_, k, depth_, N::splat(curve_unit_), out);
    } else {
      side_limit<N>(at, sharp_, inner, centre_, N::splat(unit_), out);
      if (polynomial_ != nullptr) {
        const V polynomial = N::load(polynomial_);
        Vertex<N> other;
        curve_point<N>(curve_, k, depth_, N::splat(curve_unit_), other);
        for (int c = 0; c < 3; ++c) {
          out.position[c] = N::select(polynomial, other.position[c], out.position[c]);
          out.normal[c] = N::select(polynomial, other.normal[c], out.normal[c]);
        }
      }
    }
    out.finish();
  }

 private:
  static const Scalar* mask(const QuadBatch<Scalar>& batch, int offset, unsigned sides, int side) {
    return sides >> side & 1 ? batch.input + (offset + side) * L : nullptr;
  }

  const Scalar *sharp_, *polynomial_;
  bool all_polynomial_;
  int depth_;
  const Scalar* curve_;
  const V* centre_;
  Scalar unit_, curve_unit_;
};

/// The points of a side from those of all levels next to it: the rows next to a side need nothing but
/// themselves and the rings of its two ends. From a depth on they are seen from an origin near the side, the
/// same from either end. The same operations give the same bits as a quad that has the side for a row or
/// column. [claim D14]
template <class N>
class QuadSideStream {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  /// work: quad_side_work_size(depth) * lanes. The batch's corners are left alone if the side has an origin
  /// of its own, and only then.
  HWY_ATTR QuadSideStream(const QuadBatch<Scalar>& batch, int side, const KernelPlacement<Scalar>& placement,
                          const Scalar* curve, Scalar* work)
      : p_(batch, side),
        q_(batch, (side + 1) % 4),
        depth_(batch.depth),
        rows_(work + 2 * quad_block_size(batch.depth) * L),
        limit_(batch, side, placement, curve, centre_) {
    V origin[3] = {N::splat(0), N::splat(0), N::splat(0)};
    if (placement.has_local_origin(depth_)) {
      choose_middle<N>(p_.centre(), q_.centre(), origin);
      if (!limit_.all_polynomial())
        p_.move(origin, work), q_.move(origin, work + quad_block_size(depth_) * L);
    }
    for (int c = 0; c < 3; ++c)
      centre_[c] = N::fma(origin[c], N::splat(placement.unit), N::splat(placement.centre[c]));
    if (!limit_.all_polynomial()) refine();
  }
  QuadSideStream(const QuadSideStream&) = delete;
  QuadSideStream& operator=(const QuadSideStream&) = delete;

  /// Points 0 .. 2^depth, six vectors each, to out,
  HWY_ATTR void store(Scalar* out) const {
    const int size = 1 << depth_;
    Vertex<N> v;
    v.load(p_.limit()), v.store(out);
    v.load(q_.limit()), v.store(out + 6 * size * L);
    if (limit_.plain()) {
      QuadLimitRow<N> points(row(depth_, -1), row(depth_, 0), row(depth_, 1), 1, centre_, limit_.unit());
      store_row<N>(points, size, out);
    } else {
      for (int k = 1; k < size; ++k) point(k, v), v.store(out + 6 * k * L);
    }
  }
  /// or as a row.
  template <class Row>
  HWY_ATTR void scatter(const Row& to) const {
    const int size = 1 << depth_;
    Vertex<N> a, b;
    a.load(p_.limit()), b.load(q_.limit());
    if (size == 1) return to.couple(0, a, b);
    if (limit_.plain()) {
      QuadLimitRow<N> points(row(depth_, -1), row(depth_, 0), row(depth_, 1), 1, centre_, limit_.unit());
      return scatter_row<N>(points, size, a, b, to);
    }
    const Vertex<N> last = b;
    for (int k = 0; k < size; k += 2) {
      if (k > 0) point(k, a);
      point(k + 1, b);
      to.couple(k, a, b);
    }
    to.vertex(size, last);
  }

 private:
  Scalar* row(int level, int j) const {
    return rows_ + ((level % 2 * 3 + j + 1) * quad_row_size(depth_) + 3) * L;
  }

  HWY_ATTR void refine() {
    for (int level = 1; level <= depth_; ++level) {
      if (level > 1) {
        const Scalar *s = row(level - 1, -1), *m = row(level - 1, 0), *n = row(level - 1, 1);
        const int size = 1 << (level - 1);
        refine_odd_quads<N>(s, m, size, row(level, -1));
        refine_even_quads<N>(s, m, n, size, limit_.sharp(), row(level, 0));
        refine_odd_quads<N>(m, n, size, row(level, 1));
      }
      p_.refine(level - 1), q_.refine(level - 1);
      take_ends(level);
    }
  }

  // What the rings of the ends own: all within two points of them.
  HWY_ATTR void take_ends(int level) {
    const int size = 1 << level;
    Scalar *s = row(level, -1), *m = row(level, 0), *n = row(level, 1);
    const auto copy = [&](const Scalar* from, Scalar* to_row, int i) HWY_ATTR {
      for (int c = 0; c < 3; ++c) N::store(N::load(from + c * L), to_row + (3 * i + c) * L);
    };
    const auto p = [&](RingPoint at, Scalar* to_row, int i) HWY_ATTR { copy(p_.point(at), to_row, i); };
    const auto q = [&](RingPoint at, Scalar* to_row, int i) HWY_ATTR { copy(q_.point(at), to_row, i); };
    p(kEBefore, s, 0), p(kFBefore, s, 1);
    p(kEBeyond, m, -1), p(kHub, m, 0), p(kE, m, 1);
    p(kFAfter, n, -1), p(kEAfter, n, 0), p(kF, n, 1);
    q(kFAfter, s, size - 1), q(kEBeyond, s, size);
    q(kEAfter, m, size - 1), q(kHub, m, size), q(kEBefore, m, size + 1);
    q(kF, n, size - 1), q(kE, n, size), q(kFBefore, n, size + 1);
  }

  HWY_ATTR HWY_INLINE void point(int k, Vertex<N>& out) const {
    const Scalar *s = row(depth_, -1), *m = row(depth_, 0), *n = row(depth_, 1);
    const int i = 3 * k * L, step = 3 * L;
    const Scalar* const at[3][3] = {{s + i - step, s + i, s + i + step},
                                    {m + i - step, m + i, m + i + step},
                                    {n + i - step, n + i, n + i + step}};
    limit_.point(k, at, 2, out);
  }

  QuadCorner<N> p_, q_;
  int depth_;
  Scalar* rows_;  // two levels in turn
  V centre_[3];
  QuadSideLimit<N> limit_;
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
