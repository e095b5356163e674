// SPDX-License-Identifier: MIT
#include "verify/row/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "verify/evidence/vector.h"

namespace limitcheck::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Statistics, WorstRmsAndTheNinetyNinthPercentile) {
  std::vector<double> errors;
  for (int k = 1; k <= 200; ++k) errors.push_back(k);
  const Statistics s = summarise(errors, 150);
  EXPECT_EQ(s.of, 200);
  EXPECT_EQ(s.bad, 50);
  EXPECT_EQ(s.worst_at, 199);
  EXPECT_EQ(s.worst, 200);
  EXPECT_EQ(s.p99, 198);
  EXPECT_DOUBLE_EQ(*s.rms, std::sqrt(201 * 401 / 6.0));
}

TEST(Statistics, WhatCouldNotBeMeasuredIsBadAndTheWorst) {
  const Statistics s = summarise({1, kInfinity, -1, 2}, 10);
  EXPECT_EQ(s.of, 3);
  EXPECT_EQ(s.bad, 1);
  EXPECT_EQ(s.worst_at, 1);
  EXPECT_FALSE(s.worst.has_value());
  EXPECT_EQ(s.p99, 2);
}

TEST(Statistics, NothingLookedAtIsNoConfirmation) {
  const Statistics s = summarise({-1, -1}, 0);
  EXPECT_EQ(s.of, 0);
  EXPECT_EQ(s.worst_at, -1);
  EXPECT_FALSE(s.rms.has_value());
}

TEST(Angle, IsAccurateNearZeroAndNearAHalfTurn) {
  const double tiny = 1e-12;
  EXPECT_NEAR(angle_degrees({1, 0, 0}, {2 * std::cos(tiny), 2 * std::sin(tiny), 0}) / 57.295779513082320877,
              tiny, 1e-22);
  EXPECT_EQ(angle_degrees({0, 3, 0}, {0, -1, 0}), 180);
  EXPECT_NEAR(angle_degrees({0, 0, 1}, {0, 1, 0}), 90, 1e-13);
  EXPECT_EQ(angle_degrees({0, 0, 0}, {0, 1, 0}), kInfinity);
}

}  // namespace
}  // namespace limitcheck::verify
