// SPDX-License-Identifier: MIT
// One row of a level to the two rows of the next that it begins, and to its limit. Included like rules-inl.h.

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
  for (int c = 0; c < 3; ++c) {  // the column left of the pair: only odd columns count there
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

/// One row of a level to its limit. The points gather in a block of registers or first-level cache until it
/// pays to scatter them to the lanes' own memory.
template <class N>
class LimitRow {
 public:
  using Scalar = typename N::Scalar;
  using V = typename N::V;
  static constexpr int L = N::lanes;

  HWY_ATTR LimitRow(const Scalar* s, const Scalar* m, const Scalar* n, const Placement<Scalar>& placement,
                    Scalar* out, std::ptrdiff_t lane_stride)
      : s_(s), m_(m), n_(n), out_(out), lane_stride_(lane_stride), unit_(placement.unit) {
    for (int c = 0; c < 3; ++c) centre_[c] = placement.centre[c];
  }

  /// Row 0 or `size`: its ends are corners of the pair, whose limits the control vertices have.
  HWY_ATTR void outer(int size, const Scalar* first, const Scalar* last) {
    corner(first);
    for (int i = 1; i < size; ++i) point<Axis::kRow>(i);
    corner(last);
    N::scatter(block_, 6 * filled_, out_, lane_stride_);
  }

  /// Row 0 < j < size: its ends lie on control edges, its point j on the diagonal.
  HWY_ATTR void inner(int size, int j) {
    point<Axis::kColumn>(0);
    for (int i = 1; i < j; ++i) point<Axis::kRow>(i);
    point<Axis::kDiagonal>(j);
    for (int i = j + 1; i < size; ++i) point<Axis::kRow>(i);
    point<Axis::kColumn>(size);
    N::scatter(block_, 6 * filled_, out_, lane_stride_);
  }

 private:
  template <Axis axis>
  HWY_ATTR HWY_INLINE void point(int i) {
    V slant[3], across[3], normal[3];
    Scalar* to = block_ + 6 * filled_ * L;
    for (int c = 0; c < 3; ++c) {
      const int k = (3 * i + c) * L;
      const Limit<V> limit = limit_rule<N>(N::load(m_ + k), hexagon<N, axis>(s_ + k, m_ + k, n_ + k));
      N::store(N::fma(limit.position, N::splat(unit_), N::splat(centre_[c])), to + c * L);
      slant[c] = limit.slant;
      across[c] = limit.across;
    }
    normal_direction<N>(slant, across, normal);
    normalise<N>(normal[0], normal[1], normal[2]);
    for (int c = 0; c < 3; ++c) N::store(normal[c], to + (3 + c) * L);
    keep();
  }

  HWY_ATTR HWY_INLINE void corner(const Scalar* limit) {
    for (int k = 0; k < 6; ++k) N::store(N::load(limit + k * L), block_ + (6 * filled_ + k) * L);
    keep();
  }

  HWY_ATTR HWY_INLINE void keep() {
    if (++filled_ < N::kBlock) return;
    N::scatter(block_, 6 * N::kBlock, out_, lane_stride_);
    out_ += 6 * N::kBlock;
    filled_ = 0;
  }

  alignas(64) Scalar block_[6 * N::kBlock * L];
  int filled_ = 0;
  const Scalar *s_, *m_, *n_;
  Scalar* out_;
  std::ptrdiff_t lane_stride_;
  Scalar centre_[3], unit_;
};
