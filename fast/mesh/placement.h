// SPDX-License-Identifier: MIT
// Where the coordinates that an engine computes in lie among the caller's.
#pragma once

#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// position = centre + unit * x, the unit a power of two: a mesh about the origin and of size about 1, so
/// that squares neither vanish nor overflow and no digits are lost to a common offset.
template <class T>
struct Placement {
  T centre[3]{};
  T unit = T(1);

  bool is_identity() const {
    return unit == T(1) && centre[0] == T(0) && centre[1] == T(0) && centre[2] == T(0);
  }
  Vec3<T> operator()(const Vec3<T>& x) const { return unit * x + Vec3<T>{centre[0], centre[1], centre[2]}; }
};

}  // namespace limitcheck::fast
