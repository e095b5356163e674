// SPDX-License-Identifier: MIT
// The limit of a vertex of a mesh of quads from its ring: position and tangents. [C21; Halstead, Kass &
// DeRose 1993]
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <type_traits>
#include <vector>

#include "fast/rules/quad_star.h"
#include "fast/rules/surface_vertex.h"
#include "fast/rules/vertex_limit.h"

namespace limitcheck::fast {

/// Weights of the differences between the points of a ring and its centre; one entry per point.
template <class S>
struct StarWeights {
  std::vector<S> du, dv;
  std::vector<S> position;  // of a dart; elsewhere it is a sum that star_limit() knows
};

/// For a star of so many faces. Tangents are left eigenvectors, so exact wherever there is a tangent plane;
/// du x dv points outward. S: double, or a number with roots.
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

using std::numbers::pi;

/// Multiples of an angle 2 pi / q.
template <class S>
struct Multiples {
  int q;
  double theta = 2 * pi / q;  // of double alone

  S cosine(int i) const {
    if constexpr (std::is_same_v<S, double>)
      return std::cos(i * theta);
    else
      return NumberTraits<S>::cosine(i, q);
  }
  S sine(int i) const {
    if constexpr (std::is_same_v<S, double>)
      return std::sin(i * theta);
    else
      return NumberTraits<S>::sine(i, q);
  }
  /// 4 lambda - 1 of the waves with this angle from edge to edge.
  S four_lambda_less_one() const {
    using std::sqrt;
    const S c = cosine(1);
    S half;
    if constexpr (std::is_same_v<S, double>)
      half = std::cos(theta / 2);
    else
      half = NumberTraits<S>::cosine(1, 2 * q);
    return (S(1) + c + half * sqrt(S(2) * (S(9) + c))) / S(4);
  }
};

/// The waves of a closed ring, cosine and sine.
template <class S>
StarWeights<S> closed_weights(int n) {
  StarWeights<S> w;
  const Multiples<S> angle{n};
  const S m = angle.four_lambda_less_one();
  for (int i = 0; i < n; ++i) {
    w.du.push_back(S(4) * angle.cosine(i));
    w.du.push_back((angle.cosine(i) + angle.cosine(i + 1)) / m);
    w.dv.push_back(S(4) * angle.sine(i));
    w.dv.push_back((angle.sine(i) + angle.sine(i + 1)) / m);
  }
  return w;
}

/// An open ring: du to e_0, the rest 0.
template <class S>
StarWeights<S> first_edge_alone(int n) {
  StarWeights<S> w;
  w.du.assign(2 * static_cast<std::size_t>(n) + 1, S(0));
  w.dv = w.du;
  w.du.front() = S(1);
  return w;
}

template <class S>
StarWeights<S> boundary_weights(int n) {
  StarWeights<S> w = first_edge_alone<S>(n);
  w.du.back() = S(-1);
  if (n == 1) {
    w.dv = {S(1), S(0), S(1)};
    return w;
  }
  Multiples<S> angle{2 * n};
  angle.theta = pi / n;
  const S m = angle.four_lambda_less_one();
  S t;
  if constexpr (std::is_same_v<S, double>)
    t = 1 / std::tan(angle.theta / 2);
  else
    t = angle.sine(1) / (S(1) - angle.cosine(1));
  for (int i = 0; i < n; ++i) {
    w.dv[2 * i] = S(4) * angle.sine(i);
    w.dv[2 * i + 1] = (angle.sine(i) + angle.sine(i + 1)) / m;
  }
  w.dv.front() = w.dv.back() = ((m + S(1)) * angle.sine(1) - (S(2) * m + S(1)) * t) / (m * m);
  return w;
}

template <class S>
StarWeights<S> held_weights(int n) {
  StarWeights<S> w = first_edge_alone<S>(n);
  w.dv.back() = S(1);
  return w;
}

/// A dart's star as it is seen by what is symmetric to its sharp edge e_0: entry 0 is the centre, then come
/// e_j and e_{n-j}, then f_j and f_{n-1-j}, which have equal weights and make one entry.
template <class S>
class DartMatrix {
 public:
  explicit DartMatrix(int n) : n_(n), edges_(n / 2 + 1), faces_((n + 1) / 2) {
    step_.assign(static_cast<std::size_t>(1 + edges_ + faces_),
                 Row<S>(static_cast<std::size_t>(1 + edges_ + faces_)));
    const S valence(n);
    Row<S>& centre = step_[0];
    centre[0] = S(1) - S(7) / (S(4) * valence);
    for (int i = 0; i < n; ++i) {
      centre[edge(i)] += S(3) / (S(2) * valence * valence);
      centre[face(i)] += S(1) / (S(4) * valence * valence);
    }
    for (int i = 0; i < edges_; ++i) {
      Row<S>& row = step_[edge(i)];
      row[0] += S(i == 0 ? .5 : .375);
      row[edge(i)] += S(i == 0 ? .5 : .375);
      if (i == 0) continue;
      for (const int side : {i - 1, i + 1}) row[edge(side)] += S(.0625);
      for (const int side : {i - 1, i}) row[face(side)] += S(.0625);
    }
    for (int i = 0; i < faces_; ++i) {
      Row<S>& row = step_[face(i)];
      for (const std::size_t k : {std::size_t{0}, edge(i), edge(i + 1), face(i)}) row[k] += S(.25);
    }
  }

  Row<S> limit() const { return limit_eigenvector(step_); }
  /// Towards e_0 it is positive.
  Row<S> tangent() const {
    Row<S> out = tangent_eigenvector(step_);
    S towards(0);
    for (int i = 0; i < edges_; ++i) towards += out[edge(i)] * S(std::cos(2 * pi * i / n_));
    for (S& x : out) x /= towards;
    return out;
  }

  /// The weights of e_0, f_0, .., e_{n-1}, f_{n-1}, and 0 for e_n.
  std::vector<S> of_ring(const Row<S>& x) const {
    std::vector<S> out;
    std::vector<int> members(x.size());
    for (int i = 0; i < n_; ++i) ++members[edge(i)], ++members[face(i)];
    for (int i = 0; i < n_; ++i)
      for (const std::size_t k : {edge(i), face(i)}) out.push_back(x[k] / S(members[k]));
    out.push_back(S(0));
    return out;
  }

 private:
  std::size_t edge(int i) const {
    i = (i + n_) % n_;
    return static_cast<std::size_t>(1 + std::min(i, n_ - i));
  }
  std::size_t face(int i) const {
    i = (i + n_) % n_;
    return static_cast<std::size_t>(1 + edges_ + std::min(i, n_ - 1 - i));
  }

  int n_, edges_, faces_;
  Matrix<S> step_;
};

template <class S>
StarWeights<S> dart_weights(int n) {
  StarWeights<S> w;
  if constexpr (std::is_same_v<S, double>)
    if (n >= kLargeDart) w = large_dart_weights(n);
  if (w.position.empty()) {
    const DartMatrix<S> dart(n);
    w.position = dart.of_ring(dart.limit());
    w.du = dart.of_ring(dart.tangent());
  }
  w.dv = closed_weights<S>(n).dv;  // antisymmetric: it does not know of e_0
  w.dv.push_back(S(0));
  return w;
}

}  // namespace limitcheck::fast::detail

namespace limitcheck::fast {

template <class S>
StarWeights<S> star_weights(int faces, bool open, VertexKind kind) {
  if (kind == VertexKind::kDart) return detail::dart_weights<S>(faces);
  if (!open) return detail::closed_weights<S>(faces);
  return kind == VertexKind::kHeld ? detail::held_weights<S>(faces) : detail::boundary_weights<S>(faces);
}

extern template StarWeights<double> star_weights(int, bool, VertexKind);

}  // namespace limitcheck::fast
