// SPDX-License-Identifier: MIT
// Loop's masks: subdivision, limit position and tangents, at interior and boundary vertices. The weights of
// an interior vertex come in two families, Loop's and Warren's; everything else is common to both.
//
// All are written as a point plus weighted differences, so that coincident points stay coincident in floating
// point and a far-away origin does no harm.
//
// Rings are counter-clockwise seen from outside: v_1..v_n of an interior vertex (here ring[0]..ring[n-1]),
// r_0..r_K of a boundary vertex with K faces, r_0 and r_K on the boundary. Weights are generic in the number
// type; only a(n) for n other than 3, 4, 6 and the sines are irrational.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "reference/number/number.h"
#include "reference/number/vec3.h"
#include "reference/point/boundary_curve.h"
#include "reference/point/normal.h"

namespace limitcheck::reference {

/// The two families of weights that an interior vertex can have. They give the same surface where all interior valences are 3 or 6, and different ones elsewhere. Edges and
/// boundaries have the same rules in both.
enum class Weights : std::uint8_t {
  kLoop,   ///< Loop 1987: the ring has the weight a(n) = 5/8 - (3 + 2 cos(2 pi / n))^2 / 64 together
  kWarren  ///< Warren's simplification: 3/8, and 9/16 at n = 3. libigl, geometry-central and Open3D have it.
};

/// a(n) = 5/8 - (3 + 2 cos(2 pi / n))^2 / 64, n >= 3; exact where the cosine is rational.  [section 3.1; C11]
template <class N>
N loop_a(int n) {
  if (n == 6) return N(3) / N(8);  // by far the most frequent
  const N s = N(3) + N(2) * NumberTraits<N>::cos_pi(2, n);
  return N(5) / N(8) - s * s / N(64);
}

/// The weight of all neighbours of an interior vertex together, n >= 3: a(n), or Warren's 3/8 and 9/16.
template <class N>
N ring_weight(int n, Weights weights) {
  if (weights == Weights::kLoop) return loop_a<N>(n);
  return n == 3 ? N(9) / N(16) : N(3) / N(8);
}

/// Interior vertex after one step: (1 - a) v + (a / n) sum v_i, with a = ring_weight(n).   [equation 1; C10]
///
///         a/n
///    a/n   |  a/n
///       \  | /
///        1-a
///       /  | \       .
///    a/n   |  a/n
///         a/n
///   valence   n, if the ring is no more than points with the same mean
template <class N>
Vec3<N> interior_vertex_point(const Vec3<N>& v, std::span<const Vec3<N>> ring,
                              Weights weights = Weights::kLoop, int valence = 0) {
  const auto n = static_cast<int>(ring.size());
  Vec3<N> sum = ring[0] - v;
  for (std::size_t i = 1; i < ring.size(); ++i) sum += ring[i] - v;
  return v + sum * (ring_weight<N>(valence > 0 ? valence : n, weights) / N(n));
}

/// Interior edge a-b with opposite vertices c, d: 3/8 (a + b) + 1/8 (c + d).   [equation 2; C12]
///
///        1/8
///       /   \        .
///    3/8 --- 3/8
///       \   /
///        1/8
template <class N>
Vec3<N> interior_edge_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
  return (a + b) * (N(1) / N(2)) + ((c - a) + (d - b)) * (N(1) / N(8));
}

/// Linear ghost over the boundary edge a-b of face (a, b, c): makes the face an ordinary patch. [D10]
template <class N>
Vec3<N> ghost_point(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c) {
  return a + b - c;
}

/// Limit of an interior vertex: (3 v + (8a / n) sum v_i) / (3 + 8a), with a = ring_weight(n); the weights are
/// in the ratio (3n / 8a) : 1 : .. : 1.   [equation 3; C14]
template <class N>
Vec3<N> interior_limit(const Vec3<N>& v, std::span<const Vec3<N>> ring, Weights weights = Weights::kLoop) {
  const auto n = static_cast<int>(ring.size());
  Vec3<N> sum = ring[0] - v;
  for (std::size_t i = 1; i < ring.size(); ++i) sum += ring[i] - v;
  const N a8 = N(8) * ring_weight<N>(n, weights);
  return v + sum * (a8 / (N(n) * (N(3) + a8)));
}

/// C = sum cos(2 pi i / n) v_i and S = sum sin(2 pi i / n) v_i, i = 0..n-1 along `ring`, taken from v_i - v.
/// The paper's (4), (5) divide by sums that are zero: errata 1. The known answers start the ring at i = 1;
/// that
/// turns (C, S) within the plane and leaves C x S alone.   [C16, C17, D12]
template <class N>
Tangents<N> interior_tangents(const Vec3<N>& v, std::span<const Vec3<N>> ring) {
  const CircleTable<N>& table = circle_table<N>(static_cast<long>(ring.size()));
  Tangents<N> t{};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    add_difference(t.first, t.first_terms, table.cosine[2 * i], ring[i], v);
    add_difference(t.second, t.second_terms, table.sine[2 * i], ring[i], v);
  }
  return t;
}

/// Along the boundary r_0 - r_K, and across it into the surface.   [D1, D2, D5]
/// Across weights with theta = pi / K, c = cos theta, s = sin theta (the left eigenvector of 3/8 + c/4):
///
///        sin theta   sin 2 theta            K = 1: centre -2, ends 1, 1
///             \       /                     K = 2: centre -1, ends 0, inner 1
///              \     /                      K = 3: centre -2, ends -1, inner 2 (times sqrt(3)/4)
///      l0 ---- centre ---- l0               l0 = -c (1 + c) / ((1 + 2c) s), centre = (2c - 1) l0 - s
///
/// The mask in wide use for K >= 4 (ends s/(2c - 2), centre 0) belongs to another boundary rule: trap D4.
/// For K >= 6 the surface has no tangent plane there (a second eigenvalue reaches 1/2).
template <class N>
Tangents<N> boundary_tangents(const Vec3<N>& v, std::span<const Vec3<N>> ring) {
  const auto faces = static_cast<long>(ring.size()) - 1;
  Tangents<N> t{};
  add_difference(t.first, t.first_terms, N(1), ring.front(), ring.back());
  const auto across = [&](const Vec3<N>& r, const N& weight) {
    add_difference(t.second, t.second_terms, weight, r, v);
  };
  if (faces == 1) {
    across(ring.front(), N(1));
    across(ring.back(), N(1));
    return t;
  }
  // The weights sum to zero, so the centre's is implied by taking differences from it.
  const CircleTable<N>& table = circle_table<N>(faces);
  const N c = table.cosine[1], s = table.sine[1];
  const N end = N(0) - c * (N(1) + c) / ((N(1) + N(2) * c) * s);
  across(ring.front(), end);
  across(ring.back(), end);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) across(ring[i], table.sine[i]);
  return t;
}

}  // namespace limitcheck::reference
