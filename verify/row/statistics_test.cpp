// SPDX-License-Identifier: MIT
#include "verify/row/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

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

// A stored row whose status was altered, or whose numbers were, does not say any more what its numbers say.
TEST(Verdict, OfARowIsWhatItsNumbersSay) {
  using enum Status;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const struct {
    Status stored;
    std::int64_t bad, of;
    std::optional<double> worst, bound;
    Status verdict;
  } rows[] = {{kHeld, 0, 9, 1e-15, 1e-14, kHeld},
              {kHeld, 0, 9, 1e-14, 1e-14, kHeld},
              {kHeld, 0, 0, {}, 0, kHeld},  // as t-vertices, where there is no open edge
              {kHeld, 0, 9, .5, 1e-14, kFinding},
              {kHeld, 0, 9, none, 1e-14, kFinding},
              {kHeld, 1, 9, 1e-15, 1e-14, kFinding},
              {kFinding, 1, 9, {}, 1e-14, kFinding},  // the worst is not finite
              {kFinding, 1, 9, 0, 0, kFinding},       // zeros of another sign
              {kFinding, 0, 9, 1e-15, 1e-14, kHeld},
              {kQualityWarning, 3, 9, {}, 0, kQualityWarning},
              {kQualityWarning, 0, 9, 2, 1, kFinding},
              {kUnexpectedPass, 0, 9, 2, 1, kFinding},
              {kNotRun, 0, 0, {}, {}, kNotRun},
              {kNotRun, 0, 9, {}, {}, kHeld},
              {kNotRun, 2, 9, {}, {}, kFinding},
              {kNotSupported, 1, 1, {}, 0, kNotSupported},  // a request of several
              {kWaived, 1, 9, .5, 1e-14, kWaived},
              {kCrash, 0, 0, {}, {}, kCrash}};
  for (const auto& [stored, bad, of, worst, bound, verdict] : rows) {
    Result r;
    r.status = stored, r.bad = bad, r.of = of, r.worst = worst, r.bound = bound;
    EXPECT_EQ(word(verdict_of(r)), word(verdict)) << word(stored) << ": " << bad << " of " << of;
  }
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
