// SPDX-License-Identifier: MIT
// The masks of a dart: a vertex of n faces where one sharp edge ends. It moves by the smooth rule, but its
// neighbour e_0 along the sharp edge by the midpoint, so that its limit and tangents are not the smooth ones.
//
// The mesh is cut along the edge: the ring is a sector of n faces whose ends e_0 and e_n are the same points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reference/catmull_clark/masks.h"
#include "reference/number/dart_rows.h"

namespace limitcheck::reference::catmull_clark {

/// Weights of e_0 .. e_{n-1}, f_0 .. f_{n-1}; c has what is missing to 1, or to 0 in a tangent.
template <class N>
struct RingWeights {
  std::vector<N> e, f;
};

/// The limit. With w of c, and h_i = n^2 / w of e_i, 7 h_i - h_{i-1} - h_{i+1} = 20 as if h_0 were zero, and
/// f_i has (h_i + h_{i+1}) / 12 + 1/3; then e_0 has h_1 / 3 + 10/3.
template <class N>
RingWeights<N> make_dart_limit(int n) {
  RingWeights<N> weights{between_zeros<N>(n, 7, 20), {}};
  std::vector<N>& e = weights.e;
  for (std::size_t i = 0; i < e.size(); ++i)
    weights.f.push_back((e[i] + e[(i + 1) % e.size()]) / N(12) + N(1) / N(3));
  e[0] = (e[1] + N(10)) / N(3);
  N sum = N(n) * N(n);
  for (const auto* list : {&weights.e, &weights.f})
    for (const N& w : *list) sum += w;
  for (auto* list : {&weights.e, &weights.f})
    for (N& w : *list) w = w / sum;
  return weights;
}

/// Of the tangent along the sharp edge: with mu as in masks.h, d = mu - 1/4, and s = (sum of all weights) /
/// (4 n^2), each f_i has ((e_i + e_{i+1}) / 16 - s) / d as if e_0 had none, and the e_i are the arch where
///   (6 + 1 / (2 d)) s = 3/8 - mu + 1 / (32 d) + 2 (1/16 + 1 / (64 d)).
/// The rule at e_0, (1/2 - mu) e_0 + (e_1 + e_{n-1}) / 16 + (f_0 + f_{n-1}) / 4 = 6 s, tells t.
struct DartTangentRule {
  int n;

  /// All but s and what is missing to the rule are of the arch itself.
  template <class N>
  struct Values {
    N d, share, own, missing;  ///< the last three times the arch's end
  };
  template <class N>
  Values<N> of(const Arch<N>& arch) const {
    using T = NumberTraits<N>;
    const N cosine = T::cos(arch.t);
    const N mu = (N(5) + cosine + T::cos(arch.t / N(2)) * T::sqrt(N(2) * (N(9) + cosine))) / N(16);
    const N d = mu - N(1) / N(4);
    const N share = (N(1) / N(2) - mu + N(1) / (N(16) * d)) / (N(6) + N(1) / (N(2) * d)) * arch.end;
    const N near = arch.scaled_sum(), far = (near / N(8) - share * N(n)) / d;
    const N own = share * N(4) * N(n) * N(n) - near - far, first = arch.scaled(1);
    return {d, share, own,
            (N(1) / N(2) - mu) * own + first / N(8) + (first / N(16) - share) / (N(2) * d) - share * N(6)};
  }
  template <class N>
  N operator()(const N& t) const {
    return of(Arch<N>{n, t}).missing;
  }
};

/// The tangent along the sharp edge, the same on either side of it; towards e_0. On a regular star of radius 1
/// the weights of the e_i give 2 n, as those of interior_tangents.
///   throws   data::ArgumentError in a number type without angles
template <class N>
RingWeights<N> make_dart_tangent(int n) {
  const DartTangentRule rule{n};
  const N t = dart_angle<N>(n, rule);
  RingWeights<N> result;
  if constexpr (kHasAngles<N>) {
    const Arch<N> arch{n, t};
    const auto values = rule.of(arch);
    result.e = arch.values();
    const N share = values.share / arch.end;
    for (std::size_t i = 0; i < result.e.size(); ++i)
      result.f.push_back(((result.e[i] + result.e[(i + 1) % result.e.size()]) / N(16) - share) / values.d);
    result.e[0] = values.own / arch.end;
    const CircleTable<N>& table = circle_table<N>(n);
    N size(0);
    for (std::size_t i = 0; i < result.e.size(); ++i) size += result.e[i] * table.cosine[2 * i];
    const N factor = N(2 * n) / size;
    for (auto* weights : {&result.e, &result.f})
      for (N& w : *weights) w *= factor;
  }
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
