// SPDX-License-Identifier: MIT
// The comparison the paper leaves out: what each strategy costs at the same error on the screen.   [C74, T3]
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "bench/reproduction/turning.h"
#include "data/generators/bumpy_sphere.h"
#include "verify/cli/progress.h"

namespace limitcheck::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kMeasures{"interior_99", "silhouette_99", "mean"};

struct Family {
  const char* name;
  fast::Strategy strategy;
  fast::Repair repair;
};
constexpr Family kAdaptive[] = {
    {"project-sphere", fast::Strategy::kProjectSphere, fast::Repair::kFan},
    {"combined", fast::Strategy::kCombined, fast::Repair::kFan},
    {"project-sphere, stitched", fast::Strategy::kProjectSphere, fast::Repair::kStitch},
    {"combined, stitched", fast::Strategy::kCombined, fast::Repair::kStitch},
};

/// Finer and finer settings of one strategy: half the pixels and half the angle each. The paper's scheme with
/// the settings of all other tables is the one at 60.
fast::DepthOptions setting(fast::Strategy strategy, double pixels) {
  fast::DepthOptions options;
  options.strategy = strategy;
  options.target_pixels = pixels;
  options.angle_front = options.angle_silhouette = std::min(180., pixels / 2);
  return options;
}

/// y at x on the curve through the points, straight lines in logarithms. Nothing outside the points.
std::optional<double> at(std::vector<std::pair<double, double>> curve, double x) {
  std::sort(curve.begin(), curve.end());
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const auto [x0, y0] = curve[k - 1];
    const auto [x1, y1] = curve[k];
    if (x < x0 || x > x1) continue;
    const double t = x1 > x0 ? std::log(x / x0) / std::log(x1 / x0) : 0;
    return y0 * std::pow(y1 / y0, t);
  }
  return {};
}

/// What a family needs for that error: {triangles, frames_per_second}, or null if no setting reaches it.
Json needed(const std::vector<Json>& curve, const char* measure, double error) {
  Json result;
  for (const char* what : {"triangles", "frames_per_second"}) {
    std::vector<std::pair<double, double>> points;
    for (const Json& p : curve) points.emplace_back(p["error_pixels"][measure], p[what]);
    const auto value = at(std::move(points), error);
    if (!value) return nullptr;
    result[what] = *value;
  }
  return result;
}

}  // namespace

Json matched_error_table(const Json& spheres, bool quick) {
  const double seconds = quick ? .03 : .2;
  Json curves = Json::array(), rows = Json::array();
  cli::Progress progress;
  std::size_t done = 0;
  const std::vector<int> sizes = quick ? std::vector<int>{200, 800, 4000}
                                       : std::vector<int>(std::begin(kSphereFaces), std::end(kSphereFaces));
  for (const int faces : sizes) {
    const data::ControlMesh mesh = data::bumpy_sphere(faces, kSphereSeed);
    const PixelErrorMeter meter(mesh, 5);
    std::vector<std::pair<std::string, std::vector<Json>>> families{{"uniform", {}}};
    for (const Json& row : spheres["rows"]) {
      const std::string strategy = row["strategy"];
      if (row["faces"] != faces || !strategy.starts_with("uniform")) continue;
      families[0].second.push_back({{"faces", faces},
                                    {"family", "uniform"},
                                    {"setting", strategy},
                                    {"triangles", row["triangles"]},
                                    {"frames_per_second", row["sliding_window"]["frames_per_second"]},
                                    {"error_pixels", row["error_pixels"]}});
    }
    for (const Family& family : kAdaptive) {
      progress.show(done++, sizes.size() * std::size(kAdaptive),
                    fmt::format("{} faces, {}", faces, family.name));
      families.push_back({family.name, {}});
      const Frame frame = sliding_window(mesh, 1, family.repair);
      for (const double pixels : {240., 120., 60., 30., 15., 7.5, 3.75}) {
        const auto options = setting(family.strategy, pixels);
        const Turn turned = turn(frame, options, quick ? 4 : 12, seconds);
        const PixelError error = turned_error(mesh, meter, options, family.repair);
        families.back().second.push_back({{"faces", faces},
                                          {"family", family.name},
                                          {"setting", fmt::format("{} px", pixels)},
                                          {"triangles", counts(turned)["triangles"]},
                                          {"frames_per_second", timing(turned)["frames_per_second"]},
                                          {"error_pixels",
                                           {{"interior_99", error.interior_99},
                                            {"silhouette_99", error.silhouette_99},
                                            {"mean", error.mean}}}});
      }
    }
    for (const char* measure : kMeasures) {
      for (const Json& level : families[0].second) {
        if (level["setting"] == "uniform-1" || level["setting"] == "uniform-5") continue;
        Json row{{"faces", faces}, {"measure", measure}, {"as", level["setting"]}};
        row["error"] = level["error_pixels"][measure];
        for (const auto& [name, curve] : families) row[name] = needed(curve, measure, row["error"]);
        rows.push_back(std::move(row));
      }
    }
    for (auto& [name, curve] : families)
      for (Json& point : curve) curves.push_back(std::move(point));
  }
  progress.clear();
  return {
      {"seed", kSphereSeed}, {"engine", "sliding window, one thread"}, {"rows", rows}, {"curves", curves}};
}

}  // namespace limitcheck::bench
