// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <vector>

#include "bench/reproduction/scene.h"
#include "fast/stream/stream_tessellator.h"

namespace limitcheck::bench {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kRepetitions = 3;

template <class Engine>
Frame frame_of(const data::ControlMesh& mesh, const fast::TessellatorOptions& options) {
  return [engine = std::make_shared<Engine>(mesh, options)](
             const auto& depth, const auto& camera, auto& out) { return engine->frame(depth, camera, out); };
}

void add(fast::FrameStats& sum, const fast::FrameStats& s) {
  sum.faces += s.faces, sum.culled += s.culled, sum.pairs += s.pairs, sum.singletons += s.singletons;
  sum.fans += s.fans, sum.strips += s.strips, sum.triangles += s.triangles, sum.vertices += s.vertices;
  sum.limit_points += s.limit_points;
  sum.seconds_heuristics += s.seconds_heuristics, sum.seconds_pairing += s.seconds_pairing;
  sum.seconds_planning += s.seconds_planning, sum.seconds_evaluation += s.seconds_evaluation;
  sum.seconds_total += s.seconds_total;
}

}  // namespace

double seconds_of(Clock clock) {
  timespec t{};
  clock_gettime(clock == Clock::kProcessor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Frame sliding_window(const data::ControlMesh& mesh, int threads, fast::Repair repair) {
  return frame_of<fast::Tessellator<float>>(mesh, {.cracks = {.repair = repair}, .threads = threads});
}

Frame row_stream(const data::ControlMesh& mesh, int threads) {
  return frame_of<fast::row_stream::StreamTessellator>(mesh, {.threads = threads});
}

Turn turn(const Frame& frame, const fast::DepthOptions& depth, int frames, double seconds, Clock clock,
          const std::function<void(const fast::Camera&, const fast::DrawList<float>&)>& shown) {
  fast::DrawList<float> out;
  frame(depth, viewer(0), out);  // tables of the heuristics and memory are not part of a frame
  Turn result;
  std::vector<double> least;
  double all = 0, drawing = 0, fastest = 0, slowest = 0;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    double sum = 0;
    for (int k = 0; k < frames && (repetition > 0 ? k < result.frames : k == 0 || sum < seconds); ++k) {
      // Far apart first: a turn that is cut short has still seen all sides.
      const auto camera = viewer(std::fmod(k * .6180339887498949, 1.));
      const double start = seconds_of(clock);
      const fast::FrameStats stats = frame(depth, camera, out);
      const double tessellated = seconds_of(clock);
      if (shown) shown(camera, out);
      const double end = seconds_of(clock);
      sum += end - start, drawing += end - tessellated;
      if (repetition == 0) {
        ++result.frames;
        least.push_back(end - start);
        add(result.sum, stats);
      } else {
        least[k] = std::min(least[k], end - start);
      }
    }
    all += sum;
    fastest = repetition == 0 ? sum : std::min(fastest, sum), slowest = std::max(slowest, sum);
  }
  for (const double s : least) result.seconds += s;
  result.spread = fastest > 0 ? slowest / fastest : 1;
  result.shown_share = shown && all > 0 ? drawing / all : 0;
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
  const auto share = [&](double s) { return (1 - t.shown_share) * s / t.sum.seconds_total; };
  return {{"frames", t.frames},
          {"frames_per_second", t.frames / t.seconds},
          {"spread", t.spread},
          {"stages",
           {{"heuristics", share(t.sum.seconds_heuristics)},
            {"pairing", share(t.sum.seconds_pairing)},
            {"cracks", share(t.sum.seconds_planning)},
            {"window", share(t.sum.seconds_evaluation)},
            {"drawing", t.shown_share}}}};
}

Json picture(const verify::Difference& d) {
  return {{"mean", d.mean},   {"median", d.median},   {"percentile_99", d.percentile_99},
          {"share", d.share}, {"missing", d.missing}, {"extra", d.extra}};
}

}  // namespace limitcheck::bench
