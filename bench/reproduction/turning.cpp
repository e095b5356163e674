// SPDX-License-Identifier: MIT
#include "bench/reproduction/turning.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "bench/reproduction/scene.h"
#include "fast/row_stream/stream_frame.h"

namespace limitcheck::bench {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

fast::TessellatorOptions options(int threads, fast::Repair repair = fast::Repair::kFan) {
  fast::TessellatorOptions o;
  o.threads = threads;
  o.cracks.repair = repair;
  return o;
}

}  // namespace

Frame sliding_window(const data::ControlMesh& mesh, int threads, fast::Repair repair) {
  auto engine = std::make_shared<fast::Tessellator<float>>(mesh, options(threads, repair));
  return [engine](const auto& depth, const auto& camera, auto& out) {
    return engine->frame(depth, camera, out);
  };
}

Frame row_stream(const data::ControlMesh& mesh, int threads) {
  auto engine = std::make_shared<fast::row_stream::StreamTessellator>(mesh, options(threads));
  return [engine](const auto& depth, const auto& camera, auto& out) {
    return engine->frame(depth, camera, out);
  };
}

Turn turn(const Frame& frame, const fast::DepthOptions& depth, int frames, double seconds,
          const std::function<void(const fast::Camera&, const fast::DrawList<float>&)>& shown) {
  fast::DrawList<float> out;
  frame(depth, viewer(0), out);  // tables of the heuristics and memory are not part of a frame
  Turn result;
  for (int k = 0; k < frames && (k == 0 || result.seconds < seconds); ++k) {
    // Far apart first: a turn that is cut short has still seen all sides.
    const auto camera = viewer(std::fmod(k * .6180339887498949, 1.));
    const auto start = Clock::now();
    const fast::FrameStats s = frame(depth, camera, out);
    const double tessellated = since(start);
    if (shown) shown(camera, out);
    const double whole = since(start);
    result.seconds += whole;
    if (shown) result.shown += whole - tessellated;
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
  const auto share = [&](double s) { return s / t.seconds; };
  return {{"frames", t.frames},
          {"frames_per_second", t.frames / t.seconds},
          {"stages",
           {{"heuristics", share(t.sum.seconds_heuristics)},
            {"pairing", share(t.sum.seconds_pairing)},
            {"cracks", share(t.sum.seconds_planning)},
            {"window", share(t.sum.seconds_evaluation)},
            {"drawing", share(t.shown)}}}};
}

PixelError turned_error(const data::ControlMesh& mesh, const PixelErrorMeter& meter,
                        const fast::DepthOptions& depth, fast::Repair repair) {
  auto all = options(0, repair);
  all.provenance = true;
  fast::Tessellator<float> engine(mesh, all);
  fast::DrawList<float> out;
  PixelError worst;
  constexpr int kViews = 3;
  for (int view = 0; view < kViews; ++view) {
    const auto camera = viewer(static_cast<double>(view) / kViews);
    engine.frame(depth, camera, out);
    const PixelError e = meter.measure(out, camera, 8000);
    worst.silhouette_99 = std::max(worst.silhouette_99, e.silhouette_99);
    worst.interior_99 = std::max(worst.interior_99, e.interior_99);
    worst.silhouette_worst = std::max(worst.silhouette_worst, e.silhouette_worst);
    worst.interior_worst = std::max(worst.interior_worst, e.interior_worst);
    worst.mean += e.mean / kViews;
    worst.samples += e.samples;
  }
  return worst;
}

}  // namespace limitcheck::bench
