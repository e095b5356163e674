// SPDX-License-Identifier: MIT
// A regular patch at a point, and how its parameters lie on the control face.
#pragma once

#include <array>

#include "reference/basis.h"
#include "reference/normal.h"
#include "reference/surface_point.h"

namespace limitcheck::reference {

/// Where a small triangle of the parameter domain lies: its first and second barycentric coordinate (a, b) as
/// functions of (l1, l2) have the gradients 2^level (a1, a2), 2^level (b1, b2).
struct Placement {
  int a1 = 1, a2 = 0, b1 = 0, b2 = 1;
  long level = 0;
};

/// Derivatives with respect to (a, b), still to be turned into those with respect to (l1, l2).
template <class N>
struct LocalPoint {
  Vec3<N> position, a, b, aa, ab, bb;
};

/// The twelve points in the order of Appendix A, weighted, as differences from the fourth: exact zeros where
/// they coincide.
template <class N, class Points>
LocalPoint<N> evaluate_patch(const Points& points, const Basis<N>& basis, Order order) {
  const Vec3<N>& origin = points[3];
  std::array<Vec3<N>, 12> d;
  for (std::size_t i = 0; i < 12; ++i) d[i] = points[i] - origin;
  LocalPoint<N> s{};
  for (std::size_t i = 0; i < 12; ++i) s.position += d[i] * basis.value[i];
  s.position += origin;
  if (order == Order::kPosition) return s;
  for (std::size_t i = 0; i < 12; ++i) {
    s.a += d[i] * basis.da[i];
    s.b += d[i] * basis.db[i];
  }
  if (order == Order::kFirst) return s;
  for (std::size_t i = 0; i < 12; ++i) {
    s.aa += d[i] * basis.daa[i];
    s.ab += d[i] * basis.dab[i];
    s.bb += d[i] * basis.dbb[i];
  }
  return s;
}

/// Sets the derivatives of `result` by the chain rule; `first`,
/// `second` are factors beside those of the placement.
template <class N>
void place(SurfacePoint<N>& result, const LocalPoint<N>& s, const Placement& at, const N& first,
           const N& second, Order order) {
  if (order == Order::kPosition) return;
  const N a1(at.a1), a2(at.a2), b1(at.b1), b2(at.b2);
  result.d1 = (s.a * a1 + s.b * b1) * first;
  result.d2 = (s.a * a2 + s.b * b2) * first;
  result.first_exist = true;
  if (order == Order::kFirst) return;
  result.d11 = (s.aa * (a1 * a1) + s.ab * (N(2) * a1 * b1) + s.bb * (b1 * b1)) * second;
  result.d12 = (s.aa * (a1 * a2) + s.ab * (a1 * b2 + a2 * b1) + s.bb * (b1 * b2)) * second;
  result.d22 = (s.aa * (a2 * a2) + s.ab * (N(2) * a2 * b2) + s.bb * (b2 * b2)) * second;
  result.second_exist = true;
}

/// At an extraordinary corner. d1, d2 are not partial derivatives there (first_exist stays false): inside,
/// the tangent masks' map of the face's own parameter directions; on the boundary, along and across.
///   sector     of the face in the corner's ring
///   placement  of (a, b) towards the corner's next and previous neighbour in the face
template <class N>
SurfacePoint<N> extraordinary_corner(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary,
                                     int sector, const Placement& at) {
  const VertexLimit<N> limit = vertex_limit(v, ring, on_boundary);
  SurfacePoint<N> result;
  result.position = limit.position;
  result.normal = limit.normal.direction;
  result.normal_kind = limit.normal.kind;
  const Vec3<N>&c = limit.tangents.first, &s = limit.tangents.second;
  if (on_boundary) {
    result.d1 = c;
    result.d2 = s;
    return result;
  }
  const auto& circle = circle_table<N>(static_cast<long>(ring.size()));
  const auto towards = [&](int i) {
    const auto k = 2 * static_cast<std::size_t>(i) % circle.cosine.size();
    return c * circle.cosine[k] + s * circle.sine[k];
  };
  const Vec3<N> a = towards(sector), b = towards(sector + 1);
  result.d1 = a * N(at.a1) + b * N(at.b1);
  result.d2 = a * N(at.a2) + b * N(at.b2);
  return result;
}

}  // namespace limitcheck::reference
