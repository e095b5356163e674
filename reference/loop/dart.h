// SPDX-License-Identifier: MIT
// The masks of a dart: a vertex of n faces where one sharp edge ends. It moves by the smooth rule, but its
// neighbour r_0 along the sharp edge by the midpoint, so that its limit and tangents are not the smooth ones.
//
// The mesh is cut along the edge: the ring is r_0 .. r_n, whose ends are the same point.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "reference/loop/masks.h"
#include "reference/number/dart_rows.h"

namespace limitcheck::reference {

/// Weights of r_0 .. r_{n-1} in the limit; the centre has what is missing to 1. With w of the centre they are
/// w a / n times h_i, and 2 + h_1 / 2 of r_0, where 5 h_i - h_{i-1} - h_{i+1} = 8.
template <class N>
const std::vector<N>& dart_limit_weights(int n, Weights weights) {
  const auto make = [weights](int valence) {
    std::vector<N> row = between_zeros<N>(valence, 5, 8);
    row[0] = N(2) + row[1] / N(2);
    const N share = ring_weight<N>(valence, weights) / N(valence);
    N sum(1);
    for (N& w : row) sum += w *= share;
    for (N& w : row) w = w / sum;
    return row;
  };
  return weights == Weights::kLoop ? kept_by_valence<N, std::vector<N>, 2>(n, make)
                                   : kept_by_valence<N, std::vector<N>, 3>(n, make);
}

/// Of the tangent along the sharp edge: the eigenvalue is mu = 3/8 + cos(t) / 4, the weights are those of the
/// arch but for r_0, which follows from the sum S of all, since a / n S = (1 - cos t) / 4. The rule at r_0
///   (1/2 - mu) w_0 + (w_1 + w_{n-1}) / 8 = a / n S
/// tells t.
struct DartTangentRule {
  int n;
  Weights weights;

  /// w_0, and what is missing to the rule at r_0; both times the arch's end.
  template <class N>
  std::pair<N, N> of(const Arch<N>& arch) const {
    const N cosine = NumberTraits<N>::cos(arch.t), share = (N(1) - cosine) / N(4) * arch.end;
    const N own = share * N(n) / ring_weight<N>(n, weights) - arch.scaled_sum();
    return {own, (N(1) - N(2) * cosine) / N(8) * own + arch.scaled(1) / N(4) - share};
  }
  template <class N>
  N operator()(const N& t) const {
    return of(Arch<N>{n, t}).second;
  }
};

/// The tangent along the sharp edge, the same on either side of it; towards r_0. On a regular star of radius 1
/// the sum is n / 2, as that of interior_tangents.
///   throws   data::ArgumentError in a number type without angles
template <class N>
const std::vector<N>& dart_tangent_weights(int n, Weights weights) {
  const auto make = [weights](int valence) {
    const DartTangentRule rule{valence, weights};
    const N t = dart_angle<N>(valence, rule);
    std::vector<N> row;
    if constexpr (kHasAngles<N>) {
      const Arch<N> arch{valence, t};
      row = arch.values();
      row[0] = rule.of(arch).first / arch.end;
      const CircleTable<N>& table = circle_table<N>(valence);
      N size(0);
      for (std::size_t i = 0; i < row.size(); ++i) size += row[i] * table.cosine[2 * i];
      const N share = N(valence) / (N(2) * size);
      for (N& w : row) w *= share;
    }
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
