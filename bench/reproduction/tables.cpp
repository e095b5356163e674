// SPDX-License-Identifier: MIT
// The numbers behind Fig. 11 and Fig. 12: bumpy spheres turned before the viewer, by every strategy.
// [C72-C78]
#include <fmt/core.h>
#include <tbb/info.h>

#include <chrono>
#include <functional>
#include <memory>

#include "bench/render/renderer.h"
#include "bench/reproduction/pixel_error.h"
#include "bench/reproduction/reproduction.h"
#include "bench/reproduction/scene.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/frame.h"
#include "fast/row_stream/stream_frame.h"
#include "verify/cli/progress.h"

namespace limitcheck::bench {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One engine on one mesh: a frame of a strategy seen from somewhere.
using Frame =
    std::function<fast::FrameStats(const fast::DepthOptions&, const fast::Camera&, fast::DrawList<float>&)>;

fast::TessellatorOptions options(int threads, bool provenance = false) {
  fast::TessellatorOptions o;
  o.threads = threads;
  o.provenance = provenance;
  return o;
}

Frame sliding_window(const data::ControlMesh& mesh, int threads) {
  auto engine = std::make_shared<fast::Tessellator<float>>(mesh, options(threads));
  return [engine](const auto& depth, const auto& camera, auto& out) {
    return engine->frame(depth, camera, out);
  };
}

Frame row_stream(const data::ControlMesh& mesh, int threads) {
  struct Engine {
    Engine(const data::ControlMesh& m, int t) : stream(m, options(t)), heuristics(m, stream.adjacency()) {}
    fast::row_stream::StreamTessellator stream;
    fast::DepthHeuristics heuristics;
  };
  auto engine = std::make_shared<Engine>(mesh, threads);
  return [engine](const auto& depth, const auto& camera, auto& out) {
    const auto start = Clock::now();
    const auto depths = engine->heuristics.depths(depth, camera);
    const double heuristics = since(start);
    fast::FrameStats stats = engine->stream.frame(depths, out);
    stats.seconds_heuristics = heuristics;
    stats.seconds_total += heuristics;
    return stats;
  };
}

/// Sums over the frames of a turn.
struct Turn {
  int frames = 0;
  double seconds = 0;
  fast::FrameStats sum;
};

/// At least one frame; more of them, evenly round, until the time is up.
Turn turn(const Frame& frame, const fast::DepthOptions& depth, int frames, double seconds,
          const std::function<void(const fast::Camera&, const fast::DrawList<float>&)>& shown = {}) {
  fast::DrawList<float> out;
  frame(depth, viewer(0), out);  // tables of the heuristics and memory are not part of a frame
  Turn result;
  for (int k = 0; k < frames && (k == 0 || result.seconds < seconds); ++k) {
    // Far apart first: a turn that is cut short has still seen all sides.
    const auto camera = viewer(std::fmod(k * .6180339887498949, 1.));
    const auto start = Clock::now();
    const fast::FrameStats s = frame(depth, camera, out);
    if (shown) shown(camera, out);
    result.seconds += since(start);
    ++result.frames;
    auto& sum = result.sum;
    sum.faces += s.faces, sum.culled += s.culled, sum.pairs += s.pairs, sum.singletons += s.singletons;
    sum.fans += s.fans, sum.strips += s.strips, sum.triangles += s.triangles, sum.vertices += s.vertices;
    sum.limit_points += s.limit_points;
    sum.seconds_heuristics += s.seconds_heuristics, sum.seconds_pairing += s.seconds_pairing;
    sum.seconds_planning += s.seconds_planning, sum.seconds_evaluation += s.seconds_evaluation;
    sum.seconds_total += s.seconds_total;
  }
  return result;
}

Json counts(const Turn& t) {
  const auto mean = [&](std::int64_t n) { return static_cast<double>(n) / t.frames; };
  return {{"triangles", mean(t.sum.triangles)},
          {"strips", mean(t.sum.strips)},
          {"fans", mean(t.sum.fans)},
          {"pairs", mean(t.sum.pairs)},
          {"singletons", mean(t.sum.singletons)},
          {"culled_share", static_cast<double>(t.sum.culled) / static_cast<double>(t.sum.faces)},
          {"limit_points", mean(t.sum.limit_points)}};
}

Json timing(const Turn& t) {
  const auto share = [&](double s) { return s / t.sum.seconds_total; };
  return {{"frames", t.frames},
          {"frames_per_second", t.frames / t.seconds},
          {"stages",
           {{"heuristics", share(t.sum.seconds_heuristics)},
            {"pairing", share(t.sum.seconds_pairing)},
            {"cracks", share(t.sum.seconds_planning)},
            {"window", share(t.sum.seconds_evaluation)}}}};
}

Json error_of(const data::ControlMesh& mesh, const PixelErrorMeter& meter, const fast::DepthOptions& depth) {
  fast::Tessellator<float> engine(mesh, options(0, true));
  fast::DrawList<float> out;
  PixelError worst;
  for (const double at : {0., 1. / 3, 2. / 3}) {
    engine.frame(depth, viewer(at), out);
    const PixelError e = meter.measure(out, viewer(at), 8000);
    worst.silhouette_99 = std::max(worst.silhouette_99, e.silhouette_99);
    worst.interior_99 = std::max(worst.interior_99, e.interior_99);
    worst.silhouette_worst = std::max(worst.silhouette_worst, e.silhouette_worst);
    worst.interior_worst = std::max(worst.interior_worst, e.interior_worst);
    worst.samples += e.samples;
  }
  return {{"silhouette_99", worst.silhouette_99},
          {"silhouette_worst", worst.silhouette_worst},
          {"interior_99", worst.interior_99},
          {"interior_worst", worst.interior_worst},
          {"samples", worst.samples}};
}

}  // namespace

Json sphere_table(bool quick) {
  const int all = tbb::info::default_concurrency();
  const fast::Camera camera = viewer(0);
  Renderer renderer(camera.width, camera.height, 1);
  const auto draw = [&](const fast::Camera& from, const fast::DrawList<float>& frame) {
    renderer.begin(from, 20);
    renderer.draw(frame);
    renderer.finish();
  };

  const double seconds = quick ? .03 : .3;
  const int frames = quick ? 8 : 36;
  Json rows = Json::array();
  cli::Progress progress;
  std::size_t done = 0;
  for (const int faces : kSphereFaces) {
    const data::ControlMesh mesh = data::bumpy_sphere(faces, kSphereSeed);
    const PixelErrorMeter meter(mesh, 5);
    const Frame window = sliding_window(mesh, 1), window_all = sliding_window(mesh, all);
    const Frame stream = row_stream(mesh, 1), stream_all = row_stream(mesh, all);
    for (const auto& [name, depth] : strategies()) {
      progress.show(done++, std::size(kSphereFaces) * 7, fmt::format("{} faces, {}", faces, name));
      const Turn counted = turn(window, depth, frames, seconds);
      Json row{{"faces", faces}, {"strategy", name}};
      row.update(counts(counted));
      row["sliding_window"] = timing(counted);
      row["sliding_window_all_threads"] = timing(turn(window_all, depth, frames, seconds));
      row["sliding_window_drawn"] = timing(turn(window, depth, frames, seconds, draw));
      row["row_stream"] = timing(turn(stream, depth, frames, seconds));
      row["row_stream_all_threads"] = timing(turn(stream_all, depth, frames, seconds));
      row["row_stream_drawn"] = timing(turn(stream, depth, frames, seconds, draw));
      row["error_pixels"] = error_of(mesh, meter, depth);
      rows.push_back(std::move(row));
    }
  }
  progress.clear();
  return {{"renderer", renderer.name()},
          {"threads", all},
          {"viewport", {camera.width, camera.height}},
          {"seed", kSphereSeed},
          {"rows", std::move(rows)}};
}

}  // namespace limitcheck::bench
