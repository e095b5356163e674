// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "verify/picture/curve.h"

namespace limitcheck::verify {
namespace {

TEST(Curve, FollowsAPowerLawThroughPointsInAnyOrder) {
  const std::vector<std::pair<double, double>> cubes{{4, 64}, {1, 1}, {2, 8}};
  EXPECT_DOUBLE_EQ(on_curve(cubes, 3).value(), 27);
  EXPECT_DOUBLE_EQ(on_curve(cubes, 1).value(), 1);
  EXPECT_DOUBLE_EQ(on_curve(cubes, 4).value(), 64);
}

TEST(Curve, SaysNothingOutsideItsPoints) {
  EXPECT_FALSE(on_curve({{1, 1}, {2, 8}}, .99));
  EXPECT_FALSE(on_curve({{1, 1}, {2, 8}}, 2.01));
  EXPECT_FALSE(on_curve({}, 1));
}

}  // namespace
}  // namespace limitcheck::verify
