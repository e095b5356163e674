// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "data/generators/bumpy_sphere.h"
#include "fast/window/tessellator.h"
#include "verify/picture/canvas.h"
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

TEST(Judge, TheViewerGoesRoundTheObject) {
  const auto expect = [](const fast::Camera& camera, double x, double z) {
    EXPECT_NEAR(camera.eye.x, x, 1e-12);
    EXPECT_EQ(camera.eye.y, 1);
    EXPECT_NEAR(camera.eye.z, z, 1e-12);
  };
  expect(viewer(0), 0, 4);
  expect(viewer(.25), 4, 0);
  expect(viewer(.5), 0, -4);
}

TEST(Judge, AFinerSphereAlsoMeansFinerAngles) {
  const fast::DepthOptions options = adaptive(fast::Strategy::kCombined, 60);
  EXPECT_EQ(options.strategy, fast::Strategy::kCombined);
  EXPECT_EQ(options.target_pixels, 60);
  EXPECT_EQ(options.angle_front, 30);
  EXPECT_EQ(options.angle_silhouette, 30);
  EXPECT_EQ(adaptive(fast::Strategy::kProjectSphere, 1000).angle_front, 180) << "no angle is larger";
  EXPECT_EQ(adaptive(fast::Strategy::kProjectSphere, 7.5).target_pixels, 7.5);
  EXPECT_EQ(adaptive(fast::Strategy::kProjectSphere, 7.5).strategy, fast::Strategy::kProjectSphere);
}

TEST(Judge, LooksFromBothSides) {
  const data::ControlMesh mesh = data::bumpy_sphere(60, 1);
  fast::Tessellator<float> engine(mesh);
  std::int64_t pixels = 0;
  for (const double turn : {0., .5}) {
    Canvas canvas(viewer(turn));
    engine.frame(uniform(3), viewer(turn), canvas);
    const Picture& p = canvas.picture();
    pixels += std::count_if(p.shade.begin(), p.shade.end(), [](float s) { return s != Picture::kNothing; });
  }
  EXPECT_EQ(Judge(mesh, 3).see(uniform(3)).difference.pixels, pixels);
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
