// SPDX-License-Identifier: MIT
// The build must round where the source says so: g++ 12 with its basic-block vectoriser does not.
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace {

[[gnu::noinline]] void round_to_float(std::vector<std::array<double, 3>>& points) {
  for (auto& point : points) {
    for (double& x : point) x = static_cast<float>(x);
  }
}

TEST(Build, RoundsEveryCoordinateToFloat) {
  std::vector<std::array<double, 3>> points(10, {0.1, 0.1, 0.1});
  round_to_float(points);
  for (const auto& point : points) {
    for (const double x : point) EXPECT_EQ(x, 0x1.99999ap-4);
  }
}

}  // namespace
