// SPDX-License-Identifier: MIT
// The weights of quad_limit.h in any number with roots; quad_limit_double.cpp has those in double.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/rules/quad_limit.h"
#include "fast/rules/vertex_limit.h"

namespace limitcheck::fast::detail {

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

template <class S>
StarWeights<S> boundary_weights(int n) {
  StarWeights<S> w;
  const std::size_t size = 2 * static_cast<std::size_t>(n) + 1;
  w.du.assign(size, S(0));
  w.dv.assign(size, S(0));
  w.du.front() = S(1);
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
  StarWeights<S> w;
  const std::size_t size = 2 * static_cast<std::size_t>(n) + 1;
  w.du.assign(size, S(0));
  w.dv.assign(size, S(0));
  w.du.front() = S(1);
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

}  // namespace limitcheck::fast
