// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data/error.h"
#include "verify/picture/canvas.h"

namespace limitcheck::verify {
namespace {

using Vertex = fast::SurfaceVertex<float>;

/// Looks along -z from distance 1 so that a length of 1 in the plane z = 0 is 8 pixels; (0, 0) is the middle
/// of 16 x 16 pixels.
fast::Camera small_camera() {
  return {.eye = {0, 0, 1}, .field_of_view = 90, .width = 16, .height = 16};
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

/// What light from above the left shoulder makes of a normal that is seen head on; n need not be a unit vector.
double shade_of(double nx, double ny, double nz) {
  const double lit = (-.35 * nx + .45 * ny + nz) / std::hypot(nx, ny, nz) / std::hypot(.35, .45, 1);
  return 255 * (.22 + .78 * std::max(0., lit));
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

// One over the distance is linear on the screen: a slope and a plane that meet along x = 6 hide each other on
// either side of it.
TEST(Canvas, ShowsTheNearerOfTwoSurfacesThatCross) {
  const auto distance = [](double x) { return 2 / (1 + (x - 6) / 8); };  // of the slope from the viewer
  const auto slope = [&](double x, double y) { return at(x, y, 1 - distance(x)); };
  const Vertex slope_corner[3]{slope(2, 2), slope(2, 14), slope(14, 5)};
  for (const int turned : {0, 1, 2, 3, 4, 5}) {
    const bool first = turned < 3;
    Canvas canvas(small_camera());
    const auto sloping = [&] {
      canvas.triangle(slope_corner[turned % 3], slope_corner[(turned + 1) % 3],
                      slope_corner[(turned + 2) % 3]);
    };
    Vertex flat[3]{at(2, 2, -1), at(2, 14, -1), at(14, 5, -1)};
    for (Vertex& v : flat) v.normal = {1, 0, 0};
    if (first) sloping();
    canvas.triangle(flat[0], flat[1], flat[2]);
    if (!first) sloping();
    EXPECT_NEAR(canvas.picture().at(4, 6), shade_of(1, 0, 0), 1e-4) << turned;
    EXPECT_NEAR(canvas.picture().at(7, 6), shade_of(0, 0, 1), 1e-4) << turned;
  }
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
  // Corners are rounded to 1/4096 pixel, normals to float32.
  EXPECT_NEAR(canvas.picture().at(x, y), shade_of(nx, 0, nz), .02);
}

TEST(Canvas, IsLitFromAboveTheLeftShoulder) {
  for (const auto& n :
       {std::array{0, 0, 1}, {0, 1, 1}, {0, -1, 1}, {1, 0, 1}, {-1, 0, 1}, {-1, 2, 0}, {0, -1, 0}}) {
    std::array<Vertex, 3> v{at(2, 2), at(2, 14), at(14, 8)};
    for (Vertex& corner : v)
      corner.normal = {static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
    Canvas canvas(small_camera());
    canvas.triangle(v[0], v[1], v[2]);
    EXPECT_NEAR(canvas.picture().at(5, 8), shade_of(n[0], n[1], n[2]), 1e-4) << n[0] << n[1] << n[2];
  }
}

// The view from above: the surface turned with the viewer about the x axis looks as before.
TEST(Canvas, SeesTheSameFromAnyDirection) {
  const auto turned = [](const fast::Vec3<float>& v, double shift) {  // by a right triangle of 3, 4 and 5
    const double z = static_cast<double>(v.z) - shift, y = v.y;
    return fast::Vec3<float>{v.x, static_cast<float>(.8 * y + .6 * z), static_cast<float>(.8 * z - .6 * y)};
  };
  fast::Camera above = small_camera();
  above.eye = {0, 3, 4};
  std::array<Vertex, 3> v{at(2.3, 2.1), at(4.2, 13.7, .2), at(13.6, 8.3, -.5)};
  v[0].normal = {0, 1, 1}, v[1].normal = {1, 0, 1}, v[2].normal = {-1, -1, 1};
  Canvas before(small_camera()), after(above);
  before.triangle(v[0], v[1], v[2]);
  for (Vertex& corner : v) corner = {turned(corner.position, -4), turned(corner.normal, 0)};
  after.triangle(v[0], v[1], v[2]);
  for (std::size_t p = 0; p < before.picture().shade.size(); ++p)
    EXPECT_NEAR(before.picture().shade[p], after.picture().shade[p], .02) << p;
  EXPECT_GT(shown(before.picture()), 30);
}

TEST(Canvas, CutsOffWhatLiesBesideThePicture) {
  struct {
    double left, top, right, bottom;
    std::int64_t pixels;
  } const all[]{{-5, 3, 4, 6, 12},     {12, 3, 30, 6, 12}, {3, -9, 6, 4, 12},  {3, 12, 6, 20, 12},
                {-9, -9, 30, 30, 256}, {-9, 3, -2, 6, 0},  {20, 20, 25, 25, 0}};
  for (const auto& r : all) {
    const Vertex a = at(r.left, r.top), b = at(r.left, r.bottom), c = at(r.right, r.bottom),
                 d = at(r.right, r.top);
    Canvas canvas(small_camera());
    canvas.triangle(a, b, c), canvas.triangle(a, c, d);
    EXPECT_EQ(shown(canvas.picture()), r.pixels) << r.left << ' ' << r.top;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        EXPECT_EQ(canvas.picture().at(x, y) != Picture::kNothing,
                  x + .5 > r.left && x + .5 < r.right && y + .5 > r.top && y + .5 < r.bottom);
  }
}

TEST(Canvas, GivesMiddlesOnAnEdgeToWhatIsRightOfItOrBelow) {
  const Vertex a = at(2.5, 2.5), b = at(2.5, 10.5), c = at(10.5, 10.5), d = at(10.5, 2.5);
  Canvas canvas(small_camera());
  canvas.triangle(a, b, c), canvas.triangle(a, c, d);
  EXPECT_NE(canvas.picture().at(2, 2), Picture::kNothing);
  EXPECT_NE(canvas.picture().at(2, 9), Picture::kNothing);
  EXPECT_EQ(canvas.picture().at(10, 5), Picture::kNothing);
  EXPECT_EQ(canvas.picture().at(5, 10), Picture::kNothing);
}

TEST(Canvas, RefusesWhatItCannotShow) {
  Canvas canvas(small_camera());
  EXPECT_THROW(canvas.triangle(at(2, 2), at(2, 10), {{0, 0, .995f}, {0, 0, 1}}), data::ArgumentError);
  EXPECT_THROW(canvas.triangle(at(2, 2), at(2, 10), {{0, 1e6f, 0}, {0, 0, 1}}), data::ArgumentError);
  EXPECT_THROW(canvas.triangle(at(2, 2), at(2, 10), {{0, 0, 2}, {0, 0, 1}}), data::ArgumentError);
  EXPECT_THROW(canvas.triangle(at(2, 2), at(2, 10), {{1e6f, 0, 0}, {0, 0, 1}}), data::ArgumentError);
  fast::Camera nowhere = small_camera();
  nowhere.target = nowhere.eye;
  EXPECT_THROW(Canvas{nowhere}, data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::verify
