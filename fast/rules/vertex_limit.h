// SPDX-License-Identifier: MIT
// Limit position, limit tangents and ring recursion of one control vertex, in the order of its ring, for any
// number type.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <type_traits>
#include <vector>

#include "fast/mesh/vec3.h"
#include "fast/rules/masks.h"

namespace limitcheck::fast::row_stream {

/// All of it linear in v and its ring. W is the number the ring is summed in.
template <class W>
struct VertexLimit {
  Vec3<W> difference;  // d: sum of r_i - v over the ring; over its two ends on the boundary
  Vec3<W> position;
  Vec3<W> along, across;  // tangents, along x across outward for a counter-clockwise ring
};

/// The weights of a ring, made once per valence. S is what weights are made of: a field, with the cosines of
/// 2 pi / n at hand. Closed: n = valence >= 3. Open: n points, n >= 2, so n - 1 faces.
///
/// In floating point `sine` holds sines; elsewhere they are in units of sine[1], so that all weights lie in
/// the field of the cosine: rational for n = 3, 4, 6 and for 1 to 3 faces at an open ring.
template <class S>
struct RingWeights {
  S k0{}, k1{};                 // c' = 8 c + k0 d, d' = k1 d: both 8 times the subdivided ones
  S limit{};                    // position = v + limit * d
  S end{};                      // open: weight of both ends across the boundary, for `differences`
  std::vector<S> cosine, sine;  // per ring entry; open: sine alone

  static RingWeights closed(int n);
  static RingWeights open(int n);

 private:
  void make_angles(int count, int steps_per_turn);
};

/// cos and sin of 2 pi k / steps for k < count.
template <class S>
void RingWeights<S>::make_angles(int count, int steps) {
  cosine.resize(static_cast<std::size_t>(count));
  sine.resize(cosine.size());
  if constexpr (std::is_floating_point_v<S>) {
    for (int k = 0; k < count; ++k) {
      const S t = 2 * std::numbers::pi_v<S> * static_cast<S>(k) / static_cast<S>(steps);
      cosine[static_cast<std::size_t>(k)] = std::cos(t);
      sine[static_cast<std::size_t>(k)] = std::sin(t);
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

/// Limit weight 3 n / (8 a(n)) : 1, a(n) = 5/8 - (3 + 2 cos(2 pi / n))^2 / 64; tangents sum cos, sum sin.
/// [C10, C11, C14, C17]
template <class S>
RingWeights<S> RingWeights<S>::closed(int n) {
  RingWeights w;
  w.make_angles(n, n);
  const S a = loop_a_of(w.cosine[1]);
  w.k0 = S(8) * a / S(n);
  w.k1 = S(5) - S(8) * a;
  w.limit = S(1) / (S(3) * S(n) / (S(8) * a) + S(n));
  return w;
}

/// Limit (4 v + r_0 + r_K) / 6, along r_0 - r_K, across by the eigenvector of the ordinary interior rules:
/// with theta = pi / K, sin(k theta) inside and -c (1 + c) / ((1 + 2 c) s) at the ends. For K >= 6 the
/// surface has no unique tangent plane there. [claims D1, D2, D5]
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
  if constexpr (std::is_floating_point_v<S>) {  // k (pi / K), the rounding that callers know
    const S theta = std::numbers::pi_v<S> / static_cast<S>(faces);
    for (int k = 0; k < faces; ++k) w.sine[static_cast<std::size_t>(k)] = std::sin(static_cast<S>(k) * theta);
  }
  if (faces > 2) {
    const S c = w.cosine[1];
    S s = (S(1) - c) * (S(1) + c);  // s^2, the end's weight being in units of s too
    if constexpr (std::is_floating_point_v<S>) s = w.sine[1];
    w.end = -c * (S(1) + c) / ((S(1) + S(2) * c) * s);
  }
  return w;
}

/// Closed ring, counter-clockwise, n >= 3.
template <class W, class S>
VertexLimit<W> closed_limit(const Vec3<W>& v, std::span<const Vec3<W>> ring, const RingWeights<S>& weights) {
  Vec3<W> difference, along, across;
  const S *cosine = weights.cosine.data(), *sine = weights.sine.data();
  for (const Vec3<W>& r : ring) {
    const Vec3<W> d = r - v;
    difference = difference + d;
    along = along + *cosine++ * d;
    across = across + *sine++ * d;
  }
  return {difference, v + weights.limit * difference, along, across};
}

/// Open ring r_0 .. r_K, K >= 1.
template <class W, class S>
VertexLimit<W> open_limit(const Vec3<W>& v, std::span<const Vec3<W>> ring, const RingWeights<S>& weights) {
  VertexLimit<W> limit;
  const Vec3<W>&first = ring.front(), &last = ring.back();
  limit.difference = (first - v) + (last - v);
  limit.position = v + weights.limit * limit.difference;
  limit.along = first - last;
  // The centre's weight is minus the sum of the others, so offsets from v do without it.
  limit.across = weights.end * limit.difference;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    limit.across = limit.across + weights.sine[k] * (ring[k] - v);
  return limit;
}

}  // namespace limitcheck::fast::row_stream
