// SPDX-License-Identifier: MIT
// Does what the paper says of its figures hold? The trends that a reproduction must show.    [T1-T10]
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "bench/render/renderer.h"
#include "bench/reproduction/pixel_error.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/frame.h"
#include "verify/audit/lattice.h"
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

/// What uniform depth needs / what the strategy needs for the error of uniform depth 3, by faces.
struct Advantage {
  std::vector<double> triangles, frames;
  bool always = true;
};
Advantage advantage(const Json& matched, const std::string& strategy, const std::string& measure) {
  Advantage result;
  for (const Json& row : matched["rows"]) {
    if (row["measure"] != measure || row["as"] != "uniform-3") continue;
    const Json& it = row[strategy];
    const auto ratio = [&](const char* what, bool more_is_better) {
      if (it.is_null()) return 0.;  // no setting reaches that error
      const double a = row["uniform"][what], b = it[what];
      return more_is_better ? b / a : a / b;
    };
    result.triangles.push_back(ratio("triangles", false));
    result.frames.push_back(ratio("frames_per_second", true));
    result.always = result.always && std::min(result.triangles.back(), result.frames.back()) > 1;
  }
  return result;
}

Json matched_error(const Json& matched, const std::string& strategy) {
  const Advantage fans = advantage(matched, strategy, "interior_99");
  std::string figures = fmt::format("99 % of the interior, triangles {}, frames per second {}",
                                    series(fans.triangles), series(fans.frames));
  const auto more = [&](const char* text, const std::string& family, const char* measure) {
    const Advantage a = advantage(matched, family, measure);
    figures += fmt::format("; {}: {}, {}", text, series(a.triangles), series(a.frames));
  };
  more("the same of the silhouette", strategy, "silhouette_99");
  more("of the mean error", strategy, "mean");
  more("interior, stitched instead of the paper's fans", strategy + ", stitched", "interior_99");
  return trend(
      "T3",
      fmt::format("at the error of uniform depth 3, {} draws fewer triangles and more frames", strategy),
      fans.always, "advantage by faces (above 1: adaptive is better): " + figures);
}

/// Points that several faces share, over a frame: how many of them have not the same bits in all.
std::int64_t differing_bits(const data::ControlMesh& mesh, const fast::DepthOptions& depth) {
  const auto out = frame_seen(mesh, depth);
  const verify::Lattice lattice(mesh, fast::TessellatorOptions{}.max_depth);
  using Bits = std::array<std::uint32_t, 6>;
  std::unordered_map<verify::Lattice::Id, Bits> known;
  std::unordered_set<verify::Lattice::Id> different;
  for (std::size_t v = 0; v < out.vertices.size(); ++v) {
    const auto& p = out.provenance[v];
    const auto id = lattice.id({p.face, p.i, p.j, p.denominator});
    const auto [first, fresh] = known.emplace(id, std::bit_cast<Bits>(out.vertices[v]));
    if (!fresh && first->second != std::bit_cast<Bits>(out.vertices[v])) different.insert(id);
  }
  return static_cast<std::int64_t>(different.size());
}

/// Seconds in windows per limit point, uniform depth; the least of some frames.
double seconds_per_point(const data::ControlMesh& mesh, int depth, int frames) {
  struct Forget : fast::DrawSink<float> {
    void draw(const fast::Draw&, std::span<const fast::SurfaceVertex<float>>,
              std::span<const fast::LatticePoint>) override {}
  } sink;
  fast::TessellatorOptions options;
  options.threads = 1;
  fast::Tessellator<float> engine(mesh, options);
  const std::vector<std::int32_t> depths(mesh.triangles.size(), depth);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < frames; ++k) {
    const auto stats = engine.frame(depths, sink);
    least = std::min(least, stats.seconds_evaluation / static_cast<double>(stats.limit_points));
  }
  return least;
}

Json time_per_point(bool quick) {
  const auto mesh = data::bumpy_sphere(200, kSphereSeed);
  std::vector<double> nanoseconds;
  for (int depth = 3; depth <= 7; ++depth)
    nanoseconds.push_back(1e9 * seconds_per_point(mesh, depth, (quick ? 2 : 10) << (7 - depth)));
  const auto [least, most] = std::minmax_element(nanoseconds.begin() + 2, nanoseconds.end());
  return trend("T6", "time per limit point tends to a constant: at depths 5, 6 and 7 within 25 %",
               *most < 1.25 * *least, "sliding window, depth 3 4 5 6 7, ns: " + series(nanoseconds));
}

std::int64_t open_edges(const data::ControlMesh& mesh, const fast::DepthOptions& depth) {
  fast::Tessellator<float> engine(mesh);
  fast::IndexedMesh<float> out;
  engine.frame(depth, viewer(0), out);
  const std::vector<float> positions = coordinates(out);
  const auto merged = verify::merge_identical(std::span<const float>(positions));
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const auto& t : out.triangles)
    triangles.push_back({merged.point_of[t[0]], merged.point_of[t[1]], merged.point_of[t[2]]});
  const auto report = verify::inspect_surface(static_cast<std::int64_t>(merged.vertex_of.size()), triangles);
  return static_cast<std::int64_t>(report.open_edges.size()) + report.crowded_edges + report.clashing_edges;
}

Json watertight(bool quick) {
  std::int64_t bad = 0, bits = 0;
  int frames = 0;
  for (const int faces : {200, 800, 4000}) {
    const auto mesh = data::bumpy_sphere(faces, kSphereSeed);
    for (std::uint64_t seed = 1; seed <= (quick ? 2u : 10u); ++seed, ++frames) {
      fast::DepthOptions depth;
      depth.strategy = fast::Strategy::kRandom;
      depth.depth = 4;
      depth.seed = seed;
      bad += open_edges(mesh, depth);
      bits += differing_bits(mesh, depth);
    }
  }
  return trend(
      "T8", "no cracks between faces of unequal depth", bad == 0 && bits == 0,
      fmt::format("{} open or mismatched edges and {} shared points with differing bits in {} frames of "
                  "random depths",
                  bad, bits, frames));
}

/// Mean distance of fans from the surface with a flat centre, over that with the centre on the limit surface.
Json fan_centre() {
  const auto mesh = data::bumpy_sphere(800, kSphereSeed);
  const PixelErrorMeter meter(mesh, 5);
  const auto error = [&](fast::FanCentre centre) {
    fast::TessellatorOptions options;
    options.cracks.centre = centre;
    fast::DepthOptions depth;
    depth.strategy = fast::Strategy::kRandom;
    depth.depth = 4;
    return meter.measure(frame_seen(mesh, depth, options), viewer(0), 40000, fast::Kind::kFan).mean;
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

Json check_trends(const Json& spheres, const Json& matched, bool quick) {
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
  list.push_back(matched_error(matched, "project-sphere"));
  list.push_back(matched_error(matched, "combined"));

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

  const auto single = [](const Json& r) {
    return r["singletons"].get<double>() / (r["faces"].get<double>() * (1 - r["culled_share"].get<double>()));
  };
  const auto seen = table.values("combined", single), everything = table.values("uniform-3", single);
  list.push_back(
      trend("T5", "at most 1 % of the faces have no partner",
            std::max(*std::max_element(seen.begin(), seen.end()),
                     *std::max_element(everything.begin(), everything.end())) <= .01,
            "uniform: " + series(everything) +
                "; combined, of those that are not culled, which alone are paired: " + series(seen)));

  list.push_back(time_per_point(quick));

  const Json& eight = table.of("project-sphere")[2];
  const double fps = eight["sliding_window_drawn"]["frames_per_second"];
  const Json& drawn = eight["sliding_window_drawn"];
  std::string stages;
  for (const auto& [name, share] : drawn["stages"].items())
    stages += fmt::format("{}{} {:.0f} %", stages.empty() ? "" : ", ", name, 100 * share.get<double>());
  const double triangles = eight["triangles"];
  list.push_back(trend(
      "T7", "800 faces, some 10 000 triangles, more than 10 frames per second", fps > 10,
      fmt::format(
          "{:.0f} triangles, {:.3g} frames and {:.2g} million triangles per second drawn by {} ({}); {:.3g} "
          "frames per second not drawn",
          triangles, fps, triangles * fps / 1e6, spheres["renderer"].get<std::string>(), stages,
          eight["sliding_window"]["frames_per_second"].get<double>())));
  list.push_back(watertight(quick));
  list.push_back(fan_centre());
  Renderer renderer(viewer(0).width, viewer(0).height, 1);
  list.push_back(pictures_differ(renderer));
  return list;
}

}  // namespace limitcheck::bench
