// SPDX-License-Identifier: MIT
// The comparison the paper leaves out: what each strategy costs for pictures that are equally good.
// [C74, T3]
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "verify/cli/screen.h"
#include "verify/picture/judge.h"

namespace limitcheck::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kMeasures{"percentile_99", "mean", "median", "share"};

struct Family {
  const char* name;
  fast::Strategy strategy;
  fast::Repair repair;
};
constexpr Family kFamilies[] = {
    {"uniform", fast::Strategy::kUniform, fast::Repair::kFan},
    {"project-sphere", fast::Strategy::kProjectSphere, fast::Repair::kFan},
    {"combined", fast::Strategy::kCombined, fast::Repair::kFan},
    {"project-sphere, stitched", fast::Strategy::kProjectSphere, fast::Repair::kStitch},
    {"combined, stitched", fast::Strategy::kCombined, fast::Repair::kStitch},
};

/// What a family needs for that error: {triangles, frames_per_second, spread}, or null if no setting reaches it. The
/// spread is the widest of its settings.
Json needed(const std::vector<Json>& curve, const char* measure, double error) {
  Json result;
  for (const char* what : {"triangles", "frames_per_second"}) {
    std::vector<std::pair<double, double>> points;
    for (const Json& p : curve) points.emplace_back(p["picture"][measure], p[what]);
    const auto value = verify::on_curve(std::move(points), error);
    if (!value) return nullptr;
    result[what] = *value;
  }
  double widest = 1;
  for (const Json& p : curve) widest = std::max(widest, p["spread"].get<double>());
  result["spread"] = widest;
  return result;
}

}  // namespace

Json matched_error_table(bool quick) {
  const double seconds = quick ? .03 : .1;
  Json curves = Json::array(), rows = Json::array();
  cli::Progress progress;
  std::size_t done = 0;
  const std::vector<int> sizes =
      quick ? std::vector<int>{200, 800} : std::vector<int>(std::begin(kSphereFaces), std::end(kSphereFaces));
  for (const int faces : sizes) {
    const data::ControlMesh mesh = data::bumpy_sphere(faces, kSphereSeed);
    const verify::Judge judge(mesh, truth_depth(faces));
    std::vector<std::pair<std::string, std::vector<Json>>> families;
    const auto point = [&](const Family& family, const std::string& setting,
                           const fast::DepthOptions& options, const Frame& frame) {
      const Turn turned = turn(frame, options, quick ? 4 : 12, seconds, Clock::kProcessor);
      const verify::Seen seen = judge.see(options, {.repair = family.repair});
      const Json timed = timing(turned);
      families.back().second.push_back({{"faces", faces},
                                        {"family", family.name},
                                        {"setting", setting},
                                        {"triangles", seen.triangles},
                                        {"frames_per_second", timed["frames_per_second"]},
                                        {"spread", timed["spread"]},
                                        {"picture", picture(seen.difference)}});
    };
    for (const Family& family : kFamilies) {
      progress.show(done++, sizes.size() * std::size(kFamilies),
                    fmt::format("{} faces, {}", faces, family.name));
      families.push_back({family.name, {}});
      const Frame frame = sliding_window(mesh, 1, family.repair);
      if (family.strategy == fast::Strategy::kUniform) {
        for (int depth = 1; depth <= 5; ++depth)
          point(family, fmt::format("uniform-{}", depth), verify::uniform(depth), frame);
      } else {
        for (const double pixels : {240., 120., 60., 30., 15., 7.5, 3.75})
          point(family, fmt::format("{} px", pixels), verify::adaptive(family.strategy, pixels), frame);
      }
    }
    for (const char* measure : kMeasures) {
      for (const Json& level : families[0].second) {
        if (level["setting"] == "uniform-1" || level["setting"] == "uniform-5") continue;
        Json row{{"faces", faces}, {"measure", measure}, {"as", level["setting"]}};
        row["error"] = level["picture"][measure];
        for (const auto& [name, curve] : families) row[name] = needed(curve, measure, row["error"]);
        rows.push_back(std::move(row));
      }
    }
    for (auto& [name, curve] : families)
      for (Json& it : curve) curves.push_back(std::move(it));
  }
  progress.clear();
  return {
      {"seed", kSphereSeed}, {"engine", "sliding window, one thread"}, {"rows", rows}, {"curves", curves}};
}

}  // namespace limitcheck::bench
