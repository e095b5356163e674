// SPDX-License-Identifier: MIT
// The limit of a control vertex of Loop's scheme from its ring, for any number type: position and tangents, also
// where it is held or a dart. [mueller2000, eq. 3-5; C14, C17, D1, D2; Hoppe et al. 1994]
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <type_traits>
#include <vector>

#include "data/error.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/mesh/vec3.h"
#include "fast/rules/masks.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// The weights of a ring, made once for each number of its points. S is what weights are made of: a field,
/// with the cosines of 2 pi / n at hand. Closed: n = valence >= 3. Open: n points, n >= 2, so n - 1 faces.
///
/// `sine` holds sines if NumberTraits<S> has them; otherwise they are in units of sine[1], so that all
/// weights lie in the field of the cosine: rational for n = 3, 4, 6 and for 1 to 3 faces at an open ring.
template <class S>
struct RingWeights {
  S k0{}, k1{};                 // c' = 8 c + k0 d, d' = k1 d: both 8 times the subdivided ones
  S limit{};                    // position = v + limit * d
  S end{};                      // open: weight of both ends across the boundary, for differences to v
  std::vector<S> cosine, sine;  // per ring entry; open: the sines alone are used

  static RingWeights closed(int n);
  static RingWeights open(int n);

 private:
  static constexpr bool kHasSines = requires { NumberTraits<S>::sine(1, 2); };
  void make_angles(int count, int steps_per_turn);
};

/// The weights for every number of ring points that a mesh has.
template <class S>
class RingWeightTable {
 public:
  explicit RingWeightTable(int max_valence = 0)
      : closed_(static_cast<std::size_t>(max_valence) + 1), open_(closed_.size()) {}

  /// Makes the weights of a ring of n points if they are not there yet.
  void make(std::size_t n, bool open) {
    auto& list = open ? open_ : closed_;
    if (n >= list.size()) list.resize(n + 1);
    if (list[n].sine.empty())
      list[n] =
          open ? RingWeights<S>::open(static_cast<int>(n)) : RingWeights<S>::closed(static_cast<int>(n));
  }
  /// After make(n, open).
  const RingWeights<S>& of(std::size_t n, bool open) const { return (open ? open_ : closed_)[n]; }

 private:
  std::vector<RingWeights<S>> closed_, open_;  // by number of ring points
};

/// d, the sum of r_i - v over a closed ring, or over the two ends of an open one, beside the limit.
template <class W>
struct VertexLimit : LimitFrame<W> {
  Vec3<W> difference;
};

/// cos and sin of 2 pi k / steps for k < count.
template <class S>
void RingWeights<S>::make_angles(int count, int steps) {
  cosine.resize(static_cast<std::size_t>(count));
  sine.resize(cosine.size());
  if constexpr (kHasSines) {
    for (int k = 0; k < count; ++k) {
      cosine[k] = NumberTraits<S>::cosine(k, steps);
      sine[k] = NumberTraits<S>::sine(k, steps);
    }
  } else {  // Chebyshev's recurrences
    cosine[0] = S(1);
    if (count > 1) cosine[1] = NumberTraits<S>::cosine(1, steps), sine[1] = S(1);
    for (std::size_t k = 2; k < cosine.size(); ++k) {
      cosine[k] = S(2) * cosine[1] * cosine[k - 1] - cosine[k - 2];
      sine[k] = S(2) * cosine[1] * sine[k - 1] - sine[k - 2];
    }
  }
}

/// Limit weight 1 : 3 n / (8 a(n)) of the ring and the vertex; tangents sum cos, sum sin. [C10, C11, C14,
/// C17]
template <class S>
RingWeights<S> RingWeights<S>::closed(int n) {
  RingWeights w;
  w.make_angles(n, n);
  const S a8 = S(8) * loop_a(w.cosine[1]);
  w.k0 = a8 / S(n);
  w.k1 = S(5) - a8;
  w.limit = a8 / (S(n) * (S(3) + a8));
  return w;
}

/// Limit (4 v + r_0 + r_K) / 6, along the boundary r_0 - r_K, across it by the eigenvector of the ordinary
/// interior rules: with theta = pi / K, sin(k theta) inside and -c (1 + c) / ((1 + 2 c) s) at the ends. For
/// K >= 6 the surface has no unique tangent plane there. [claims D1, D2, D5]
template <class S>
RingWeights<S> RingWeights<S>::open(int n) {
  RingWeights w;
  const int faces = n - 1;
  w.k0 = S(1);
  w.k1 = S(2);
  w.limit = S(1) / S(6);
  w.end = S(faces == 1 ? 1 : 0);  // one face: the sum of both ends; two: the middle alone
  if (faces == 1) return w;
  w.make_angles(faces, 2 * faces);
  if (faces > 2) {
    const S c = w.cosine[1];
    S s = w.sine[1];
    if constexpr (!kHasSines) s = (S(1) - c) * (S(1) + c);  // s^2, the end's weight being in units of s too
    w.end = -(c * (S(1) + c) / ((S(1) + S(2) * c) * s));
  }
  return w;
}

/// The limit of v. `ring` counter-clockwise from outside, in a canonical order: from any start at an interior
/// vertex (n >= 3), r_0 .. r_K along the boundary from end to end (`open`, n >= 2). Summed in W from
/// differences to v.
///   weights   of this number of points
template <class W, class S>
inline VertexLimit<W> vertex_limit(const Vec3<W>& v, std::span<const Vec3<W>> ring, bool open,
                                   const RingWeights<S>& weights) {
  Vec3<W> difference{}, du{}, dv{};
  if (open) {
    const Vec3<W> first = ring.front() - v, last = ring.back() - v;
    difference = first + last;
    du = first - last;
    // The centre's weight is minus the sum of the others, so offsets from v do without it.
    dv = weights.end * difference;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) dv = dv + weights.sine[k] * (ring[k] - v);
  } else {
    const S *cosine = weights.cosine.data(), *sine = weights.sine.data();
    for (const Vec3<W>& r : ring) {
      const Vec3<W> d = r - v;
      difference = difference + d;
      du = du + *cosine++ * d;
      dv = dv + *sine++ * d;
    }
  }
  return {{v + weights.limit * difference, du, dv}, difference};
}

}  // namespace limitcheck::fast

namespace limitcheck::fast::detail {

template <class S>
using Row = std::vector<S>;
template <class S>
using Matrix = std::vector<Row<S>>;

template <class S>
Matrix<S> product(const Matrix<S>& a, const Matrix<S>& b) {
  Matrix<S> c(a.size(), Row<S>(a.size()));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a.size(); ++k)
      if (a[i][k] != 0)
        for (std::size_t j = 0; j < a.size(); ++j) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// Of eigenvalue 1; it sums to 1.
template <class S>
Row<S> limit_eigenvector(const Matrix<S>& step) {
  Row<S> x(step.size(), S(1) / S(static_cast<int>(step.size())));
  for (int i = 0; i < 300; ++i) {
    Row<S> next(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      for (std::size_t j = 0; j < x.size(); ++j) next[j] += x[k] * step[k][j];
    x = next;
  }
  S sum(0);
  for (const S& w : x) sum += w;
  for (S& w : x) w /= sum;
  return x;
}

/// Of the largest other eigenvalue, of any length and sign: by squaring what is left without the first.
template <class S>
Row<S> tangent_eigenvector(const Matrix<S>& step) {
  const Row<S> first = limit_eigenvector(step);
  Matrix<S> power = step;
  for (Row<S>& row : power)
    for (std::size_t j = 0; j < row.size(); ++j) row[j] -= first[j];
  for (int i = 0; i < 20; ++i) {
    power = product<S>(power, power);
    S largest(0);
    for (const Row<S>& row : power)
      for (const S& x : row) largest = std::max(largest, x < S(0) ? S(-x) : x);
    for (Row<S>& row : power)
      for (S& x : row) x /= largest;
  }
  const auto size = [](const Row<S>& row) {
    S sum(0);
    for (const S& x : row) sum += x * x;
    return sum;
  };
  return *std::max_element(power.begin(), power.end(),
                           [&](const Row<S>& a, const Row<S>& b) { return size(a) < size(b); });
}

}  // namespace limitcheck::fast::detail

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
