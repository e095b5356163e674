// SPDX-License-Identifier: MIT
// A point of the limit surface: with its tangents, as the masks give it, and as the tessellators deliver it.
#pragma once

#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// Position and two tangents of the limit surface, all linear in the control points; du x dv points outward.
template <class N>
struct LimitFrame {
  Vec3<N> position, du, dv;
};

/// A point of the limit surface and its unit normal: 6 numbers, interleaved, as glVertexPointer and
/// glNormalPointer take them with a stride of sizeof(SurfaceVertex).
template <class N>
struct SurfaceVertex {
  Vec3<N> position, normal;
  friend constexpr bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};

}  // namespace limitcheck::fast
