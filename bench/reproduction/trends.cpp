// SPDX-License-Identifier: MIT
// Does what the paper says of its figures hold? The trends that a reproduction must show.          [claims.md
// F]
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/render/renderer.h"
#include "bench/reproduction/pixel_error.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/frame.h"
#include "verify/watertight/watertight.h"

namespace limitcheck::bench {

namespace {

using Json = nlohmann::ordered_json;

Json trend(const char* id, const std::string& statement, bool held, std::string figures) {
  return {{"id", id}, {"statement", statement}, {"held", held}, {"figures", std::move(figures)}};
}

/// Rows of the sphere table by strategy, in order of faces.
class Table {
 public:
  explicit Table(const Json& rows) {
    for (const Json& row : rows) by_[row["strategy"]].push_back(row);
  }
  const std::vector<Json>& of(const std::string& strategy) const { return by_.at(strategy); }
  std::vector<double> values(const std::string& strategy,
                             const std::function<double(const Json&)>& value) const {
    std::vector<double> list;
    for (const Json& row : of(strategy)) list.push_back(value(row));
    return list;
  }

 private:
  std::map<std::string, std::vector<Json>> by_;
};

std::string series(const std::vector<double>& values) {
  std::string text;
  for (const double v : values) text += fmt::format("{}{:.3g}", text.empty() ? "" : " ", v);
  return text;
}

/// Falls from first to last, and no step rises by more than `noise` of the value.
bool falls(const std::vector<double>& values, double noise) {
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] > values[k - 1] * (1 + noise)) return false;
  return values.back() < values.front();
}

double per_visible_face(const Json& row) {
  return row["triangles"].get<double>() /
         (row["faces"].get<double>() * (1 - row["culled_share"].get<double>()));
}

/// Triangles that uniform depth would need for the same error, by power laws between the depths.
double uniform_triangles_at(const Table& table, std::size_t k, double error) {
  std::vector<std::pair<double, double>> points;  // log error, log triangles
  for (int depth = 1; depth <= 5; ++depth) {
    const Json& row = table.of(fmt::format("uniform-{}", depth))[k];
    points.emplace_back(std::log(row["error_pixels"]["interior_99"].get<double>()),
                        std::log(row["triangles"].get<double>()));
  }
  std::size_t i = 0;
  while (i + 2 < points.size() && points[i + 1].first > std::log(error)) ++i;
  const auto [x0, y0] = points[i];
  const auto [x1, y1] = points[i + 1];
  return std::exp(y0 + (y1 - y0) * (std::log(error) - x0) / (x1 - x0));
}

Json matched_error(const Table& table, const std::string& strategy) {
  std::vector<double> ratios;
  bool held = true;
  for (std::size_t k = 0; k < table.of(strategy).size(); ++k) {
    const Json& row = table.of(strategy)[k];
    ratios.push_back(uniform_triangles_at(table, k, row["error_pixels"]["interior_99"]) /
                     row["triangles"].get<double>());
    held = held && ratios.back() > 1;
  }
  return trend("T3", fmt::format("uniform depth needs more triangles than {} for the same error", strategy),
               held, "triangles of uniform / of " + strategy + " by faces: " + series(ratios));
}

std::int64_t open_edges(const data::ControlMesh& mesh, const fast::DepthOptions& depth) {
  fast::Tessellator<float> engine(mesh);
  fast::IndexedMesh<float> out;
  engine.frame(depth, viewer(0), out);
  std::vector<float> positions;
  for (const auto& v : out.vertices)
    positions.insert(positions.end(), {v.position.x, v.position.y, v.position.z});
  const auto merged = verify::merge_identical(std::span<const float>(positions));
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& t : out.triangles)
    triangles.push_back({merged.point_of[t[0]], merged.point_of[t[1]], merged.point_of[t[2]]});
  const auto report = verify::inspect_surface(static_cast<std::int64_t>(merged.vertex_of.size()), triangles);
  return static_cast<std::int64_t>(report.open_edges.size()) + report.crowded_edges + report.clashing_edges;
}

Json watertight(bool quick) {
  std::int64_t bad = 0;
  int frames = 0;
  for (const int faces : {200, 800, 4000}) {
    const auto mesh = data::bumpy_sphere(faces, kSphereSeed);
    for (std::uint64_t seed = 1; seed <= (quick ? 2u : 10u); ++seed, ++frames) {
      fast::DepthOptions depth;
      depth.strategy = fast::Strategy::kRandom;
      depth.depth = 4;
      depth.seed = seed;
      bad += open_edges(mesh, depth);
    }
  }
  return trend("T8", "no cracks between faces of unequal depth", bad == 0,
               fmt::format("{} open or mismatched edges in {} frames of random depths", bad, frames));
}

/// Mean distance of fans from the surface with a flat centre, over that with the centre on the limit surface.
Json fan_centre() {
  const auto mesh = data::bumpy_sphere(800, kSphereSeed);
  const PixelErrorMeter meter(mesh, 5);
  const auto error = [&](fast::FanCentre centre) {
    fast::TessellatorOptions options;
    options.provenance = true;
    options.cracks.centre = centre;
    fast::Tessellator<float> engine(mesh, options);
    fast::DrawList<float> out;
    fast::DepthOptions depth;
    depth.strategy = fast::Strategy::kRandom;
    depth.depth = 4;
    engine.frame(depth, viewer(0), out);
    return meter.measure(out, viewer(0), 40000, fast::Kind::kFan).mean;
  };
  const double limit = error(fast::FanCentre::kLimit), flat = error(fast::FanCentre::kFlatControl);
  return trend(
      "T9", "a fan's centre on the limit surface beats the flat triangle's", flat / limit >= 1.3,
      fmt::format("mean error in pixels {:.3f} flat, {:.3f} limit: {:.2f} times", flat, limit, flat / limit));
}

/// Share of pixels, of those that show the object, that differ by more than 4/255 from uniform depth 5.
Json pictures_differ(Renderer& renderer) {
  std::vector<double> shares;
  for (const int faces : {200, 800, 4000}) {
    const auto mesh = data::bumpy_sphere(faces, kSphereSeed);
    fast::Tessellator<float> engine(mesh);
    std::vector<Image> images;
    for (const auto& [name, depth] : strategies()) {
      if (name != "uniform-5" && name != "combined") continue;
      fast::DrawList<float> out;
      engine.frame(depth, viewer(0), out);
      renderer.begin(viewer(0), 20);
      renderer.draw(out);
      images.push_back(renderer.image());
    }
    std::int64_t object = 0, other = 0;
    for (std::size_t p = 0; p < images[0].rgb.size(); p += 3) {
      int difference = 0;
      bool shown = false;
      for (std::size_t c = p; c < p + 3; ++c) {
        difference = std::max(difference, std::abs(images[0].rgb[c] - images[1].rgb[c]));
        shown = shown || images[0].rgb[c] != 255 || images[1].rgb[c] != 255;
      }
      object += shown, other += difference > 4;
    }
    shares.push_back(static_cast<double>(other) / static_cast<double>(object));
  }
  return trend("T10", "combined looks like deep uniform subdivision",
               *std::max_element(shares.begin(), shares.end()) < .05,
               "share of the object's pixels that differ by more than 4/255 from uniform 5, 200, 800 and "
               "4000 faces: " +
                   series(shares) + "; threshold 0.05");
}

}  // namespace

Json check_trends(const Json& spheres, bool quick) {
  const Table table(spheres["rows"]);
  Json list = Json::array();
  const auto culled =
      table.values("project-sphere", [](const Json& r) { return r["culled_share"].get<double>(); });
  list.push_back(trend("T1", "the share of faces seen from behind falls with their number",
                       falls(culled, .08), "by faces: " + series(culled)));

  const auto sphere = table.values("project-sphere", per_visible_face);
  const auto combined = table.values("combined", per_visible_face);
  bool above = true;
  for (std::size_t k = 0; k < sphere.size(); ++k) above = above && combined[k] >= sphere[k];
  list.push_back(trend("T2", "triangles per visible face fall with project-sphere, rise with combined",
                       falls(sphere, .08) && combined.back() > combined.front() && above,
                       "project-sphere: " + series(sphere) + "; combined: " + series(combined)));
  list.push_back(matched_error(table, "project-sphere"));
  list.push_back(matched_error(table, "combined"));

  const auto rate = [](const char* engine) {
    return [engine](const Json& r) { return r[engine]["frames_per_second"].get<double>(); };
  };
  const auto adaptive = table.values("project-sphere", rate("sliding_window"));
  const auto uniform = table.values("uniform-3", rate("sliding_window"));
  bool faster = true;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < adaptive.size(); ++k) {
    ratios.push_back(adaptive[k] / uniform[k]);
    faster = faster && ratios.back() > 1;
  }
  list.push_back(trend("T4", "project-sphere is faster than uniform depth 3, its heuristics and fans counted",
                       faster, "frames per second of one / of the other: " + series(ratios)));

  const auto single = table.values("combined", [](const Json& r) {
    return r["singletons"].get<double>() / (r["faces"].get<double>() * (1 - r["culled_share"].get<double>()));
  });
  list.push_back(trend("T5", "at most 1 % of the visible faces have no partner",
                       *std::max_element(single.begin(), single.end()) <= .01,
                       "combined: " + series(single)));

  std::vector<double> nanoseconds;
  for (int depth = 3; depth <= 5; ++depth) {
    const Json& row = table.of(fmt::format("uniform-{}", depth)).front();
    nanoseconds.push_back(1e9 * row["sliding_window"]["stages"]["window"].get<double>() /
                          row["sliding_window"]["frames_per_second"].get<double>() /
                          row["limit_points"].get<double>());
  }
  const auto step = [&](std::size_t k) { return std::abs(std::log(nanoseconds[k + 1] / nanoseconds[k])); };
  list.push_back(trend("T6", "time per limit point tends to a constant", step(1) < step(0),
                       "sliding window, depth 3 4 5, ns: " + series(nanoseconds)));

  const Json& eight = table.of("project-sphere")[2];
  const double fps = eight["sliding_window_drawn"]["frames_per_second"];
  list.push_back(
      trend("T7", "800 faces, some 10 000 triangles, more than 10 frames per second", fps > 10,
            fmt::format("{:.0f} triangles; {:.0f} frames per second drawn by {}, {:.0f} not drawn",
                        eight["triangles"].get<double>(), fps, spheres["renderer"].get<std::string>(),
                        eight["sliding_window"]["frames_per_second"].get<double>())));
  list.push_back(watertight(quick));
  list.push_back(fan_centre());
  Renderer renderer(viewer(0).width, viewer(0).height, 1);
  list.push_back(pictures_differ(renderer));
  return list;
}

}  // namespace limitcheck::bench
