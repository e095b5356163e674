// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "data/error.h"
#include "verify/picture/canvas.h"

namespace limitcheck::verify {
namespace {

using Vertex = fast::SurfaceVertex<float>;

/// Looks along -z from distance 1 so that a length of 1 in the plane z = 0 is 8 pixels; (0, 0) is the middle
/// of 16 x 16 pixels.
fast::Camera small_camera() {
  fast::Camera camera;
  camera.eye = {0, 0, 1};
  camera.width = camera.height = 16;
  camera.field_of_view = 90;
  return camera;
}

/// A point by the pixel coordinates it is seen at, y downwards; facing the viewer.
Vertex at(double x, double y, double z = 0) {
  const double scale = (1 - z) / 8;
  return {{static_cast<float>((x - 8) * scale), static_cast<float>((8 - y) * scale), static_cast<float>(z)},
          {0, 0, 1}};
}

std::int64_t shown(const Picture& p) {
  return std::count_if(p.shade.begin(), p.shade.end(), [](float s) { return s != Picture::kNothing; });
}

TEST(Canvas, CoversThePixelsWhoseMiddlesLieInsideATriangle) {
  Canvas canvas(small_camera());
  canvas.triangle(at(2, 2), at(2, 10),
                  at(10, 2));  // the half of a square of 8 x 8 pixels, above its diagonal
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const double away = x + y + 1 - 12;  // of the middle from the diagonal x + y = 12
      if (away == 0) continue;             // the rule for edges has its own test
      EXPECT_EQ(canvas.picture().at(x, y) != Picture::kNothing, x >= 2 && y >= 2 && away < 0)
          << x << " " << y;
    }
}

TEST(Canvas, LeavesNoPixelOutAndCoversNoneTwiceAlongSharedEdges) {
  // Two triangles that share a diagonal through middles of pixels, in each of four directions: between them
  // they cover the square, and no pixel belongs to both.
  const std::array corners{at(2.5, 2.5), at(2.5, 10.5), at(10.5, 10.5), at(10.5, 2.5)};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vertex &a = corners[k], &b = corners[(k + 1) % 4], &c = corners[(k + 2) % 4],
                 &d = corners[(k + 3) % 4];
    Canvas one(small_camera()), other(small_camera()), both(small_camera());
    one.triangle(a, b, c), other.triangle(a, c, d);
    both.triangle(a, b, c), both.triangle(a, c, d);
    EXPECT_EQ(shown(both.picture()), 64) << k;
    EXPECT_EQ(shown(one.picture()) + shown(other.picture()), 64) << k;
  }
}

TEST(Canvas, ShowsTheNearerSurfaceInAnyOrder) {
  Vertex near[3]{at(2, 2, .5), at(2, 10, .5), at(10, 2, .5)}, far[3]{at(2, 2), at(2, 10), at(10, 2)};
  for (auto& v : near) v.normal = {1, 0, 0};
  Canvas first(small_camera()), last(small_camera()), alone(small_camera());
  alone.triangle(near[0], near[1], near[2]);
  first.triangle(near[0], near[1], near[2]), first.triangle(far[0], far[1], far[2]);
  last.triangle(far[0], far[1], far[2]), last.triangle(near[0], near[1], near[2]);
  EXPECT_EQ(first.picture().shade, alone.picture().shade);
  EXPECT_EQ(last.picture().shade, alone.picture().shade);
}

TEST(Canvas, LeavesOutWhatIsSeenFromBehind) {
  Canvas canvas(small_camera());
  canvas.triangle(at(2, 2), at(10, 2), at(2, 10));
  EXPECT_EQ(shown(canvas.picture()), 0);
}

TEST(Canvas, ShadesWithTheInterpolatedNormalInPerspective) {
  // Normals turn from the one to the other side; the corners on the right are three times as far away, so the
  // middle of the surface is seen right of the middle of the screen: interpolation on the screen would be
  // off.
  const float s = std::sqrt(.5f);
  std::array<Vertex, 3> v{at(2, 2), at(2, 14), at(14, 8, -2)};
  v[0].normal = v[1].normal = {-s, 0, s}, v[2].normal = {s, 0, s};
  Canvas canvas(small_camera());
  canvas.triangle(v[0], v[1], v[2]);
  const int x = 9, y = 8;
  // On the screen (9.5 - 2) / 12 of the way; on the surface t with 1 / distance linear on the screen.
  const double screen = (x + .5 - 2) / 12, t = screen / 3 / ((1 - screen) + screen / 3);
  const double nx = (2 * t - 1) * std::sqrt(.5), nz = std::sqrt(.5);
  // light = (-0.35, 0.45, 1) / its length
  const double lit = (-.35 * nx + nz) / std::hypot(nx, nz) / std::sqrt(.35 * .35 + .45 * .45 + 1);
  // Corners are rounded to 1/4096 pixel, normals to float32.
  EXPECT_NEAR(canvas.picture().at(x, y), 255 * (.22 + .78 * lit), .02);
}

TEST(Canvas, RefusesWhatItCannotShow) {
  Canvas canvas(small_camera());
  EXPECT_THROW(canvas.triangle(at(2, 2), at(2, 10), {{0, 0, 2}, {0, 0, 1}}), data::ArgumentError);
  EXPECT_THROW(canvas.triangle(at(2, 2), at(2, 10), {{1e6f, 0, 0}, {0, 0, 1}}), data::ArgumentError);
  fast::Camera nowhere = small_camera();
  nowhere.target = nowhere.eye;
  EXPECT_THROW(Canvas{nowhere}, data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::verify
