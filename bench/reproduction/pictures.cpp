// SPDX-License-Identifier: MIT
// The paper's pictures from our own data.
#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "bench/render/renderer.h"
#include "bench/reproduction/reproduction.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/frame.h"

namespace limitcheck::bench {

namespace {

constexpr int kSize = 800;

fast::Camera camera_at(double degrees, double distance) {
  fast::Camera camera;
  const double angle = degrees * std::numbers::pi / 180;
  camera.eye = {distance * std::sin(angle), .35 * distance, distance * std::cos(angle)};
  camera.field_of_view = 40;
  camera.width = camera.height = kSize;
  return camera;
}

/// Light for shallow, dark for deep; readable without colour vision.
Colour depth_colour(int depth) {
  constexpr Colour scale[] = {{.99f, .91f, .15f}, {.56f, .84f, .27f}, {.13f, .66f, .52f},
                              {.17f, .45f, .56f}, {.25f, .27f, .53f}, {.27f, .0f, .33f}};
  return scale[std::min(depth, 5)];
}

class Studio {
 public:
  Image shot(const data::ControlMesh& mesh, const fast::DepthOptions& depth, const fast::Camera& seen_by,
             const fast::Camera& drawn_by, Appearance appearance) {
    fast::TessellatorOptions options;
    fast::Tessellator<float> tessellator(mesh, options);
    fast::DrawList<float> frame;
    tessellator.frame(depth, seen_by, frame);
    renderer_.begin(drawn_by, 20);
    renderer_.draw(frame, appearance);
    return renderer_.image();
  }
  Renderer& renderer() { return renderer_; }

 private:
  Renderer renderer_{kSize, kSize, 4};
};

Appearance by_depth(bool wireframe) {
  Appearance a;
  a.colour = [](const fast::Draw& draw) {
    return draw.kind == fast::Kind::kFan ? Colour{.85f, .45f, .1f} : depth_colour(draw.depth);
  };
  a.wireframe = wireframe;
  return a;
}

}  // namespace

void draw_pictures(const std::filesystem::path& folder) {
  Studio studio;
  const auto save = [&](const char* name, const Image& image) {
    write_png(folder / name, image);
    fmt::print("{}\n", (folder / name).string());
  };
  fast::DepthOptions fine;
  fine.strategy = fast::Strategy::kUniform;
  fine.depth = 4;
  const fast::Camera front = camera_at(20, 4.4);

  std::vector<Image> spheres;
  for (const int faces : {200, 4000})
    spheres.push_back(studio.shot(data::bumpy_sphere(faces, 1), fine, front, front, {}));
  save("figure-10.png", beside(spheres));

  const auto mesh = data::bumpy_sphere(200, 1);
  fast::DepthOptions random;
  random.strategy = fast::Strategy::kRandom;
  random.depth = 4;
  Appearance turned = by_depth(true);
  turned.backfaces = true;
  fast::DepthOptions culled = random;
  culled.cull = true;
  save("figure-13.png", beside({studio.shot(mesh, random, front, front, by_depth(true)),
                                studio.shot(mesh, culled, front, camera_at(130, 4.4), turned)}));

  fast::DepthOptions curvature;
  curvature.strategy = fast::Strategy::kCurvature;
  save("figure-14.png", studio.shot(mesh, curvature, front, front, by_depth(true)));
}

}  // namespace limitcheck::bench
