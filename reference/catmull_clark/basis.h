// SPDX-License-Identifier: MIT
// The uniform bicubic B-spline on one regular quad.
//
//      12 -- 13 -- 14 -- 15        The quad is (5, 6, 10, 9): (u, v) = (0, 0) at 5, (1, 0) at 6, (0, 1) at 9.
//       |     |     |     |
//       8 --- 9 -- 10 -- 11
//       |     |     |     |
//       4 --- 5 --- 6 --- 7
//       |     |     |     |
//       0 --- 1 --- 2 --- 3
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "reference/number/number.h"
#include "reference/number/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference::catmull_clark {

/// The four weights of one direction at t, and their derivatives.
template <class N>
struct CubicBasis {
  std::array<N, 4> value, first, second;

  explicit CubicBasis(const N& t) {
    const N s = N(1) - t, sixth = N(1) / N(6), half = N(1) / N(2);
    const N tt = t * t, ttt = tt * t;
    value = {s * s * s * sixth, (N(3) * ttt - N(6) * tt + N(4)) * sixth,
             (N(3) * (tt - ttt) + N(3) * t + N(1)) * sixth, ttt * sixth};
    first = {N(0) - s * s * half, (N(3) * tt - N(4) * t) * half, (N(2) * t - N(3) * tt + N(1)) * half,
             tt * half};
    second = {s, N(3) * t - N(2), N(1) - N(3) * t, t};
  }
};

/// The sixteen control points of a regular quad, in the order above.
template <class N>
using Patch = std::array<Vec3<N>, 16>;

/// A point of a patch: position and derivatives with respect to its own (u, v).
template <class N>
struct PatchPoint {
  Vec3<N> position, u, v, uu, uv, vv;
  N u_terms{}, v_terms{};  ///< of u and v, see Tangents
};

/// Everything up to `order`, from differences to point 5: exact zeros where points coincide.
///   size   the largest coordinate that the points were computed from, if not their own
template <class N>
PatchPoint<N> evaluate_patch(const Patch<N>& points, const N& u, const N& v, Order order, N size = N(0)) {
  const CubicBasis<N> a(u), b(v);
  const Vec3<N> origin = points[5];
  // Along u first: rows of positions, first and second derivatives.
  std::array<Vec3<N>, 4> value{}, first{}, second{};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3<N> d = points[4 * j + i] - origin;
      value[j] += d * a.value[i];
      if (order >= Order::kFirst) first[j] += d * a.first[i];
      if (order >= Order::kSecond) second[j] += d * a.second[i];
    }
  PatchPoint<N> p{};
  for (std::size_t j = 0; j < 4; ++j) p.position += value[j] * b.value[j];
  p.position += origin;
  if (order == Order::kPosition) return p;
  for (std::size_t j = 0; j < 4; ++j) {
    p.u += first[j] * b.value[j];
    p.v += value[j] * b.first[j];
  }
  if constexpr (kRounds<N>) {
    for (const Vec3<N>& q : points) size = std::max(size, magnitude(q));
    for (std::size_t j = 0; j < 4; ++j) {
      p.u_terms += magnitude(a.first[j]);
      p.v_terms += magnitude(b.first[j]);
    }
    p.u_terms *= N(2) * size;  // both ends of each difference; the other direction's weights sum to 1
    p.v_terms *= N(2) * size;
  }
  if (order == Order::kFirst) return p;
  for (std::size_t j = 0; j < 4; ++j) {
    p.uu += second[j] * b.value[j];
    p.uv += first[j] * b.first[j];
    p.vv += value[j] * b.second[j];
  }
  return p;
}

}  // namespace limitcheck::reference::catmull_clark
