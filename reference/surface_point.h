// SPDX-License-Identifier: MIT
// What the evaluators return: a point of the limit surface with its derivatives.
#pragma once

#include <cstdint>

#include "reference/vec3.h"

namespace limitcheck::reference {

/// Where a normal comes from. Everything but kRegular is to be counted by whoever audits: there the surface
/// has no normal, or none that this number type can tell from rounding.                     [D5, D12]
enum class NormalKind : std::uint8_t {
  kRegular,         ///< d1 x d2, or the tangent masks at a vertex
  kNoTangentPlane,  ///< boundary vertex of 6 or more faces: deep normals do not converge; the mask's
                    ///< direction is given
  kFallback,        ///< tangents parallel or zero, but for rounding: area-weighted normal of the control
                    ///< faces around
  kArbitrary        ///< those vanish too: (0, 0, 1)
};

/// How much to compute.
enum class Order : std::uint8_t { kPosition, kFirst, kSecond };

/// A point of the limit surface at (face, l1, l2), l0 = 1 - l1 - l2 being the weight of corner 0.
///   position       the limit point
///   d1, d2         partial derivatives with respect to l1 and l2. Where `first_exist` is false (an
///                  extraordinary corner itself) they are the tangent masks' directions instead, ordered so
///                  that d1 x d2 is the outward normal, and as long as the control edges:
///                  interior vertex, towards the face's own edges, and those edges themselves where the ring
///                  is a regular polygon;
///                  boundary vertex, along x across, both 1 for half a unit disc
///   d1_terms, d2_terms   sum of |weight| magnitude(point) that d1, d2 were summed from, in their units: a
///                  relative error u of the points moves d1 by some u * d1_terms, however small d1 is
///   normal_condition     a relative error u of the points turns the normal by some u * normal_condition
///                  radians, to first order: (d1_terms / |d1| + d2_terms / |d2|) / sin(d1, d2), with the
///                  tangents that the normal was computed from, which near a boundary corner are better
///                  separated than d1, d2. All three are 0 in number types without rounding, and
///                  normal_condition where the normal is not regular
///   d11, d12, d22  second partial derivatives, zero where `second_exist` is false: not asked for, or at an
///                  extraordinary corner
///   normal         unit length, d1 x d2 direction, never NaN
template <class N>
struct SurfacePoint {
  Vec3<N> position, d1, d2, d11, d12, d22, normal;
  N d1_terms{}, d2_terms{}, normal_condition{};
  NormalKind normal_kind = NormalKind::kRegular;
  bool first_exist = false;
  bool second_exist = false;
};

}  // namespace limitcheck::reference
