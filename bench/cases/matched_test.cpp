// SPDX-License-Identifier: MIT
// Whether speed at equal error asks for the error that it says.
#include "bench/cases/matched.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "fast/stream/stream_tessellator.h"

namespace {

using namespace limitcheck;

struct Shot {
  data::ControlMesh mesh;
  data::Scheme scheme;
  fast::DrawList<float> frame;
};

Shot frame_of(data::Scheme scheme, int depth) {
  Shot shot{scheme == data::Scheme::kLoop ? data::bumpy_sphere(200, 1) : data::pawn(8), scheme, {}};
  fast::row_stream::StreamTessellator(shot.mesh, {.provenance = true, .scheme = scheme})
      .frame(std::vector<std::int32_t>(shot.mesh.faces.size(), depth), shot.frame);
  return shot;
}

class EqualError : public testing::TestWithParam<data::Scheme> {
 protected:
  static double pixels_of(const Shot& shot) {
    return bench::pixel_error(shot.mesh, shot.scheme, fast::Camera{}, shot.frame);
  }
};

TEST_P(EqualError, OfPointsHoldsForOurFloatsAndSeesOnePointMovedOrTurned) {
  Shot shot = frame_of(GetParam(), 3);
  const bench::PointBound bound, ours = bench::worst_errors(shot.mesh, shot.scheme, shot.frame);
  EXPECT_LT(ours.position, bound.position);
  EXPECT_LT(ours.normal, bound.normal);
  auto& vertex = shot.frame.vertices[shot.frame.vertices.size() / 2];
  const auto saved = vertex;
  vertex.position.x += 1e-4F;
  EXPECT_GT(bench::worst_errors(shot.mesh, shot.scheme, shot.frame).position, bound.position);
  vertex = saved;
  std::swap(vertex.normal.x, vertex.normal.y);
  EXPECT_GT(bench::worst_errors(shot.mesh, shot.scheme, shot.frame).normal, bound.normal);
  vertex.normal.z = std::nanf("");
  EXPECT_FALSE(bench::worst_errors(shot.mesh, shot.scheme, shot.frame).normal <= bound.normal);
}

/// Each level quarters the distance of a triangle's middle from the surface.
TEST_P(EqualError, OfPixelsFallsWithTheSquareOfTheSteps) {
  const double coarse = pixels_of(frame_of(GetParam(), 2)), fine = pixels_of(frame_of(GetParam(), 4));
  EXPECT_GT(coarse / fine, 8);
  EXPECT_LT(coarse / fine, 24);
}

/// A point at distance z moves by x focal_pixels() / z pixels if it is moved aside by x.
TEST_P(EqualError, OfPixelsIsThatOfAFrameMovedAside) {
  Shot shot = frame_of(GetParam(), 5);
  const fast::Camera camera;
  const double before = pixels_of(shot), aside = .01;
  double nearest = camera.eye.z, farthest = 0;
  for (auto& v : shot.frame.vertices) {
    const double distance = camera.eye.z - static_cast<double>(v.position.z);
    nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
    v.position.x += static_cast<float>(aside);
  }
  EXPECT_GT(pixels_of(shot), aside * camera.focal_pixels() / farthest - before);
  EXPECT_LT(pixels_of(shot), aside * camera.focal_pixels() / nearest + before);
}

TEST_P(EqualError, IsNotKeptByAFrameOfNothingOrWithANaN) {
  Shot shot = frame_of(GetParam(), 2);
  shot.frame.vertices[shot.frame.vertices.size() / 2].position.y = std::nanf("");
  EXPECT_FALSE(pixels_of(shot) <= 1e9);
  EXPECT_FALSE(bench::worst_errors(shot.mesh, shot.scheme, shot.frame).position <= 1e9);
  shot.frame = {};
  EXPECT_FALSE(pixels_of(shot) <= 1e9);
  EXPECT_FALSE(bench::worst_errors(shot.mesh, shot.scheme, shot.frame).position <= 1e9);
}

INSTANTIATE_TEST_SUITE_P(Schemes, EqualError,
                         testing::Values(data::Scheme::kLoop, data::Scheme::kCatmullClark),
                         [](const auto& tested) {
                           return tested.param == data::Scheme::kLoop ? "Loop" : "CatmullClark";
                         });

TEST(MatchingTarget, IsTheCoarsestThatIsFineEnough) {
  // 16 pixels have an error of 1/2.
  EXPECT_DOUBLE_EQ(bench::matching_target(.5, [](double target) { return target / 32; }), 16);
  EXPECT_DOUBLE_EQ(bench::matching_target(.5, [](double target) { return target / 31; }), std::exp2(15 / 4.));
  // Twice the error in all settings: half the target.
  EXPECT_DOUBLE_EQ(bench::matching_target(.5, [](double target) { return target / 16; }), 8);
  // Errors that no setting brings down, and that all settings keep.
  EXPECT_EQ(bench::matching_target(.5, [](double) { return 1.; }), 0);
  EXPECT_EQ(bench::matching_target(.5, [](double) { return std::nan(""); }), 0);
  EXPECT_DOUBLE_EQ(bench::matching_target(.5, [](double) { return 0.; }), 256);
}

}  // namespace
