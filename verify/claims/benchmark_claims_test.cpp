// SPDX-License-Identifier: MIT
// Sections 6 and 7: what the heuristics do on bumpy spheres of growing size, counted and measured.
//                                                                              [C72, C74-C79]
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "fast/depth.h"
#include "reference/stam.h"

namespace limitcheck::verify {
namespace {

using fast::Camera;
using fast::DepthOptions;
using fast::Point3;
using fast::Strategy;

constexpr std::array kFaces{200, 800, 2000, 4000};

struct Scene {
  explicit Scene(int faces)
      : mesh(data::bumpy_sphere(faces, 1)), adjacency(mesh), heuristics(mesh, adjacency) {}

  std::vector<std::int32_t> depths(Strategy strategy, double pixels, double degrees) const {
    DepthOptions options;
    options.strategy = strategy;
    options.target_pixels = pixels;
    options.angle_front = options.angle_silhouette = options.angle_back = degrees;
    return heuristics.depths(options, Camera{});
  }

  data::ControlMesh mesh;
  fast::Adjacency adjacency;
  fast::DepthHeuristics heuristics;
};

std::int64_t triangles(const std::vector<std::int32_t>& depths) {
  std::int64_t sum = 0;
  for (const auto d : depths)
    if (d >= 0) sum += std::int64_t{1} << (2 * d);
  return sum;
}

std::int64_t visible(const std::vector<std::int32_t>& depths) {
  return std::count_if(depths.begin(), depths.end(), [](std::int32_t d) { return d >= 0; });
}

TEST(Sec6_Curvature, GrowsWithTheNumberOfFaces) {
  RecordProperty("claim", "C72");
  double before = 0;
  for (const int faces : kFaces) {
    const Scene scene(faces);
    double sum = 0;
    for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v)
      sum += scene.heuristics.cone_depth(static_cast<std::int32_t>(v), std::sqrt(.75));
    const double mean = sum / static_cast<double>(scene.mesh.positions.size());
    RecordProperty(fmt::format("mean_cone_depth_at_30_degrees_{}", faces), fmt::format("{:.2f}", mean));
    EXPECT_GT(mean, before) << faces;
    before = mean;
  }
}

TEST(Sec6_Uniform, DisplaysSeveralTimesTheTrianglesOfTheHeuristicsAndLessSoForCombined) {
  RecordProperty("claim", "C74");
  double first = 0, last = 0;
  for (const int faces : kFaces) {
    const Scene scene(faces);
    const double uniform = 64. * faces;
    const double sphere =
        uniform / static_cast<double>(triangles(scene.depths(Strategy::kProjectSphere, 60, 60)));
    const double combined =
        uniform / static_cast<double>(triangles(scene.depths(Strategy::kCombined, 60, 60)));
    RecordProperty(fmt::format("uniform_3_over_project_sphere_{}", faces), fmt::format("{:.2f}", sphere));
    RecordProperty(fmt::format("uniform_3_over_combined_{}", faces), fmt::format("{:.2f}", combined));
    EXPECT_GT(sphere, 2) << faces;
    EXPECT_GE(sphere, combined) << faces;
    if (first == 0) first = combined;
    last = combined;
  }
  EXPECT_GT(first, 1);
  EXPECT_LT(last, first) << "the advantage shrinks with the number of faces";
}

TEST(Sec6_Combined, GivesMoreDepthAsFacesGrowWhileProjectSphereGivesLess) {
  RecordProperty("claim", "C75");
  std::vector<double> sphere, combined;
  for (const int faces : kFaces) {
    const Scene scene(faces);
    const auto per_face = [&](Strategy s) {
      const auto depths = scene.depths(s, 60, 30);
      return static_cast<double>(triangles(depths)) / static_cast<double>(visible(depths));
    };
    sphere.push_back(per_face(Strategy::kProjectSphere));
    combined.push_back(per_face(Strategy::kCombined));
    RecordProperty(fmt::format("triangles_per_visible_face_sphere_combined_{}", faces),
                   fmt::format("{:.1f} {:.1f}", sphere.back(), combined.back()));
    EXPECT_GE(combined.back(), sphere.back());
  }
  EXPECT_LT(sphere.back(), sphere.front());
  EXPECT_GT(combined.back(), combined.front());
}

TEST(Sec6_BackfaceShare, FallsWithTheNumberOfFaces) {
  RecordProperty("claim", "C77");
  std::vector<double> share;
  for (const int faces : kFaces) {
    double culled = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const auto mesh = data::bumpy_sphere(faces, seed);
      const fast::Adjacency adjacency(mesh);
      const auto facing = fast::DepthHeuristics(mesh, adjacency).facing(Camera{});
      culled +=
          static_cast<double>(std::count(facing.begin(), facing.end(), fast::Facing::kBack)) / 3 / faces;
    }
    share.push_back(culled);
    RecordProperty(fmt::format("culled_percent_{}", faces), fmt::format("{:.1f}", 100 * culled));
  }
  EXPECT_TRUE(std::is_sorted(share.rbegin(), share.rend()));
  EXPECT_GT(share.front(), share.back() + .05);
}

// Whether ten frames a second are reached is the benchmark's business; the count of triangles is not.
TEST(Sec7_TenThousandTriangles, OfEightHundredFacesAreAmongWhatBothHeuristicsShow) {
  RecordProperty("claim", "C78");
  const Scene scene(800);
  for (const auto strategy : {Strategy::kProjectSphere, Strategy::kCombined}) {
    // Project-sphere by its target; combined by its angle, the vertex rule asking for more than the formula.
    double pixels = 60, degrees = 60;
    auto depths = scene.depths(strategy, pixels, degrees);
    while (triangles(depths) > 11000 && degrees < 120)
      depths = scene.depths(strategy, pixels += 1, strategy == Strategy::kCombined ? degrees += 1 : degrees);
    RecordProperty(fmt::format("{}_pixels_triangles", name(strategy)),
                   fmt::format("{} px, {} degrees: {}", pixels, degrees, triangles(depths)));
    RecordProperty(
        fmt::format("{}_triangles_per_visible_face", name(strategy)),
        fmt::format("{:.1f}", static_cast<double>(triangles(depths)) / static_cast<double>(visible(depths))));
    EXPECT_GT(triangles(depths), 9000) << name(strategy);
    EXPECT_LT(degrees, 120) << name(strategy);
  }
}

// How far the middle of each triangle of an adaptive tessellation is from the limit surface, in pixels of the
// view: over all triangles of visible faces, root mean square and largest.
struct Deviation {
  double rms = 0, largest = 0, beyond_a_pixel = 0;
};
Deviation deviation(const reference::StamEvaluator<double>& truth, const std::vector<std::int32_t>& depths) {
  const Camera camera;
  const auto at = [&](int f, double l1, double l2) {
    const auto p = truth.evaluate(f, l1, l2, reference::Order::kFirst).position;
    return Point3{p.x, p.y, p.z};
  };
  Deviation d;
  double weight = 0;
  for (std::size_t f = 0; f < depths.size(); ++f) {
    if (depths[f] < 0) continue;
    const int n = 1 << depths[f], face = static_cast<int>(f);
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < 2 * (n - j) - 1; ++i) {  // the triangles of row j, pointing up and down in turn
        const double h = 1. / n, x = i / 2 * h, y = j * h, flip = i % 2;
        const Point3 a = at(face, x + flip * h, y), b = at(face, x + (1 - flip) * h, y + flip * h),
                     c = at(face, x + flip * 0, y + h);
        const double l1 = (x + flip * h + x + (1 - flip) * h + x) / 3, l2 = (y + y + flip * h + y + h) / 3;
        const Point3 flat = (1. / 3) * (a + b + c), curved = at(face, l1, l2);
        const double pixels = length(curved - flat) * camera.focal_pixels() / length(curved - camera.eye);
        const double area = length(cross(b - a, c - a));
        d.rms += area * pixels * pixels;
        d.beyond_a_pixel += area * (pixels > 1);
        weight += area;
        d.largest = std::max(d.largest, pixels);
      }
    }
  }
  d.rms = std::sqrt(d.rms / weight);
  d.beyond_a_pixel /= weight;
  return d;
}

TEST(Sec6_Combined, KeepsDetailBetterThanProjectSphereAtNoMoreTriangles) {
  RecordProperty("claim", "C76");
  for (const int faces : {200, 800}) {
    const Scene scene(faces);
    const reference::StamEvaluator<double> truth(scene.mesh);
    const auto combined = scene.depths(Strategy::kCombined, 90, 45);
    double pixels = 90;
    auto sphere = scene.depths(Strategy::kProjectSphere, pixels, 45);
    while (triangles(sphere) < triangles(combined))
      sphere = scene.depths(Strategy::kProjectSphere, pixels *= .97, 45);
    const Deviation with = deviation(truth, combined), without = deviation(truth, sphere);
    RecordProperty(fmt::format("rms_pixels_sphere_over_combined_{}", faces),
                   fmt::format("{:.3f}/{:.3f} at {}/{} triangles", without.rms, with.rms, triangles(sphere),
                               triangles(combined)));
    RecordProperty(fmt::format("largest_pixels_sphere_over_combined_{}", faces),
                   fmt::format("{:.2f}/{:.2f}", without.largest, with.largest));
    EXPECT_GT(without.largest, with.largest) << faces;
  }
}

// "No perceivable difference" taken as: less than a pixel from the surface. A rendering would say more.
TEST(Sec7_Adaptive, IsWithinAPixelOfTheSurfaceOverNineTenthsOfTheVisibleFaces) {
  RecordProperty("claim", "C79");
  const Scene scene(800);
  const reference::StamEvaluator<double> truth(scene.mesh);
  const Deviation adaptive = deviation(truth, scene.depths(Strategy::kCombined, 60, 30));
  const Deviation deep = deviation(truth, std::vector<std::int32_t>(800, 5));
  RecordProperty("adaptive_rms_largest_pixels", fmt::format("{:.3f} {:.2f}", adaptive.rms, adaptive.largest));
  RecordProperty("uniform_5_rms_largest_pixels", fmt::format("{:.4f} {:.3f}", deep.rms, deep.largest));
  RecordProperty("percent_beyond_a_pixel", fmt::format("{:.2f}", 100 * adaptive.beyond_a_pixel));
  EXPECT_LT(adaptive.beyond_a_pixel, .1);
  EXPECT_LT(deep.largest, 1);
}

}  // namespace
}  // namespace limitcheck::verify
