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

#include "reference/catmull_clark/vertex_limit.h"
#include "reference/number/number.h"
#include "reference/number/vec3.h"
#include "reference/point/local_point.h"
#include "reference/point/normal.h"
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

/// Everything up to `order`, from differences to point 5: exact zeros where points coincide.
///   size   the largest coordinate that the points were computed from, if not their own
template <class N>
LocalPoint<N> evaluate_patch(const Patch<N>& points, const N& u, const N& v, Derivatives order,
                             N size = N(0)) {
  const CubicBasis<N> a(u), b(v);
  const Vec3<N> origin = points[5];
  // Along u first: rows of positions, first and second derivatives.
  std::array<Vec3<N>, 4> value{}, first{}, second{};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3<N> d = points[4 * j + i] - origin;
      value[j] += d * a.value[i];
      if (order >= Derivatives::kFirst) first[j] += d * a.first[i];
      if (order >= Derivatives::kSecond) second[j] += d * a.second[i];
    }
  LocalPoint<N> p{};
  for (std::size_t j = 0; j < 4; ++j) p.position += value[j] * b.value[j];
  p.position += origin;
  if (order == Derivatives::kPosition) return p;
  for (std::size_t j = 0; j < 4; ++j) {
    p.a += first[j] * b.value[j];
    p.b += value[j] * b.first[j];
  }
  if constexpr (kRounds<N>) {
    for (const Vec3<N>& q : points) size = std::max(size, magnitude(q));
    for (std::size_t j = 0; j < 4; ++j) {
      p.a_terms += magnitude(a.first[j]);
      p.b_terms += magnitude(b.first[j]);
    }
    p.a_terms *= N(2) * size;  // both ends of each difference; the other direction's weights sum to 1
    p.b_terms *= N(2) * size;
  }
  if (order == Derivatives::kFirst) return p;
  for (std::size_t j = 0; j < 4; ++j) {
    p.aa += second[j] * b.value[j];
    p.ab += first[j] * b.first[j];
    p.bb += value[j] * b.second[j];
  }
  return p;
}

// A point of the surface from a regular patch, or at an extraordinary corner.

/// How the parameters of a sub-quad that starts at corner k of its quad are turned against the quad's. Of corner 0
/// to 3 they are (u, v), (v, 1 - u), (1 - u, 1 - v), (1 - v, u).
constexpr ParameterGradients turn_of(std::size_t corner) {
  constexpr std::array<ParameterGradients, 4> turns{
      {{1, 0, 0, 1}, {0, 1, -1, 0}, {-1, 0, 0, -1}, {0, -1, 1, 0}}};
  return turns[corner];
}

/// Twice the area of a quad times its normal: what takes the normal's place where the tangents vanish. [D12]
template <class N>
Vec3<N> area_of(const Vec3<N>& a, const Vec3<N>& b, const Vec3<N>& c, const Vec3<N>& d) {
  return cross(c - a, d - b);
}

/// A corner of a quad: the faces of its vertex, and which of them the quad is.
struct CornerPlace {
  int faces, sector;
  bool on_boundary;
  VertexState state;
};

/// At an extraordinary corner itself: a vertex of valence other than four, or of other than two faces on the
/// boundary. Which derivatives there are is said by vertex_limit.h; those that are not zero are linear:
///   boundary, K = 1   slopes +-(r_0 - r_1) / 2 along the two edges
///   dart, n = 4       along neighbour i 11/104 C cos(i pi/2) + 1/12 S sin(i pi/2), of the tangents C along
///                     the sharp edge and S across it: a plane with the neighbours (1, 0), (0, 1), (-1, 0),
///                     (0, -1) has 104/11 and 12
/// The tangent plane is given everywhere:
///   interior   t1, t2 along the u and v of the quad, of the size of its edges
///   boundary   t1 along the boundary (r_0 - r_K) / 2, t2 across it into the surface
///   held       on the boundary t1 and t2 along its two edges; inside, where there is no plane, as inside
///   dart       t1 along the sharp edge, t2 across it
///   k          which corner of the quad it is
///   halved     whether the face's parameters go over two quads on each side
template <class N>
SurfacePoint<N> extraordinary_corner(const VertexLimit<N>& limit, const CornerPlace& corner, std::size_t k,
                                     bool halved, Derivatives order) {
  SurfacePoint<N> result;
  result.at_corner = true;
  result.position = limit.position;
  result.limits = {leading_modes(corner.faces, corner.on_boundary, corner.state),
                   corner.on_boundary && corner.state != VertexState::kDart};
  if constexpr (kHasNormals<N>) {
    const Tangents<N>& tangents = limit.tangents;
    const Normal<N>& normal = limit.normal;
    result.normal = normal.direction;
    result.normal_kind = normal.kind;
    result.normal_condition = normal.condition;
    if (order == Derivatives::kPosition) return result;
    const int count = corner.faces;
    const auto around = [&](int i, const N& first, const N& second) {
      const CircleTable<N>& circle = circle_table<N>(count);
      const auto at = 2 * static_cast<std::size_t>(i) % circle.cosine.size();
      return tangents.first * (circle.cosine[at] * first) + tangents.second * (circle.sine[at] * second);
    };
    LocalPoint<N> tangent{}, linear{};
    if (corner.on_boundary) {
      N first(1), second(1);
      if (corner.state == VertexState::kDart) {
        first = second = N(1) / N(2 * count);
        if (result.limits.first.fate == Fate::kValue) {
          const N along = N(11) / N(104), across = N(1) / N(12);
          linear.a = around(corner.sector, along, across);
          linear.b = around(corner.sector + 1, along, across);
        }
      } else if (corner.state == VertexState::kOrdinary) {
        first = N(1) / N(2), second = N(1) / N(2 * count + 1);
        linear.a = tangents.first * first;
        linear.b = Vec3<N>{} - linear.a;
      }
      result.t1 = tangents.first * first;
      result.t2 = tangents.second * second;
      result.t1_terms = tangents.first_terms * first;
      result.t2_terms = tangents.second_terms * second;
    } else {
      const N share = N(1) / N(2 * count);
      tangent.a = around(corner.sector, N(1), N(1)) * share;
      tangent.b = around(corner.sector + 1, N(1), N(1)) * share;
      tangent.a_terms = tangent.b_terms = (tangents.first_terms + tangents.second_terms) * share;
      set_derivatives(result, tangent, turn_of(k), N(1), N(1), Derivatives::kFirst);
    }
    SurfacePoint<N> derivatives;
    set_derivatives(derivatives, linear, turn_of(k), N(halved ? 2 : 1), N(1), Derivatives::kFirst);
    result.first_exist = result.limits.first.exists();
    result.d1 = result.first_exist ? derivatives.d1 : result.t1;
    result.d2 = result.first_exist ? derivatives.d2 : result.t2;
  }
  return result;
}

}  // namespace limitcheck::reference::catmull_clark
