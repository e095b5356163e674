// SPDX-License-Identifier: MIT
// The masks of a dart: a vertex of n faces where one sharp edge ends. It moves by the smooth rule, but its
// neighbour r_0 along the sharp edge by the midpoint, so that its limit and tangents are not the smooth ones.
//
// The mesh is cut along the edge: the ring is r_0 .. r_n, whose ends are the same point.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/loop/masks.h"
#include "reference/number/left_eigenvector.h"

namespace limitcheck::reference {

/// One step of the ring c, r_0 .. r_{n-1}.
template <class N>
SquareMatrix<N> dart_matrix(int n, Weights weights) {
  const auto count = static_cast<std::size_t>(n);
  SquareMatrix<N> a(count + 1, std::vector<N>(count + 1, N(0)));
  const N all = ring_weight<N>(n, weights);
  a[0][0] = N(1) - all;
  for (std::size_t i = 0; i < count; ++i) {
    a[0][1 + i] = all / N(n);
    a[1 + i][0] = a[1 + i][1 + i] = i == 0 ? N(1) / N(2) : N(3) / N(8);
    if (i == 0) continue;
    a[1 + i][i] += N(1) / N(8);
    a[1 + i][1 + (i + 1) % count] += N(1) / N(8);
  }
  return a;
}

/// Weights of r_0 .. r_{n-1} in the limit; the centre has what is missing to 1.
template <class N>
const std::vector<N>& dart_limit_weights(int n, Weights weights) {
  const auto make = [weights](int valence) {
    const std::vector<N> row = stationary_row(dart_matrix<N>(valence, weights));
    return std::vector<N>(row.begin() + 1, row.end());
  };
  return weights == Weights::kLoop ? kept_by_valence<N, std::vector<N>, 2>(n, make)
                                   : kept_by_valence<N, std::vector<N>, 3>(n, make);
}

/// The tangent along the sharp edge, the same on either side of it; towards r_0. Its eigenvalue has no closed
/// form. On a regular star of radius 1 the sum is n / 2, as that of interior_tangents.
template <class N>
const std::vector<N>& dart_tangent_weights(int n, Weights weights) {
  const auto make = [weights](int valence) {
    const auto count = static_cast<std::size_t>(valence);
    std::vector<std::array<std::size_t, 2>> pairs;  // r_0; r_1, r_{n-1}; ..
    for (std::size_t i = 0; 2 * i <= count; ++i) pairs.push_back({1 + i, 1 + (count - i) % count});
    std::vector<N> row = mirrored_left_eigenvector(dart_matrix<N>(valence, weights), pairs);
    const CircleTable<N>& table = circle_table<N>(valence);
    N size(0);
    for (std::size_t i = 0; i < count; ++i) size += row[i] * table.cosine[2 * i];
    const N share = N(valence) / (N(2) * size);
    for (N& w : row) w *= share;
    return row;
  };
  return weights == Weights::kLoop ? kept_by_valence<N, std::vector<N>, 4>(n, make)
                                   : kept_by_valence<N, std::vector<N>, 5>(n, make);
}

/// sum of weights (r_i - v).
template <class N>
Vec3<N> weighted(const std::vector<N>& weights, const Vec3<N>& v, std::span<const Vec3<N>> ring) {
  Vec3<N> sum{};
  for (std::size_t i = 0; i < weights.size(); ++i) sum += (ring[i] - v) * weights[i];
  return sum;
}

/// Along the sharp edge, and S of interior_tangents across it, which gives the edge itself no weight.
///   ring   r_0 .. r_n
template <class N>
Tangents<N> dart_tangents(const Vec3<N>& v, std::span<const Vec3<N>> ring, Weights weights) {
  const std::span<const Vec3<N>> open = ring.first(ring.size() - 1);
  Tangents<N> t = interior_tangents<N>(v, open);
  t.first = {};
  t.first_terms = N(0);
  const std::vector<N>& along = dart_tangent_weights<N>(static_cast<int>(open.size()), weights);
  for (std::size_t i = 0; i < open.size(); ++i) add_difference(t.first, t.first_terms, along[i], open[i], v);
  return t;
}

}  // namespace limitcheck::reference
