// SPDX-License-Identifier: MIT
// The two-sided Hausdorff distance between triangles and the limit surface, between proved bounds.
#pragma once

#include <functional>
#include <span>

#include "verify/projection/closest_point.h"

namespace limitcheck::verify {

/// A distance that lies between two numbers.
struct Bracket {
  double at_least = 0, at_most = 0;
  Vector where{};           // a point at which the distance is at_least
  std::int64_t index = -1;  // the triangle or the control face it lies on
};

struct Hausdorff {
  Bracket from_triangles;  // max over the triangles of the distance to the surface
  Bracket from_surface;    // max over the surface of the distance to the triangles
  bool bracketed = true;   // at_least >= (1 - tightness) at_most was reached in both
};

/// The distance between the triangles (finite corners, one at least) and the surface.
///   lower bounds  exact distances at points: corners, middles of edges and pieces
///   upper bounds  for a flat piece A and a flat piece B, max over A of the distance to B is taken at a
///   corner of A, since
///                 the distance to a convex set is convex; a piece of the surface deviates from its flat
///                 triangle by no more than patch_bound.h proves. Pieces whose bound is above the largest
///                 lower bound are split in four, until the bounds are within `tightness` of each other or 8
///                 levels deep
///   rounding      1e-15 of the mesh is not accounted for
Hausdorff hausdorff(const ClosestPoint& surface, std::span<const std::array<Vector, 3>> triangles,
                    double tightness = .05,
                    const std::function<void(std::size_t, std::size_t)>& on_step = {});

}  // namespace limitcheck::verify
