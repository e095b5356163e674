// SPDX-License-Identifier: MIT
// What the text says of time: T4, T6 and T7 of what a reproduction must show.             [C55, C74, C78]
#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"

namespace limitcheck::bench {

namespace {

constexpr const char *kAsSaid = "as the text says", *kNotAsSaid = "not as the text says",
                     *kNotMeasured = "could not be measured";

using Json = nlohmann::ordered_json;

/// Of several: what they agree on, without those that could not be measured; "depends" if they do not.
std::string all_of(const std::vector<std::string>& outcomes) {
  std::set<std::string> different(outcomes.begin(), outcomes.end());
  if (different.size() > 1) different.erase(kNotMeasured);
  return different.size() > 1 ? "depends" : different.empty() ? kNotMeasured : *different.begin();
}

Json series(const char* name, const char* unit, const std::vector<double>& at,
            const std::vector<double>& values) {
  return {{"name", name}, {"unit", unit}, {"at", at}, {"values", values}};
}

std::vector<Json> rows_of(const Json& spheres, const std::string& strategy) {
  std::vector<Json> rows;
  for (const Json& row : spheres["rows"])
    if (row["strategy"] == strategy) rows.push_back(row);
  return rows;
}

/// Every adaptive strategy against uniform depth, by faces: at equal error, which the text does not ask for and
/// without which there is nothing to compare. Each measure of error is a series; beside them equal settings.
Json adaptive_is_faster(const Json& spheres, const Json& matched) {
  Json all = Json::array();
  std::vector<std::string> outcomes;
  double widest = 1;
  std::size_t faster = 0, slower = 0, unknown = 0;
  const auto judge = [&](double ratio, double spread) {
    outcomes.emplace_back(outcome(ratio, 1, spread));
    ++(outcomes.back() == kAsSaid ? faster : outcomes.back() == kNotAsSaid ? slower : unknown);
    widest = std::max(widest, spread);
  };
  for (const char* family : {"project-sphere", "combined"}) {
    for (const auto& [measure, words] : {std::pair{"percentile_99", "99 % of the pixels"},
                                         {"mean", "mean error"},
                                         {"median", "median error"},
                                         {"share", "share of pixels off by more than 4"}}) {
      std::vector<double> faces, ratios;
      for (const Json& row : matched["rows"]) {
        if (row["measure"] != measure || row["as"] != "uniform-3" || row[family].is_null()) continue;
        const Json &a = row[family], &u = row["uniform"];
        const double ratio = a["frames_per_second"].get<double>() / u["frames_per_second"].get<double>();
        const double of_a = a["spread"], of_u = u["spread"];
        judge(ratio, of_a * of_u);
        if (std::max(of_a, of_u) > kWidest) continue;
        faces.push_back(row["faces"]);
        ratios.push_back(ratio);
      }
      all.push_back(series(
          fmt::format("frames per second of {} over those of uniform depth, at the {} of uniform depth 3",
                      family, words)
              .c_str(),
          "faces", faces, ratios));
    }
    std::vector<double> faces, ratios;
    const auto adaptive = rows_of(spheres, family), uniform = rows_of(spheres, "uniform-3");
    for (std::size_t k = 0; k < adaptive.size(); ++k) {
      faces.push_back(adaptive[k]["faces"]);
      ratios.push_back(adaptive[k]["sliding_window"]["frames_per_second"].get<double>() /
                       uniform[k]["sliding_window"]["frames_per_second"].get<double>());
    }
    all.push_back(series(
        fmt::format("the same of {} at 60 pixels over uniform depth 3, at unequal error: not judged", family)
            .c_str(),
        "faces", faces, ratios));
  }
  return {{"id", "T4"},
          {"outcome", all_of(outcomes)},
          {"figures", fmt::format("At the error of uniform depth 3, with the paper's fans, adaptive depth is "
                                  "faster in {} of {} comparisons, slower in {}, and in {} "
                                  "the difference is within the spread of the repetitions of both, a factor "
                                  "of up to {:.2f}, or that is "
                                  "more than {}",
                                  faster, outcomes.size(), slower, unknown, widest, kWidest)},
          {"series", std::move(all)}};
}

/// Processor time of a frame per limit point, uniform depths 3 to 7: the least of some frames, and their
/// spread.
Json time_per_point(bool quick) {
  struct Forget : fast::DrawSink<float> {
    void draw(const fast::Draw&, std::span<const fast::SurfaceVertex<float>>,
              std::span<const fast::LatticePoint>) override {}
  } sink;
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  fast::Tessellator<float> engine(mesh, {.threads = 1});
  std::vector<double> depths, nanoseconds;
  double widest = 1;
  for (int depth = 3; depth <= 7; ++depth) {
    const std::vector<std::int32_t> all(mesh.faces.size(), depth);
    std::vector<double> times;
    for (int k = 0; k < (quick ? 4 : 10) << (7 - depth); ++k) {
      const double start = seconds_of(Clock::kProcessor);
      const auto stats = engine.frame(all, sink);
      times.push_back(1e9 * (seconds_of(Clock::kProcessor) - start) /
                      static_cast<double>(stats.limit_points));
    }
    std::sort(times.begin(), times.end());
    depths.push_back(depth);
    nanoseconds.push_back(times.front());
    if (depth >= 5) widest = std::max(widest, times[times.size() / 2] / times.front());
  }
  const auto [least, most] = std::minmax_element(nanoseconds.begin() + 2, nanoseconds.end());
  return {{"id", "T6"},
          {"outcome", outcome(1.25 * *least / *most, 1, widest)},
          {"figures", fmt::format("Asked for: depths 5, 6 and 7 within 25 %; they lie within {:.0f} %; the "
                                  "median of the repetitions was up to {:.0f} % above the least",
                                  100 * (*most / *least - 1), 100 * (widest - 1))},
          {"series", Json::array({series("nanoseconds per limit point", "depth", depths, nanoseconds)})}};
}

/// 800 faces with project-sphere, drawn.
Json ten_frames(const Json& spheres) {
  for (const Json& row : rows_of(spheres, "project-sphere")) {
    if (row["faces"] != 800) continue;
    const Json& drawn = row["sliding_window_drawn"];
    const double fps = drawn["frames_per_second"], triangles = row["triangles"];
    return {{"id", "T7"},
            {"outcome", outcome(fps, 10, drawn["spread"].get<double>())},
            {"figures",
             fmt::format(
                 "{:.0f} triangles; {:.0f} frames per second of processor time drawn by {}, {:.0f} not drawn",
                 triangles, fps, spheres["renderer"].get<std::string>(),
                 row["sliding_window"]["frames_per_second"].get<double>())},
            {"series", Json::array()}};
  }
  return nullptr;
}

}  // namespace

const char* outcome(double quantity, double bound, double spread) {
  if (spread > kWidest) return kNotMeasured;
  if (quantity / spread > bound) return kAsSaid;
  if (quantity * spread < bound) return kNotAsSaid;
  return kNotMeasured;
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

Json timings(const Json& spheres, const Json& matched, bool quick) {
  return {{"load", load_average()},
          {"rows",
           Json::array({adaptive_is_faster(spheres, matched), time_per_point(quick), ten_frames(spheres)})}};
}

}  // namespace limitcheck::bench
