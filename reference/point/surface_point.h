// SPDX-License-Identifier: MIT
// What the evaluators return: a point of the limit surface with its derivatives; and which of them the surface
// has at a vertex.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/number/vec3.h"

namespace limitcheck::reference {

// Which derivatives the surface has at a vertex, from the eigenvalues of its subdivision.
//
// A step halves the parameters, so that after J of them a mode of eigenvalue mu has a share of (2^d mu)^J in
// the derivatives of order d, unless it is a polynomial in the parameters on every face: then mu is 2^-degree
// and it has no share in derivatives above its degree and a constant one in those of it. The largest mu of
// the others decides. Each scheme lists the modes of each kind of vertex in its vertex_limit.h.

/// A part of the surface around a vertex that a step multiplies by its eigenvalue.
struct Mode {
  double eigenvalue = 0;
  int degree = 0;  ///< of the polynomial that it is on each face, 0 if it is none
};
/// Those below the 1 of the limit point, largest first, as far as they decide on two orders.
using LeadingModes = std::array<Mode, 3>;

/// Where the subdivision is that of a regular mesh.
inline constexpr LeadingModes kRegularModes{{{.5, 1}, {.25, 2}, {.125}}};

/// What becomes of the derivatives of one order towards a vertex, from within a face, for control points in
/// general.
enum class Fate : std::uint8_t {
  kValue,    ///< they tend to those of a polynomial
  kZero,     ///< they fall to zero: growth < 1 and no such polynomial
  kNoLimit,  ///< growth = 1: they depend on the direction, or grow like the logarithm of the distance
  kGrows     ///< growth > 1
};
/// What becomes of the derivatives of an order towards a vertex, and why.
struct DerivativeLimit {
  Fate fate = Fate::kValue;
  double eigenvalue = 0;  ///< that decides
  double growth = 0;  ///< 2^order eigenvalue: the factor of the derivatives, or of what they lack to their
                      ///< limit, for each halving of the distance
  bool exists() const { return fate <= Fate::kZero; }
};

constexpr DerivativeLimit derivative_limit(const LeadingModes& modes, int order) {
  constexpr double kSame = 1e-9;  // eigenvalues of different valences are farther from a power of two
  bool has_value = false;
  for (const Mode& mode : modes) {
    const double growth = mode.eigenvalue * (1 << order);
    if (mode.degree == order) has_value = true;
    if (mode.degree > 0 && mode.degree <= order) continue;
    const Fate fate = growth > 1 + kSame   ? Fate::kGrows
                      : growth > 1 - kSame ? Fate::kNoLimit
                      : has_value          ? Fate::kValue
                                           : Fate::kZero;
    return {fate, mode.eigenvalue, growth};
  }
  return {};
}

/// Of a vertex.
struct DerivativeLimits {
  DerivativeLimit first, second;
  bool along_boundary =
      false;  ///< on the boundary or a crease, which is a cubic B-spline: along it all exist

  constexpr DerivativeLimits() = default;
  constexpr DerivativeLimits(const LeadingModes& modes, bool has_boundary)
      : first(derivative_limit(modes, 1)), second(derivative_limit(modes, 2)), along_boundary(has_boundary) {}
};

/// Where a normal comes from. For all but kRegular the surface has no normal, or none that this number type
/// can tell from rounding; an audit counts these points.   [D5, D12]
enum class NormalKind : std::uint8_t {
  /// d1 x d2, or the tangent masks at a vertex.
  kRegular,
  /// A boundary vertex of 6 or more faces, where normals of ever finer levels do not converge. The normal is
  /// that of the tangent masks.
  kNoTangentPlane,
  /// The tangents are parallel or zero, but for rounding. The normal is the area-weighted normal of the
  /// control faces around.
  kFallback,
  /// That vanishes too. The normal is (0, 0, 1).
  kArbitrary
};

/// How much to compute.
enum class Derivatives : std::uint8_t { kPosition, kFirst, kSecond };
using Order = Derivatives;  ///< its name in 0.1

/// A point of the limit surface at (face, l1, l2), l0 = 1 - l1 - l2 being the weight of corner 0.
///   position       the limit point
///   d1, d2         partial derivatives with respect to l1 and l2, if `first_exist`; otherwise t1, t2
///   d11, d12, d22  second partial derivatives, zero if not `second_exist`: not asked for, or not there
///   t1, t2         two directions in the tangent plane, t1 x t2 outwards. They are d1, d2 except at an
///                  extraordinary corner, where the tangent masks give them, about as long as control edges.
///                  Interior vertex: towards the face's own edges; equal to them where the ring is a regular
///                  polygon. Boundary vertex: along and across; both 1 for half a unit disc
///   normal         unit length, in the direction of t1 x t2, never NaN
///   at_corner      whether the point is an extraordinary corner
///   t1_terms, t2_terms
///                  sum of |weight| magnitude(point) that t1, t2 were summed from, in their units: a relative
///                  error u of the points moves t1 by some u * t1_terms, however small t1 is
///   normal_condition
///                  a relative error u of the points turns the normal by some u * normal_condition radians,
///                  to first order: (t1_terms / |t1| + t2_terms / |t2|) / sin(t1, t2), with the tangents that
///                  the normal was computed from, which near a boundary corner are better separated than t1,
///                  t2. 0 where the normal is not regular. In number types without rounding these three are 0
///   limits         at an extraordinary corner: which derivatives exist, and why (vertex_limit.h of each
///                  scheme), from within the face, for control points in general; where tangents vanish more
///                  may exist. In exact rationals Catmull-Clark's are not computed there
template <class N>
struct SurfacePoint {
  Vec3<N> position, d1, d2, d11, d12, d22, t1, t2, normal;
  N t1_terms{}, t2_terms{}, normal_condition{};
  NormalKind normal_kind = NormalKind::kRegular;
  bool first_exist = false;
  bool second_exist = false;
  bool at_corner = false;
  DerivativeLimits limits{};
};

/// Of the vertices of a refined mesh.
template <class N>
struct VertexLimits {
  std::vector<Vec3<N>> positions, normals;  ///< normals of unit length
  std::vector<NormalKind> kinds;

  void add(const Vec3<N>& position, const Vec3<N>& normal, NormalKind kind) {
    positions.push_back(position), normals.push_back(normal), kinds.push_back(kind);
  }
};

/// A corner of a leaf of a recursive subdivider: lattice point (i, j) of its face.
template <class N>
struct LeafCorner {
  Vec3<N> position, normal;
  NormalKind normal_kind;
  std::int32_t i, j;
};

/// Turns derivatives by the parameters of a piece into those by the parameters of the whole, whose sides are
/// `factor` times as long.
template <class N>
void scale_derivatives(SurfacePoint<N>& point, const N& factor) {
  const N second = factor * factor;
  for (auto* d : {&point.d1, &point.d2, &point.t1, &point.t2}) *d *= factor;
  for (auto* d : {&point.d11, &point.d12, &point.d22}) *d *= second;
  point.t1_terms *= factor;
  point.t2_terms *= factor;
}

}  // namespace limitcheck::reference
