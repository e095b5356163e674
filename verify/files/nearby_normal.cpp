// SPDX-License-Identifier: MIT
#include "verify/files/nearby_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limitcheck::verify {

double least_angle_nearby(const ClosestPoint& surface, const Foot& foot, const Vector& direction,
                          double radius, double enough) {
  constexpr int kDirections = 8, kSteps = 64;
  constexpr double kWorthIt = 1e-3;  // of what is missing, gained by the first step
  double angle = angle_degrees(direction, foot.normal);
  const auto tangents = surface.surface().evaluate(foot.at, reference::Order::kFirst);
  const double speed = std::max(norm(vector_of(tangents.d1)), norm(vector_of(tangents.d2)));
  double step = speed > 0 ? std::min(radius / speed, .25) : .25;
  FacePoint best = foot.at;
  for (int i = 0; i < kSteps && angle > enough; ++i) {
    double least = angle;
    FacePoint there = best;
    for (int k = 0; k < kDirections; ++k) {
      const double turn = 2 * std::numbers::pi * k / kDirections, a = step * std::cos(turn),
                   b = step * std::sin(turn);
      const FacePoint at = surface.domain().walk(best, {-a - b, a, b});
      const Foot other = surface.at(at, foot.position);
      if (!other.has_normal || other.distance > radius) continue;
      const double its = angle_degrees(direction, other.normal);
      if (its < least) least = its, there = at;
    }
    if (i == 0 && angle - least < kWorthIt * (angle - enough)) return angle;
    step *= least < angle ? 2 : .5;
    angle = least, best = there;
  }
  return angle;
}

}  // namespace limitcheck::verify
