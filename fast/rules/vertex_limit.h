// SPDX-License-Identifier: MIT
// The limit of a control vertex from its ring, for any number type: position and tangents. [mueller2000, eq.
// 3-5; C14, C17, D1, D2]
#pragma once

#include <cstddef>
#include <span>
#include <vector>

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
