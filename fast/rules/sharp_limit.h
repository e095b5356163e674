// SPDX-License-Identifier: MIT
// The limit of a control vertex that is held or a dart, in Loop's scheme. [Hoppe et al. 1994]
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <type_traits>
#include <vector>

#include "data/error.h"
#include "fast/mesh/vertex_kind.h"
#include "fast/rules/left_eigenvectors.h"
#include "fast/rules/vertex_limit.h"

namespace limitcheck::fast {

/// Weights of the differences between the n neighbours of a dart and the dart, e_0 first. du points to e_0.
template <class S>
struct DartWeights {
  std::vector<S> position, du, dv;
};

/// For n >= 3 faces. By iteration, in double to about 1e-14: position and du have no closed form. dv is that
/// of a smooth vertex: antisymmetric, it does not know of e_0.
template <class S>
DartWeights<S> dart_weights(int n) {
  static_assert(std::is_floating_point_v<S>);
  // The ring as it is seen by what is symmetric to e_0: entry 0 is the centre, entry 1 + j stands for e_j and
  // e_{n-j}, which have equal weights.
  const auto entry = [n](int i) {
    const int j = (i + n) % n;
    return static_cast<std::size_t>(1 + std::min(j, n - j));
  };
  const std::size_t size = 2 + static_cast<std::size_t>(n / 2);
  detail::Matrix<S> step(size, detail::Row<S>(size));
  const S angle = 2 * std::numbers::pi_v<S> / static_cast<S>(n);
  const S a = loop_a(std::cos(angle));
  step[0][0] = 1 - a;
  for (int i = 0; i < n; ++i) step[0][entry(i)] += a / static_cast<S>(n);
  step[1][0] = step[1][1] = S(.5);
  for (int i = 1; i <= n / 2; ++i) {
    detail::Row<S>& row = step[entry(i)];
    row[0] += S(.375);
    row[entry(i)] += S(.375);
    for (const int side : {i - 1, i + 1}) row[entry(side)] += S(.125);
  }
  const detail::Row<S> limit = detail::limit_eigenvector(step);
  detail::Row<S> tangent = detail::tangent_eigenvector(step);
  std::vector<S> members(size);
  for (int i = 0; i < n; ++i) ++members[entry(i)];
  S towards(0);
  for (int i = 0; i < n; ++i)
    towards += tangent[entry(i)] / members[entry(i)] * std::cos(angle * static_cast<S>(i));
  DartWeights<S> w;
  for (int i = 0; i < n; ++i) {
    w.position.push_back(limit[entry(i)] / members[entry(i)]);
    w.du.push_back(tangent[entry(i)] / members[entry(i)] / towards);
    w.dv.push_back(std::sin(angle * static_cast<S>(i)));
  }
  return w;
}

/// The limit of a vertex that is held. At an open ring its tangents go to the ends, which is the tangent
/// plane of up to two faces; at a closed one there is no plane, and they are the smooth tangents.
template <class W, class S>
VertexLimit<W> held_limit(const Vec3<W>& v, std::span<const Vec3<W>> ring, bool open,
                          const RingWeights<S>& weights) {
  VertexLimit<W> limit = vertex_limit(v, ring, open, weights);
  limit.position = v;
  if (open) limit.du = ring.front() - v, limit.dv = ring.back() - v;
  return limit;
}

/// The limit of a dart.
///   ring   n + 1 points, of which the first and the last are the same
template <class W, class S>
VertexLimit<W> dart_limit(const Vec3<W>& v, std::span<const Vec3<W>> ring, const DartWeights<S>& weights) {
  VertexLimit<W> limit{};
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const Vec3<W> d = ring[i] - v;
    limit.difference = limit.difference + d;
    limit.position = limit.position + weights.position[i] * d;
    limit.du = limit.du + weights.du[i] * d;
    limit.dv = limit.dv + weights.dv[i] * d;
  }
  limit.position = v + limit.position;
  return limit;
}

/// The weights for every valence of a dart, each made when it is first asked for.
template <class S>
class DartWeightTable {
 public:
  const DartWeights<S>& of(std::size_t faces) {
    if (faces >= list_.size()) list_.resize(faces + 1);
    if (list_[faces].du.empty()) list_[faces] = dart_weights<S>(static_cast<int>(faces));
    return list_[faces];
  }

 private:
  std::vector<DartWeights<S>> list_;
};

/// The limit of a vertex of any kind. Numbers that are no floating-point ones have no darts.
template <class W, class S>
VertexLimit<W> limit_of_kind(const Vec3<W>& v, std::span<const Vec3<W>> ring, bool open, VertexKind kind,
                             const RingWeights<S>& weights, DartWeightTable<S>& darts) {
  if (kind == VertexKind::kPlain) return vertex_limit(v, ring, open, weights);
  if (kind == VertexKind::kHeld) return held_limit(v, ring, open, weights);
  if constexpr (std::is_floating_point_v<S>)
    return dart_limit(v, ring, darts.of(ring.size() - 1));
  else
    throw data::ArgumentError("the weights of a dart have no closed form");
}

}  // namespace limitcheck::fast
