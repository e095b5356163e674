// SPDX-License-Identifier: MIT
// Local minima of the distance from a point to the limit surface.
#pragma once

#include "verify/projection/limit_surface.h"
#include "verify/projection/triangle.h"

namespace limitcheck::verify {

struct Minimum {
  FacePoint at;
  Vector position{};
  double distance = 0;
  bool stationary = false;
};

/// Descends from `start` to a local minimum of |s - p|.
/// `scale`: the size of the mesh, which says what counts as rounding. `quickly`: by Newton's iteration alone.
Minimum descend(const LimitSurface& surface, const Vector& p, const FacePoint& start, double scale,
                bool quickly = false);

}  // namespace limitcheck::verify
