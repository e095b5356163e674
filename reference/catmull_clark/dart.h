// SPDX-License-Identifier: MIT
// The masks of a dart: a vertex of n faces where one sharp edge ends. It moves by the smooth rule, but its
// neighbour e_0 along the sharp edge by the midpoint, so that its limit and tangents are not the smooth ones.
//
// The mesh is cut along the edge: the ring is a sector of n faces whose ends e_0 and e_n are the same points.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "reference/catmull_clark/masks.h"
#include "reference/number/left_eigenvector.h"

namespace limitcheck::reference::catmull_clark {

/// One step of the ring c, e_0 .. e_{n-1}, f_0 .. f_{n-1}.
template <class N>
SquareMatrix<N> dart_matrix(int n) {
  const auto count = static_cast<std::size_t>(n);
  SquareMatrix<N> a(2 * count + 1, std::vector<N>(2 * count + 1, N(0)));
  const auto e = [&](std::size_t i) { return 1 + i % count; };
  const auto f = [&](std::size_t i) { return 1 + count + i % count; };
  a[0][0] = N(1) - N(7) / N(4 * n);
  for (std::size_t i = 0; i < count; ++i) {
    a[0][e(i)] = N(3) / (N(2) * N(n) * N(n));
    a[0][f(i)] = N(1) / (N(4) * N(n) * N(n));
    a[f(i)][0] = a[f(i)][e(i)] = a[f(i)][e(i + 1)] = a[f(i)][f(i)] = N(1) / N(4);
    if (i == 0) {
      a[e(i)][0] = a[e(i)][e(i)] = N(1) / N(2);
      continue;
    }
    a[e(i)][0] = a[e(i)][e(i)] = N(3) / N(8);
    for (const std::size_t near : {e(i + 1), e(i + count - 1), f(i), f(i + count - 1)})
      a[e(i)][near] += N(1) / N(16);
  }
  return a;
}

/// Weights of e_0 .. e_{n-1}, f_0 .. f_{n-1}; c has what is missing to 1, or to 0 in a tangent.
template <class N>
struct RingWeights {
  std::vector<N> e, f;
};

/// The limit: the left null vector of the matrix less one. Rational.
template <class N>
RingWeights<N> make_dart_limit(int n) {
  const std::vector<N> row = stationary_row(dart_matrix<N>(n));
  return {{row.begin() + 1, row.begin() + 1 + n}, {row.begin() + 1 + n, row.end()}};
}

/// The tangent along the sharp edge, the same on either side of it; towards e_0. Its eigenvalue has no closed
/// form. On a regular star of radius 1 the weights of the e_i give 2 n, as those of interior_tangents.
template <class N>
RingWeights<N> make_dart_tangent(int n) {
  const auto count = static_cast<std::size_t>(n);
  // Points that mirror each other have equal weights: e_0; e_1, e_{n-1}; ..; f_0, f_{n-1}; ..
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0; 2 * i <= count; ++i) pairs.push_back({1 + i, 1 + (count - i) % count});
  for (std::size_t i = 0; 2 * i < count; ++i) pairs.push_back({1 + count + i, 2 * count - i});
  const std::vector<N> row = mirrored_left_eigenvector(dart_matrix<N>(n), pairs);
  RingWeights<N> result{{row.begin(), row.begin() + n}, {row.begin() + n, row.end()}};
  const CircleTable<N>& table = circle_table<N>(n);
  N size(0);
  for (std::size_t i = 0; i < count; ++i) size += result.e[i] * table.cosine[2 * i];
  const N share = N(2 * n) / size;
  for (auto* weights : {&result.e, &result.f})
    for (N& w : *weights) w *= share;
  return result;
}

/// The two, kept by thread and valence.
template <class N>
const RingWeights<N>& dart_limit_weights(int n) {
  return kept_by_valence<N, RingWeights<N>, 0>(n, make_dart_limit<N>);
}
template <class N>
const RingWeights<N>& dart_tangent_weights(int n) {
  return kept_by_valence<N, RingWeights<N>, 1>(n, make_dart_tangent<N>);
}

/// sum of weights (e_i - c), (f_i - c).
template <class N>
Vec3<N> weighted(const RingWeights<N>& weights, const Vec3<N>& c, std::span<const Vec3<N>> edges,
                 std::span<const Vec3<N>> faces) {
  Vec3<N> sum{};
  for (std::size_t i = 0; i < weights.e.size(); ++i) sum += (edges[i] - c) * weights.e[i];
  for (std::size_t i = 0; i < weights.f.size(); ++i) sum += (faces[i] - c) * weights.f[i];
  return sum;
}

/// Along the sharp edge, and S of interior_tangents across it, which gives the edge itself no weight.
///   edges, faces   those of the sector, e_0 .. e_n and f_0 .. f_{n-1}
template <class N>
Tangents<N> dart_tangents(const Vec3<N>& c, std::span<const Vec3<N>> edges, std::span<const Vec3<N>> faces) {
  Tangents<N> t = interior_tangents<N>(c, edges.first(faces.size()), faces);
  t.first = {};
  t.first_terms = N(0);
  const RingWeights<N>& along = dart_tangent_weights<N>(static_cast<int>(faces.size()));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    add_difference(t.first, t.first_terms, along.e[i], edges[i], c);
    add_difference(t.first, t.first_terms, along.f[i], faces[i], c);
  }
  return t;
}

}  // namespace limitcheck::reference::catmull_clark
