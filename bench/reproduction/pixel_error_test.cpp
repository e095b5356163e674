// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/reproduction/pixel_error.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "fast/frame.h"

namespace limitcheck::bench {
namespace {

fast::DrawList<float> uniform(const data::ControlMesh& mesh, int depth) {
  fast::DepthOptions strategy;
  strategy.strategy = fast::Strategy::kUniform;
  strategy.depth = depth;
  return frame_seen(mesh, strategy);
}

/// A flat sheet in the plane z = 0, seen from 4 above its middle.
struct FlatSheet {
  FlatSheet() : mesh(data::sheet(6, 6)) {
    for (auto& p : mesh.positions) p = {p[0], p[1], 0};
    double x = 0, y = 0;
    for (const auto& p : mesh.positions) x += p[0], y += p[1];
    const auto n = static_cast<double>(mesh.positions.size());
    camera.target = {x / n, y / n, 0};
    camera.eye = {x / n, y / n, 4};
  }
  data::ControlMesh mesh;
  fast::Camera camera;
};

TEST(PixelError, IsZeroOnAPlane) {
  const FlatSheet sheet;
  const PixelErrorMeter meter(sheet.mesh, 3);
  const PixelError error = meter.measure(uniform(sheet.mesh, 2), sheet.camera, 1 << 20);
  ASSERT_GT(error.samples, 1000);
  EXPECT_LT(std::max(error.interior_worst, error.silhouette_worst), 1e-3);
}

TEST(PixelError, OfALiftedPlaneIsTheLiftAsTheViewerSeesIt) {
  const FlatSheet sheet;
  const PixelErrorMeter meter(sheet.mesh, 3);
  auto frame = uniform(sheet.mesh, 2);
  constexpr double kLift = .01;
  for (auto& v : frame.vertices) v.position.z += static_cast<float>(kLift);
  const PixelError error = meter.measure(frame, sheet.camera, 1 << 20);
  // A point at distance r from the foot of the viewer: lift * sin(angle to the view) * focal / distance, most
  // where the sheet ends. Sampled at middles of triangles, so a little less than at the border itself.
  double reach = 0;
  for (const auto& p : sheet.mesh.positions)
    reach = std::max(reach, std::hypot(p[0] - sheet.camera.target.x, p[1] - sheet.camera.target.y));
  const auto seen = [&](double r) { return kLift * r / (r * r + 16) * sheet.camera.focal_pixels(); };
  const double most = reach < 4 ? seen(reach) : seen(4);
  EXPECT_LE(error.interior_worst, most * 1.001);
  EXPECT_GE(error.interior_worst, most * .8);
}

TEST(PixelError, FallsByFourWithEachDepth) {
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  const PixelErrorMeter meter(mesh, 5);
  double last = meter.measure(uniform(mesh, 3), viewer(0), 1 << 18).mean;
  for (int depth = 4; depth <= 5; ++depth) {
    const double mean = meter.measure(uniform(mesh, depth), viewer(0), 1 << 18).mean;
    EXPECT_NEAR(last / mean, 4, .3) << "depth " << depth;
    last = mean;
  }
}

TEST(PixelError, CountsWhatFacesTheViewerOnly) {
  const auto mesh = data::icosahedron();  // all but a sphere: somewhat less than half of it is seen
  const PixelErrorMeter meter(mesh, 3);
  const auto frame = uniform(mesh, 3);
  const auto seen = static_cast<double>(meter.measure(frame, viewer(0), 1 << 20).samples);
  EXPECT_NEAR(seen / (4. * 20 * 64), .5 * (1 - .9 / length(viewer(0).eye)), .1);
}

TEST(PixelError, WantsProvenance) {
  const FlatSheet sheet;
  const PixelErrorMeter meter(sheet.mesh, 3);
  auto frame = uniform(sheet.mesh, 1);
  frame.provenance.clear();
  EXPECT_THROW(meter.measure(frame, sheet.camera, 10), std::invalid_argument);
}

}  // namespace
}  // namespace limitcheck::bench
