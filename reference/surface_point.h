// SPDX-License-Identifier: MIT
// What the evaluators return: a point of the limit surface with its derivatives.
#pragma once

#include <cstdint>

#include "reference/vec3.h"

namespace limitcheck::reference {

/// Where a normal comes from. Everything but kRegular is to be counted by whoever audits.   [D5, D12]
enum class NormalKind : std::uint8_t {
  kRegular,         ///< d1 x d2, or the tangent masks at a vertex
  kNoTangentPlane,  ///< boundary vertex of 6 or more faces: deep normals do not converge; the mask's
                    ///< direction is given
  kFallback,        ///< tangents (nearly) parallel or zero: area-weighted normal of the control faces around
  kArbitrary        ///< those vanish too: (0, 0, 1)
};

/// How much to compute.
enum class Order : std::uint8_t { kPosition, kFirst, kSecond };

/// A point of the limit surface at (face, l1, l2), l0 = 1 - l1 - l2 being the weight of corner 0.
///   position       the limit point
///   d1, d2         partial derivatives with respect to l1 and l2. Where `first_exist` is false (an
///                  extraordinary corner itself) they are the tangent masks' directions instead, ordered so
///                  that d1 x d2 is the outward normal:
///                  interior vertex, towards the face's own edges;
///                  boundary vertex, along x across
///   d11, d12, d22  second partial derivatives, zero where `second_exist` is false: not asked for, or at an
///                  extraordinary corner
///   normal         unit length, d1 x d2 direction, never NaN
template <class N>
struct SurfacePoint {
  Vec3<N> position, d1, d2, d11, d12, d22, normal;
  NormalKind normal_kind = NormalKind::kRegular;
  bool first_exist = false;
  bool second_exist = false;
};

}  // namespace limitcheck::reference
