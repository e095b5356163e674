// SPDX-License-Identifier: MIT
// One row of a level to the two rows of the next that it begins, and to its limit. Included like rules-inl.h.

/// Rows s, m, n are rows j-1, j, j+1, each pointing at point 0. Writes the four children that point i of row
/// m begins: (2i, 2j), (2i+1, 2j), (2i, 2j+1), (2i+1, 2j+1).
template <class N, Axis axis>
HWY_ATTR inline void refine_point(const typename N::Scalar* s, const typename N::Scalar* m,
                                  const typename N::Scalar* n, int i, typename N::Scalar* even,
                                  typename N::Scalar* odd) {
  constexpr int L = N::lanes;
  s += 3 * i * L, m += 3 * i * L, n += 3 * i * L;
  even += 6 * i * L, odd += 6 * i * L;
  for (int c = 0; c < 3; ++c, s += L, m += L, n += L, even += L, odd += L) {
    const auto v = N::load(m), e = N::load(m + 3 * L), w = N::load(m - 3 * L);
    const auto nw = N::load(n), ne = N::load(n + 3 * L), se = N::load(s);
    N::store(vertex_rule<N>(v, ring_sum(hexagon<N, axis>(s, m, n))), even);
    N::store(edge_rule<N>(v, e, ne, se), even + 3 * L);
    N::store(edge_rule<N>(v, nw, w, ne), odd);
    N::store(edge_rule<N>(v, ne, e, nw), odd + 3 * L);
  }
}

/// Children of odd columns only, of the column left of the pair.
template <class N>
HWY_ATTR inline void refine_flap(const typename N::Scalar* s, const typename N::Scalar* m,
                                 const typename N::Scalar* n, typename N::Scalar* even,
                                 typename N::Scalar* odd) {
  constexpr int L = N::lanes;
  s -= 3 * L, m -= 3 * L, n -= 3 * L;
  even -= 3 * L, odd -= 3 * L;
  for (int c = 0; c < 3; ++c, s += L, m += L, n += L, even += L, odd += L) {
    const auto v = N::load(m), e = N::load(m + 3 * L), nw = N::load(n), ne = N::load(n + 3 * L);
    N::store(edge_rule<N>(v, e, ne, N::load(s)), even);
    N::store(edge_rule<N>(v, ne, e, nw), odd);
  }
}

/// Row -1 of the next level, between rows m = -1 and n = 0: edge points only.
template <class N>
HWY_ATTR inline void refine_below(const typename N::Scalar* m, const typename N::Scalar* n, int size,
                                  typename N::Scalar* odd) {
  constexpr int L = N::lanes;
  for (int k = 0; k < 3 * size; ++k) {
    const auto v = N::load(m + k * L), e = N::load(m + (k + 3) * L), w = N::load(m + (k - 3) * L);
    const auto nw = N::load(n + k * L), ne = N::load(n + (k + 3) * L);
    typename N::Scalar* out = odd + (6 * (k / 3) + k % 3) * L;
    N::store(edge_rule<N>(v, nw, w, ne), out);
    N::store(edge_rule<N>(v, ne, e, nw), out + 3 * L);
  }
}

/// Rows 2j and 2j+1 of the next level from rows j-1, j, j+1 of a level of 2^level = size, 0 <= j <= size.
template <class N>
HWY_ATTR void refine_row(const typename N::Scalar* s, const typename N::Scalar* m,
                         const typename N::Scalar* n, int size, int j, typename N::Scalar* even,
                         typename N::Scalar* odd) {
  refine_flap<N>(s, m, n, even, odd);
  if (j == 0 || j == size) {
    for (int i = 0; i <= size; ++i) refine_point<N, Axis::kRow>(s, m, n, i, even, odd);
    return;
  }
  refine_point<N, Axis::kColumn>(s, m, n, 0, even, odd);
  for (int i = 1; i < j; ++i) refine_point<N, Axis::kRow>(s, m, n, i, even, odd);
  refine_point<N, Axis::kDiagonal>(s, m, n, j, even, odd);
  for (int i = j + 1; i < size; ++i) refine_point<N, Axis::kRow>(s, m, n, i, even, odd);
  refine_point<N, Axis::kColumn>(s, m, n, size, even, odd);
}

/// Limit position and unit normal of point i of row m, to out: six times `lanes` numbers.
template <class N, Axis axis>
HWY_ATTR inline void limit_point(const typename N::Scalar* s, const typename N::Scalar* m,
                                 const typename N::Scalar* n, int i,
                                 const Placement<typename N::Scalar>& placement, typename N::Scalar* out) {
  using V = typename N::V;
  constexpr int L = N::lanes;
  V along[3], across[3], normal[3];
  for (int c = 0; c < 3; ++c) {
    const int k = (3 * i + c) * L;
    const Limit<V> limit = limit_rule<N>(N::load(m + k), hexagon<N, axis>(s + k, m + k, n + k));
    N::store(N::fma(limit.position, N::splat(placement.unit), N::splat(placement.centre[c])),
             out + (6 * i + c) * L);
    along[c] = limit.along;
    across[c] = limit.across;
  }
  unit_normal<N>(along, across, normal);
  for (int c = 0; c < 3; ++c) N::store(normal[c], out + (6 * i + 3 + c) * L);
}

/// All points of row j; at the corners of the pair what is written has no meaning.
template <class N>
HWY_ATTR void limit_row(const typename N::Scalar* s, const typename N::Scalar* m, const typename N::Scalar* n,
                        int size, int j, const Placement<typename N::Scalar>& placement,
                        typename N::Scalar* out) {
  if (j == 0 || j == size) {
    for (int i = 0; i <= size; ++i) limit_point<N, Axis::kRow>(s, m, n, i, placement, out);
    return;
  }
  limit_point<N, Axis::kColumn>(s, m, n, 0, placement, out);
  for (int i = 1; i < j; ++i) limit_point<N, Axis::kRow>(s, m, n, i, placement, out);
  limit_point<N, Axis::kDiagonal>(s, m, n, j, placement, out);
  for (int i = j + 1; i < size; ++i) limit_point<N, Axis::kRow>(s, m, n, i, placement, out);
  limit_point<N, Axis::kColumn>(s, m, n, size, placement, out);
}
