// SPDX-License-Identifier: MIT
// Where a surface turns so fast that rounding of a position shows in its normal.
#pragma once

#include "verify/projection/closest_point.h"

namespace limitcheck::verify {

/// The smallest angle, in degrees, between a direction and the normals of points of the surface within
/// `radius` of a foot: a position that was rounded by so much may have been any of them. A descent in the
/// parameters, which ends when the angle is at most `enough`, or as soon as the surface is seen not to turn.
double least_angle_nearby(const ClosestPoint& surface, const Foot& foot, const Vector& direction,
                          double radius, double enough);

}  // namespace limitcheck::verify
