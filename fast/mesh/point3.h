// SPDX-License-Identifier: MIT
// Points and directions of the set-up stages (camera, depth), always in double.
#pragma once

#include <array>
#include <cmath>

#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// What cameras and heuristics compute with.
using Point3 = Vec3<double>;

/// A control point as a vector.
constexpr Point3 to_point(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}
/// Euclidean.
inline double length(const Point3& a) {
  return std::sqrt(dot(a, a));
}
/// Whether no component is NaN or infinite.
inline bool is_finite(const Point3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace limitcheck::fast
