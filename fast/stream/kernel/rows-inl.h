// SPDX-License-Identifier: MIT
// One row of a level to the two rows of the next that it begins, and to its limit.

#if defined(LIMITCHECK_FAST_STREAM_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#undef LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#endif

#include <cstddef>
#include <type_traits>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/rules-inl.h"
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

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per target
