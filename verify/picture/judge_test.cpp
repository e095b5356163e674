// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "data/generators/bumpy_sphere.h"
#include "verify/picture/judge.h"

namespace limitcheck::verify {
namespace {

TEST(Judge, SeesNoDifferenceToTheSameDepth) {
  const Judge judge(data::bumpy_sphere(60, 1), 3);
  const Seen seen = judge.see(uniform(3));
  EXPECT_EQ(seen.difference.share, 0);
  EXPECT_EQ(seen.difference.mean, 0);
  EXPECT_EQ(seen.triangles, 60 * 64);
  EXPECT_GT(seen.difference.pixels, 50'000);
}

// A facet's normals deviate from the surface's by the square of its size: a quarter for each level.
TEST(Judge, TheMedianErrorOfUniformDepthFallsByFourWithEachLevel) {
  const Judge judge(data::bumpy_sphere(60, 1), 7);
  double last = judge.see(uniform(3)).difference.median;
  for (int depth = 4; depth <= 5; ++depth) {
    const double median = judge.see(uniform(depth)).difference.median;
    EXPECT_NEAR(last / median, 4, .6) << depth;  // the truth has an error of its own, 1/16 of this at depth 5
    last = median;
  }
}

// Cracks are missing surface: what is drawn without repair looks worse than with it.
TEST(Judge, SeesCracks) {
  const Judge judge(data::bumpy_sphere(60, 1), 5);
  fast::DepthOptions random;
  random.strategy = fast::Strategy::kRandom;
  random.depth = 4;
  fast::CrackOptions none;
  none.repair = fast::Repair::kNone;
  EXPECT_GT(judge.see(random, none).difference.missing, judge.see(random).difference.missing);
}

}  // namespace
}  // namespace limitcheck::verify
