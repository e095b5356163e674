// SPDX-License-Identifier: MIT
// What the text says of time: T4, T6 and T7 of what a reproduction must show.             [C55, C74, C78]
#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"

namespace limitcheck::bench {

namespace {

using Json = nlohmann::ordered_json;

/// The worst of several: one that says otherwise, then one that says nothing.
const char* all_of(const std::vector<std::string>& outcomes) {
  for (const char* worst : {"not as the text says", "could not be measured"})
    if (std::find(outcomes.begin(), outcomes.end(), worst) != outcomes.end()) return worst;
  return "as the text says";
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

/// project-sphere against uniform depth 3, by faces.
Json adaptive_is_faster(const Json& spheres) {
  const auto adaptive = rows_of(spheres, "project-sphere"), uniform = rows_of(spheres, "uniform-3");
  std::vector<double> faces, ratios;
  std::vector<std::string> outcomes;
  double widest = 1;
  for (std::size_t k = 0; k < adaptive.size(); ++k) {
    const Json &a = adaptive[k]["sliding_window"], &u = uniform[k]["sliding_window"];
    const double spread = a["spread"].get<double>() * u["spread"].get<double>();
    faces.push_back(adaptive[k]["faces"]);
    ratios.push_back(a["frames_per_second"].get<double>() / u["frames_per_second"].get<double>());
    outcomes.emplace_back(outcome(ratios.back(), 1, spread));
    widest = std::max(widest, spread);
  }
  return {{"id", "T4"},
          {"outcome", all_of(outcomes)},
          {"figures", fmt::format("Repetitions differed by a factor of up to {:.2f}", widest)},
          {"series", Json::array({series("frames per second of project-sphere over those of uniform depth 3",
                                         "faces", faces, ratios)})}};
}

/// Processor time of a frame per limit point, uniform depths 3 to 7: the least of some frames, and their
/// spread.
Json time_per_point(bool quick) {
  struct Forget : fast::DrawSink<float> {
    void draw(const fast::Draw&, std::span<const fast::SurfaceVertex<float>>,
              std::span<const fast::LatticePoint>) override {}
  } sink;
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  fast::TessellatorOptions options;
  options.threads = 1;
  fast::Tessellator<float> engine(mesh, options);
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
  if (quantity / spread > bound) return "as the text says";
  if (quantity * spread < bound) return "not as the text says";
  return "could not be measured";
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

Json timings(const Json& spheres, bool quick) {
  return {{"load", load_average()},
          {"rows", Json::array({adaptive_is_faster(spheres), time_per_point(quick), ten_frames(spheres)})}};
}

}  // namespace limitcheck::bench
