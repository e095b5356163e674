// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <png.h>

#include <filesystem>

#include "bench/render/renderer.h"

namespace limitcheck::bench {
namespace {

constexpr int kWidth = 200, kHeight = 100;

bool white(const Image& image, int x, int y) {
  const std::uint8_t* p = image.rgb.data() + 3 * (y * image.width + x);
  return p[0] == 255 && p[1] == 255 && p[2] == 255;
}

fast::SurfaceVertex<float> vertex(float x, float y, float z = 0) {
  return {{x, y, z}, {0, 0, 1}};
}

/// Looks down the z axis from 1 above the plane z = 0; 90 degrees: the picture shows -2 < x < 2, -1 < y < 1.
fast::Camera above() {
  return {.eye = {0, 0, 1}, .field_of_view = 90, .width = kWidth, .height = kHeight};
}

fast::DrawList<float> frame_of(std::vector<fast::SurfaceVertex<float>> vertices, fast::DrawMode mode) {
  fast::DrawList<float> frame;
  frame.draws.push_back({0, static_cast<std::int32_t>(vertices.size()), 0, 0, 0, mode});
  frame.vertices = std::move(vertices);
  return frame;
}

Image picture(const fast::DrawList<float>& frame, const Appearance& appearance = {}) {
  static Renderer renderer(kWidth, kHeight, 1);
  renderer.begin(above(), 10);
  renderer.draw(frame, appearance);
  return renderer.image();
}

TEST(Rendering, ShowsAPointWhereTheCameraProjectsIt) {
  // The left half of the upper right quarter and nothing else.
  const Image image =
      picture(frame_of({vertex(0, 0), vertex(1, 0), vertex(0, 1), vertex(1, 1)}, fast::DrawMode::kStrip));
  EXPECT_FALSE(white(image, 147, 3));
  EXPECT_FALSE(white(image, 102, 47));
  EXPECT_TRUE(white(image, 153, 3));
  EXPECT_TRUE(white(image, 97, 47));   // left of the middle
  EXPECT_TRUE(white(image, 120, 53));  // below it
}

TEST(Rendering, DrawsFansAndTrianglesLikeStrips) {
  const auto strip =
      picture(frame_of({vertex(0, 0), vertex(1, 0), vertex(0, 1), vertex(1, 1)}, fast::DrawMode::kStrip));
  const auto fan =
      picture(frame_of({vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)}, fast::DrawMode::kFan));
  const auto triangles =
      picture(frame_of({vertex(0, 0), vertex(1, 0), vertex(0, 1), vertex(1, 0), vertex(1, 1), vertex(0, 1)},
                       fast::DrawMode::kTriangles));
  EXPECT_EQ(strip.rgb, fan.rgb);
  EXPECT_EQ(strip.rgb, triangles.rgb);
}

TEST(Rendering, LeavesOutWhatIsSeenFromBehindOrShowsItRed) {
  const auto frame =
      frame_of({vertex(-1, -1), vertex(0, 1), vertex(1, -1)}, fast::DrawMode::kTriangles);  // clockwise
  EXPECT_TRUE(white(picture(frame), 100, 60));
  const Image image = picture(frame, {.backfaces = true});
  const std::uint8_t* p = image.rgb.data() + 3 * (60 * kWidth + 100);
  EXPECT_GT(p[0], 2 * p[1]);
}

TEST(Rendering, NearerTrianglesHideThoseBehind) {
  const auto by_face = [](const fast::Draw& draw) {
    return draw.face == 1 ? Colour{1, 0, 0} : Colour{0, 0, 1};
  };
  auto frame = frame_of({vertex(-1, -1, .2f), vertex(1, -1, .2f), vertex(0, 1, .2f), vertex(-1, -1),
                         vertex(1, -1), vertex(0, 1)},
                        fast::DrawMode::kTriangles);
  frame.draws[0].count = 3;
  frame.draws[0].face = 1;
  frame.draws.push_back({3, 3, 0, 2, 2, fast::DrawMode::kTriangles});
  const Image image = picture(frame, {.colour = by_face});
  const std::uint8_t* p = image.rgb.data() + 3 * (60 * kWidth + 100);
  EXPECT_GT(p[0], 0);
  EXPECT_EQ(p[2], 0);
}

TEST(Png, ComesBackFromALibraryAsItWasWritten) {
  Image image{3, 2, {}};
  for (int k = 0; k < 18; ++k) image.rgb.push_back(static_cast<std::uint8_t>(13 * k));
  const auto path = std::filesystem::temp_directory_path() / "limitcheck_render_test.png";
  write_png(path, image);
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&read, path.c_str()), 0);
  read.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(read));
  ASSERT_NE(png_image_finish_read(&read, nullptr, rgb.data(), 0, nullptr), 0);
  std::filesystem::remove(path);
  EXPECT_EQ(read.width, 3u);
  EXPECT_EQ(rgb, image.rgb);
}

TEST(Images, BesideEachOtherKeepTheirPixels) {
  const Image a{1, 1, {1, 2, 3}}, b{1, 1, {4, 5, 6}};
  EXPECT_EQ(beside({a, b}, 1).rgb, (std::vector<std::uint8_t>{1, 2, 3, 255, 255, 255, 4, 5, 6}));
}

}  // namespace
}  // namespace limitcheck::bench
