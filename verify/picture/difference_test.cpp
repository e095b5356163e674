// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/error.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/window/tessellator.h"
#include "verify/picture/canvas.h"
#include "verify/picture/judge.h"

namespace limitcheck::verify {
namespace {

constexpr int kWidth = 20, kHeight = 10;

/// A rectangle of one shade before nothing.
Picture rectangle(int x0, int y0, int x1, int y1, float shade = 100) {
  Picture p{kWidth, kHeight, std::vector<float>(kWidth * kHeight, Picture::kNothing)};
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) p.shade[y * kWidth + x] = shade;
  return p;
}

Difference difference(const Picture& truth, const Picture& seen) {
  DifferenceMeter meter;
  meter.add(truth, seen);
  return meter.result();
}

TEST(Difference, CountsWhatIsMissingAndWhatIsExtra) {
  Picture holed = rectangle(2, 2, 12, 8);
  for (const int x : {5, 6, 7})
    for (const int y : {4, 5}) holed.shade[y * kWidth + x] = Picture::kNothing;
  holed.shade[2 * kWidth + 11] = Picture::kNothing;  // and a pixel apart from it
  struct {
    const char* what;
    Picture truth, seen;
    std::int64_t pixels, missing, extra, largest_gap;
    double contour;
  } const all[]{
      {"itself", rectangle(2, 2, 12, 8), rectangle(2, 2, 12, 8), 60, 0, 0, 0, 0},
      {"a hole, each pixel of it beside one that is drawn", rectangle(2, 2, 12, 8), holed, 60, 7, 0, 6, 1},
      {"moved", rectangle(2, 2, 12, 8), rectangle(5, 2, 15, 8), 78, 18, 18, 18, 3},
      {"(11, 7) from (8, 3): 3, 4 and 5", rectangle(2, 2, 12, 8), rectangle(2, 2, 9, 4), 60, 46, 0, 46, 5},
      {"only what is missing is a gap", rectangle(0, 0, 4, 4), rectangle(2, 0, 9, 4), 36, 8, 20, 8, 5}};
  for (const auto& of : all) {
    const Difference d = difference(of.truth, of.seen);
    EXPECT_EQ(d.pixels, of.pixels) << of.what;
    EXPECT_EQ(d.missing, of.missing) << of.what;
    EXPECT_EQ(d.extra, of.extra) << of.what;
    EXPECT_EQ(d.largest_gap, of.largest_gap) << of.what;
    EXPECT_DOUBLE_EQ(d.contour, of.contour) << of.what;
    const double share = static_cast<double>(of.missing + of.extra) / static_cast<double>(of.pixels);
    EXPECT_DOUBLE_EQ(d.share, share) << of.what;
    EXPECT_DOUBLE_EQ(d.mean, 255 * share) << of.what;
    EXPECT_EQ(d.median, share > .5 ? 255 : 0) << of.what;
    EXPECT_EQ(d.percentile_99, share > .01 ? 255 : 0) << of.what;
  }
}

TEST(Difference, ContourLooksOnAfterTheFirstPixelFound) {
  // (10, 5) is missing; of what is drawn the corner (7, 2) is found first, 3 away either way, (6, 5) is nearer.
  Picture truth = rectangle(7, 2, 8, 3), seen = truth;
  truth.shade[5 * kWidth + 6] = seen.shade[5 * kWidth + 6] = 100;
  truth.shade[5 * kWidth + 10] = 100;
  EXPECT_EQ(difference(truth, seen).contour, 4);
  for (const int x : {1, 7})
    for (const int y : {1, 7})
      EXPECT_DOUBLE_EQ(difference(rectangle(4, 4, 5, 5), rectangle(x, y, x + 1, y + 1)).contour,
                       std::hypot(3, 3));
  EXPECT_DOUBLE_EQ(difference(rectangle(0, 0, 1, 1), rectangle(19, 9, 20, 10)).contour, std::hypot(19, 9));
  EXPECT_DOUBLE_EQ(difference(rectangle(0, 0, 1, 1), rectangle(0, 0, 0, 0)).contour, std::hypot(20, 10))
      << "nothing is drawn";
}

TEST(Difference, TheLargestGapIsConnectedAlongSidesInEveryDirection) {
  const char* const shape[] = {"..#.....#...........",  //
                               "..#..####.......####",  // the right end of a row is not beside
                               "..#..#..#.......#..#",  // the left one of the next
                               "######.##.......#.##",  //
                               "...............##..."};
  const Picture truth = rectangle(0, 0, kWidth, kHeight);
  Picture seen = truth;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < kWidth; ++x)
      if (shape[y][x] == '#') seen.shade[y * kWidth + x] = Picture::kNothing;
  EXPECT_EQ(difference(truth, seen).largest_gap, 18);
}

TEST(Difference, CountsShadesThatDifferByMoreThanFour) {
  const Picture truth = rectangle(2, 2, 12, 8);
  EXPECT_EQ(difference(truth, rectangle(2, 2, 12, 8, 104)).share, 0);
  const Difference d = difference(truth, rectangle(2, 2, 12, 8, 105));
  EXPECT_EQ(d.share, 1);
  EXPECT_EQ(d.mean, 5);
  EXPECT_EQ(d.median, 5);
}

TEST(Difference, TheMedianOfThreeIsTheMiddleOne) {
  const Picture truth = rectangle(0, 0, 3, 1);
  Picture seen = truth;
  seen.shade[0] -= 7, seen.shade[1] += 2, seen.shade[2] += 3;
  EXPECT_EQ(difference(truth, seen).median, 3);
  EXPECT_EQ(difference(truth, seen).mean, 4);
}

TEST(Difference, QuantilesAreThoseOfTheSortedErrors) {
  Picture truth{101, 1, std::vector<float>(101, 100)};
  Picture seen = truth;
  for (int x = 0; x < 101; ++x) seen.shade[x] += static_cast<float>((x * 37) % 101);  // 0 .. 100 in disorder
  EXPECT_EQ(difference(truth, seen).median, 50);
  EXPECT_EQ(difference(truth, seen).percentile_99, 99);
}

TEST(Difference, TheWorstCountsNotTheLast) {
  const Picture one = rectangle(0, 0, 1, 1);
  Picture two = one;
  two.shade[9] = two.shade[2 * kWidth] = 100;  // (9, 0), found first, lies farther away than (0, 2)
  EXPECT_EQ(difference(two, one).contour, 9);
  DifferenceMeter meter;
  meter.add(rectangle(0, 0, 8, 8), rectangle(0, 0, 5, 5));
  meter.add(rectangle(0, 0, 8, 8), rectangle(0, 0, 8, 7));
  EXPECT_EQ(meter.result().largest_gap, 64 - 25);
  EXPECT_DOUBLE_EQ(meter.result().contour, std::hypot(3, 3));
}

TEST(Difference, TakesPairsTogether) {
  DifferenceMeter meter;
  meter.add(rectangle(0, 0, 10, 10), rectangle(0, 0, 10, 10));
  meter.add(rectangle(0, 0, 10, 10), rectangle(0, 0, 10, 10, 110));
  EXPECT_EQ(meter.result().pixels, 200);
  EXPECT_DOUBLE_EQ(meter.result().mean, 5);
}

TEST(Difference, WantsPicturesOfOneSize) {
  Picture other = rectangle(2, 2, 12, 8);
  other.width = kHeight, other.height = kWidth;
  DifferenceMeter meter;
  EXPECT_THROW(meter.add(rectangle(2, 2, 12, 8), other), data::ArgumentError);
}

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
  fast::DepthOptions random{.strategy = fast::Strategy::kRandom, .depth = 4};
  fast::CrackOptions none{.repair = fast::Repair::kNone};
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
