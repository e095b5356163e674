// SPDX-License-Identifier: MIT
#include "verify/files/checks/nearby_normal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limitcheck::verify {

namespace {

// Steps in the parameters that move a point by `radius` in the direction in which it moves fastest, and in the
// one in which it moves slowest: the axes of an ellipse, which is long where tangents are nearly parallel.
struct Axes {
  double fast[2], slow[2];

  Axes(const LimitSurface& surface, const FacePoint& at, double radius) {
    const auto p = surface.evaluate(at, reference::Order::kFirst);
    const Vector d1 = vector_of(p.t1), d2 = vector_of(p.t2);
    const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
    const double turn = std::atan2(2 * b, a - c) / 2, middle = (a + c) / 2,
                 spread = std::hypot((a - c) / 2, b);
    const auto length = [&](double square) {
      constexpr double kMost = .25;  // of a face
      return square * kMost * kMost > radius * radius ? radius / std::sqrt(square) : kMost;
    };
    const double most = length(middle + spread), least = length(middle - spread);
    fast[0] = most * std::cos(turn), fast[1] = most * std::sin(turn);
    slow[0] = -least * std::sin(turn), slow[1] = least * std::cos(turn);
  }
};

}  // namespace

double least_angle_nearby(const ClosestPoint& surface, const Foot& foot, const Vector& direction,
                          double radius, double enough) {
  constexpr int kDirections = 8, kSteps = 64;
  constexpr int kSeen = 12;          // steps after which it is seen: where tangents are nearly parallel the
                                     // surface bends away long before the end of a slow one
  constexpr double kWorthIt = 1e-3;  // of what is missing, gained by a step, or by all of these
  const double first = angle_degrees(direction, foot.normal);
  double angle = first, scale = .5;
  FacePoint best = foot.at;
  for (int i = 0; i < kSteps && angle > enough; ++i) {
    const Axes axes(surface.surface(), best, radius);
    double least = angle;
    FacePoint there = best;
    for (int k = 0; k < kDirections; ++k) {
      const double turn = 2 * std::numbers::pi * k / kDirections, c = scale * std::cos(turn),
                   s = scale * std::sin(turn);
      const double x = c * axes.fast[0] + s * axes.slow[0], y = c * axes.fast[1] + s * axes.slow[1];
      const FacePoint at = surface.domain().walk(best, {-x - y, x, y});
      const Foot other = surface.at(at, foot.position);
      if (!other.has_normal || other.distance > radius) continue;
      const double its = angle_degrees(direction, other.normal);
      if (its < least) least = its, there = at;
    }
    if (i == kSeen && first - least < kWorthIt * (first - enough)) return least;
    scale = angle - least > kWorthIt * (angle - enough) ? std::min(1., 2 * scale) : scale / 2;
    angle = least, best = there;
  }
  return angle;
}

}  // namespace limitcheck::verify
