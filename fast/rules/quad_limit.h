// SPDX-License-Identifier: MIT
// The limit of a vertex of a mesh of quads from its ring: position and tangents. [C21; Halstead, Kass &
// DeRose 1993]
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fast/rules/quad_star.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// Weights of the differences between the points of a ring and its centre; one entry per point.
template <class S>
struct StarWeights {
  std::vector<S> du, dv;
  std::vector<S> position;  // of a dart; elsewhere it is a sum that star_limit() knows
};

/// For a star of so many faces. Tangents are left eigenvectors, so exact wherever there is a tangent plane;
/// du x dv points outward. S: double, or a number with roots (quad_limit_impl.h).
///   closed    n >= 3; du points to e_0
///   boundary  n >= 1: du = e_0 - e_n along, dv across. From 4 faces on there is no tangent plane in general,
///             and this is the plane of the mask.
///   held      open: du = e_0 - c, dv = e_n - c, which is the tangent plane of up to two faces; closed: there
///             is none, and these are the smooth tangents.
///   dart      by iteration, in double to about 1e-14: they have no closed form; from 64 faces on in linear time
///             (quad_limit.cpp)
template <class S>
StarWeights<S> star_weights(int faces, bool open, VertexKind kind);

/// The weights for every kind of star that a mesh has, each made when it is first asked for. Not for several
/// threads at once.
template <class S>
class StarWeightTable {
 public:
  const StarWeights<S>& of(int faces, bool open, VertexKind kind) {
    auto& list = list_[2 * static_cast<std::size_t>(kind) + (open ? 1 : 0)];
    if (static_cast<std::size_t>(faces) >= list.size()) list.resize(static_cast<std::size_t>(faces) + 1);
    auto& entry = list[static_cast<std::size_t>(faces)];
    if (entry == nullptr) entry = std::make_unique<StarWeights<S>>(star_weights<S>(faces, open, kind));
    return *entry;
  }

 private:
  std::vector<std::unique_ptr<StarWeights<S>>> list_[6];
};

/// The limit of a star without semi-sharp edges.
template <class W>
LimitFrame<W> star_limit(const QuadStar<W>& star,
                         const StarWeights<typename NumberTraits<W>::Scalar>& weights) {
  using T = NumberTraits<W>;
  Vec3<W> edges{}, faces{}, du{}, dv{}, dart{};
  const bool is_dart = star.kind == VertexKind::kDart;
  for (int i = 0; i < star.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vec3<W> d = star.ring[i] - star.centre;
    Vec3<W>& sum = i % 2 == 0 ? edges : faces;
    sum = sum + d;
    if (is_dart) dart = dart + weights.position[k] * d;
    du = du + weights.du[k] * d;
    dv = dv + weights.dv[k] * d;
  }
  const Vec3<W>& v = star.centre;
  const int n = star.faces;
  if (star.kind == VertexKind::kHeld) return {v, du, dv};
  if (is_dart) return {v + dart, du, dv};
  if (star.open) return {v + T::ratio(1, 6) * ((star.edge(0) - v) + (star.edge(n) - v)), du, dv};
  return {v + T::ratio(1, n * (n + 5)) * (T::ratio(4, 1) * edges + faces), du, dv};
}

}  // namespace limitcheck::fast

namespace limitcheck::fast::detail {

/// From so many faces on a dart's weights come from a recurrence and not from powers of its matrix, which take
/// 20 n^3 operations.
inline constexpr int kLargeDart = 64;

/// The error of a weight, for each face, in units of the largest weight of its kind (tangents; measured: a
/// quarter of this at 100 000 faces).
inline constexpr double kLargeDartError = 0x1p-52 * 2;

/// Position and du of star_weights<double>(n, ., kDart), dv left empty. All neighbours but e_0 follow one rule,
/// as if e_0 had no weight: the weights solve a difference equation with zeros at both ends.
StarWeights<double> large_dart_weights(int n);

}  // namespace limitcheck::fast::detail
