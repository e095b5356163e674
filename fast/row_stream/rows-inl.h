// SPDX-License-Identifier: MIT
// One row of a level to the two rows of the next that it begins, and to its limit. Included like rules-inl.h.

/// An origin near an edge, the same from either end, with few enough digits that moving there and back costs
/// none. Numbers without rounding have no digits to save.
template <class N, class V>
HWY_ATTR HWY_INLINE void choose_origin(const typename N::Scalar* p, const typename N::Scalar* q, V* origin) {
  const V magic = N::splat(0x1.8p11);  // a float of that size ends at 2^-12, a double at 2^-41
  for (int c = 0; c < 3; ++c) {
    const int k = (CornerBlock::kCentre + c) * N::lanes;
    origin[c] = (N::splat(.5) * (N::load(p + k) + N::load(q + k)) + magic) - magic;
  }
}

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

  /// centre: of each lane in the caller's coordinates; unit: from the scaled placement.
  HWY_ATTR LimitRow(const Scalar* s, const Scalar* m, const Scalar* n, const V* centre, Scalar unit,
                    Scalar* out, std::ptrdiff_t lane_stride)
      : s_(s), m_(m), n_(n), out_(out), lane_stride_(lane_stride), unit_(unit) {
    for (int c = 0; c < 3; ++c) centre_[c] = centre[c];
  }

  /// Row 0 or `size`: its ends are corners of the pair, whose limits the control vertices have.
  HWY_ATTR void outer(int size, const Scalar* first, const Scalar* last) {
    given(first);
    for (int i = 1; i < size; ++i) point<Axis::kRow>(i);
    given(last);
    finish();
  }
  /// The same where a strip has evaluated the row.
  HWY_ATTR void outer(int size, const Scalar* points) {
    for (int i = 0; i <= size; ++i) given(points + 6 * i * L);
    finish();
  }

  /// Row 0 < j < size: its ends lie on control edges, its point j on the diagonal.
  HWY_ATTR void inner(int size, int j) {
    point<Axis::kColumn>(0);
    for (int i = 1; i < j; ++i) point<Axis::kRow>(i);
    point<Axis::kDiagonal>(j);
    for (int i = j + 1; i < size; ++i) point<Axis::kRow>(i);
    point<Axis::kColumn>(size);
    finish();
  }
  /// The same where strips have evaluated those three.
  HWY_ATTR void inner(int size, int j, const Scalar* first, const Scalar* diagonal, const Scalar* last) {
    given(first);
    for (int i = 1; i < j; ++i) point<Axis::kRow>(i);
    given(diagonal);
    for (int i = j + 1; i < size; ++i) point<Axis::kRow>(i);
    given(last);
    finish();
  }

 private:
  template <Axis axis>
  HWY_ATTR HWY_INLINE void point(int i) {
    V slant[3], across[3], normal[3];
    Scalar* to = block_ + 6 * filled_ * L;
    for (int c = 0; c < 3; ++c) {
      const int k = (3 * i + c) * L;
      const Limit<V> limit = limit_rule<N>(N::load(m_ + k), hexagon<N, axis>(s_ + k, m_ + k, n_ + k));
      N::store(N::fma(limit.position, N::splat(unit_), centre_[c]), to + c * L);
      slant[c] = limit.slant;
      across[c] = limit.across;
    }
    normal_of<N>(slant, across, normal);
    for (int c = 0; c < 3; ++c) N::store(normal[c], to + (3 + c) * L);
    keep();
  }

  HWY_ATTR HWY_INLINE void given(const Scalar* point) {
    for (int k = 0; k < 6; ++k) N::store(N::load(point + k * L), block_ + (6 * filled_ + k) * L);
    keep();
  }

  HWY_ATTR HWY_INLINE void keep() {
    if (++filled_ < N::kBlock) return;
    N::scatter(block_, 6 * N::kBlock, out_, lane_stride_);
    out_ += 6 * N::kBlock;
    filled_ = 0;
  }

  HWY_ATTR void finish() { N::scatter(block_, 6 * filled_, out_, lane_stride_); }

  alignas(64) Scalar block_[6 * N::kBlock * L];
  int filled_ = 0;
  const Scalar *s_, *m_, *n_;
  Scalar* out_;
  std::ptrdiff_t lane_stride_;
  V centre_[3];
  Scalar unit_;
};
