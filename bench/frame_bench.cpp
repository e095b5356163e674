// SPDX-License-Identifier: MIT
// Frames of a bumpy sphere that turns from frame to frame, by one degree unless the name says otherwise: from
// the camera to the triangles. Names: form/strategy/faces:N/threads:T; counters: frames/s, triangles/s.
//   draw                  a list of strips and fans
//   indexed               one mesh
//   patches, compact      points once and index patterns; the same with 16 bytes a vertex
//   kept, sticky          patches that stay as they are keep their places; pairs stay together, too
//   deforming             as patches, but the control points move before each frame
//   deforming:depths, still:depths   the same at given depths, with and without moving
//   bfr                   OpenSubdiv's Bfr, the points of the same faces at the same depths
// With --gl alone, by OpenGL's device, whose memory keeps the points:
//   gl, gl-compact, gl-kept, gl-deforming   as those above
// And what a frame costs before its first point is computed: adjacency, rings, the per-mesh part of the heuristics, the
// depths of one view, the pairing. Names: stage/variant/bumpy/faces:N; `per_face` is the time per control face.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/cases/shapes.h"
#include "bench/contenders/contender.h"
#include "fast/plan/printed_rules.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/gl/resident_frame.h"

namespace {

using namespace limitcheck;
using benchmark::Counter;

const data::ControlMesh& bumpy(int faces) {
  return bench::mesh_of({"bumpy", faces});
}

/// The camera in step i of a walk around the mesh, so many degrees a step.
fast::Camera turned(std::int64_t i, double degrees) {
  const double angle = static_cast<double>(i) * degrees * std::numbers::pi / 180;
  return {.eye = {4 * std::sin(angle), 0, 4 * std::cos(angle)}};
}

struct Case {
  std::string name;
  int faces;
  fast::DepthOptions strategy;
};

std::vector<Case> cases() {
  using enum fast::Strategy;
  return {{"project-sphere:60", 800, {.strategy = kProjectSphere, .target_pixels = 60}},
          {"uniform:1", 800, {.strategy = kUniform, .depth = 1}},
          {"uniform:3", 800, {.strategy = kUniform, .depth = 3}},
          {"uniform:5", 800, {.strategy = kUniform, .depth = 5}},
          {"combined", 4000, {.strategy = kCombined}},
          {"project-sphere:10", 4000, {.strategy = kProjectSphere, .target_pixels = 10}}};
}

void count(benchmark::State& state, double triangles, Counter::Flags flags) {
  state.counters["frames/s"] = Counter(1, Counter::kIsIterationInvariantRate);
  state.counters["triangles/s"] = Counter(triangles, flags);
}

// The mesh breathes: its points move along their own directions, by up to a twentieth.
std::vector<std::vector<std::array<double, 3>>> breaths(const data::ControlMesh& mesh) {
  std::vector<std::vector<std::array<double, 3>>> all(16, mesh.positions);
  for (std::size_t k = 0; k < all.size(); ++k)
    for (auto& p : all[k]) {
      const double phase = 2 * std::numbers::pi * (static_cast<double>(k) / 16 + p[0]);
      for (double& x : p) x *= 1 + .05 * std::sin(phase);
    }
  return all;
}

/// show(strategy, camera): a frame, returns its FrameStats.
template <class Show>
void shown(benchmark::State& state, const Case& c, double degrees, const Show& show) {
  double triangles = 0;
  for (std::int64_t i = 0; i < 360; i += 30) show(c.strategy, turned(i, 1));
  for (std::int64_t i = -20; i < 0; ++i) show(c.strategy, turned(i, degrees));
  std::int64_t i = 0;
  for (auto _ : state) {
    triangles += static_cast<double>(show(c.strategy, turned(i++, degrees)).triangles);
    benchmark::ClobberMemory();
  }
  count(state, triangles, Counter::kIsRate);
}

template <class Output>
void frames(benchmark::State& state, const Case& c, int threads, Output out = {}, double degrees = 1) {
  fast::row_stream::StreamTessellator tessellator(bumpy(c.faces), {.threads = threads});
  shown(state, c, degrees, [&](const auto&... wanted) { return tessellator.frame(wanted..., out); });
}

void frames_by_gl(benchmark::State& state, const Case& c, const fast::PatchOptions& form, bool moves) {
  verify::ResidentFrame frame(bumpy(c.faces), {}, form);
  const auto points = breaths(bumpy(c.faces));
  std::size_t i = 0;
  shown(state, c, 1, [&](const auto&... wanted) {
    if (moves) frame.move_points(points[++i % points.size()]);
    const fast::FrameStats stats = frame.plan(wanted...);
    frame.run();
    return stats;
  });
}

/// `moves`: else the frames are as they would be if the points had not moved.
void deforming(benchmark::State& state, const Case& c, bool moves, bool same_depths) {
  fast::row_stream::StreamTessellator tessellator(bumpy(c.faces), {.threads = 1});
  const auto points = breaths(bumpy(c.faces));
  fast::PatchMesh<float> out;
  tessellator.frame(c.strategy, turned(0, 1), out);
  const std::vector<std::int32_t> depth = tessellator.last_pairing().depth;
  double triangles = 0;
  std::size_t i = 0;
  for (auto _ : state) {
    ++i;
    if (moves) tessellator.move_points(points[i % points.size()]);
    const fast::FrameStats stats =
        same_depths ? tessellator.frame(depth, out)
                    : tessellator.frame(c.strategy, turned(static_cast<std::int64_t>(i), 1), out);
    triangles += static_cast<double>(stats.triangles);
    benchmark::ClobberMemory();
  }
  count(state, triangles, Counter::kIsRate);
}

/// OpenSubdiv's Bfr, a surface for each face made and forgotten: the faces and depths of one of the frames,
/// points alone.
void bfr(benchmark::State& state, const Case& c) {
  fast::row_stream::StreamTessellator tessellator(bumpy(c.faces));
  fast::PatchMesh<float> out;
  const fast::FrameStats stats = tessellator.frame(c.strategy, turned(0, 1), out);
  const auto peer = bench::bfr_frame(bumpy(c.faces), tessellator.last_pairing().depth);
  for (auto _ : state) peer();
  count(state, static_cast<double>(stats.triangles), Counter::kIsIterationInvariantRate);
}

/// Processor time of one thread, which others on the machine do not add to; of more the time on the wall.
template <class Function>
void add(const std::string& name, Function function) {
  auto* one = benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMicrosecond);
  if (!name.ends_with("threads:1")) one->UseRealTime();
}

/// `stage(mesh, adjacency, heuristics)` returns what is timed.
template <class Stage>
void add_set_up(const std::string& name, Stage stage) {
  for (const int faces : {800, 4000, 100'000, 1'000'000})
    benchmark::RegisterBenchmark(
        (name + "/bumpy/faces:" + std::to_string(faces)).c_str(), [=](benchmark::State& state) {
          const data::ControlMesh& mesh = bumpy(faces);
          const fast::Adjacency adjacency(mesh);
          const fast::DepthHeuristics heuristics(mesh, adjacency);
          const auto run = stage(mesh, adjacency, heuristics);
          run();  // lazily prepared tables are not part of a frame
          for (auto _ : state) run();
          state.counters["per_face"] =
              Counter(static_cast<double>(state.iterations()) * faces, Counter::kIsRate | Counter::kInvert);
        });
}

void add_set_ups() {
  using fast::Strategy, fast::DepthOptions, benchmark::DoNotOptimize;
  add_set_up("adjacency/build", [](const auto& mesh, const auto&, const auto&) {
    return [&] { DoNotOptimize(fast::Adjacency(mesh).max_valence()); };
  });
  add_set_up("rings/build", [](const auto& mesh, const auto& adjacency, const auto&) {
    return [&] { DoNotOptimize(fast::row_stream::Rings(mesh, adjacency).degenerate_normals()); };
  });
  add_set_up("depth/per-mesh", [](const auto& mesh, const auto& adjacency, const auto&) {
    return [&] { DoNotOptimize(fast::DepthHeuristics(mesh, adjacency).degenerate_normals()); };
  });
  add_set_up("depth/per-mesh-with-cones", [](const auto& mesh, const auto& adjacency, const auto&) {
    return [&] { DoNotOptimize(fast::DepthHeuristics(mesh, adjacency).cone_cosine(0, 0)); };
  });
  for (const Strategy s : {Strategy::kUniform, Strategy::kRandom, Strategy::kProjectSphere,
                           Strategy::kCurvature, Strategy::kCombined}) {
    const std::string name(fast::name(s));
    add_set_up("depth/" + name, [s](const auto&, const auto&, const auto& heuristics) {
      return [&, s] { DoNotOptimize(heuristics.depths(DepthOptions{.strategy = s}, {}).data()); };
    });
    if (s == Strategy::kProjectSphere || s == Strategy::kCurvature) continue;
    for (const auto& [rule, word] :
         {std::pair{fast::PairingRule::kCorrected, "corrected-"}, {fast::PairingRule::kPrinted, "printed-"}})
      add_set_up("pairing/" + (word + name), [s, rules = fast::PrintedRules{rule}](
                                                 const auto&, const auto& adjacency, const auto& heuristics) {
        return [&, rules, depth = heuristics.depths(DepthOptions{.strategy = s}, {})] {
          DoNotOptimize(fast::pair_faces(adjacency, depth, rules).singletons);
        };
      });
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool gl = argc > 1 && std::string_view(argv[1]) == "--gl";
  if (gl) argv[1] = argv[0], ++argv, --argc;
  for (const Case& c : cases()) {
    const std::string name = c.name + "/faces:" + std::to_string(c.faces);
    if (gl) {
      const auto by_gl = [&](const char* form, const fast::PatchOptions& with, bool moves) {
        add(form + ("/" + name), [=](auto& s) { frames_by_gl(s, c, with, moves); });
      };
      by_gl("gl", {}, false);
      by_gl("gl-compact", {.compact = true}, false);
      by_gl("gl-kept", {.incremental = true}, false);
      by_gl("gl-deforming", {}, true);
      continue;
    }
    for (const int threads : {1, 2})
      add("draw/" + name + "/threads:" + std::to_string(threads),
          [=](auto& s) { frames<fast::DrawList<float>>(s, c, threads); });
    const auto patches = [&](const std::string& form, const fast::PatchOptions& with, double degrees) {
      add(form + "/" + name + "/threads:1",
          [=](auto& s) { frames(s, c, 1, fast::PatchMesh<float>(with), degrees); });
    };
    patches("patches", {}, 1);
    patches("compact", {.compact = true}, 1);
    for (const double degrees : {1., .25}) {
      const std::string step = degrees == 1 ? "" : ":quarter";
      patches("kept" + step, {.incremental = true}, degrees);
      patches("sticky" + step, {.incremental = true, .sticky = true}, degrees);
    }
    if (c.strategy.strategy != fast::Strategy::kUniform)
      add("deforming/" + name + "/threads:1", [=](auto& s) { deforming(s, c, true, false); });
    add("deforming:depths/" + name + "/threads:1", [=](auto& s) { deforming(s, c, true, true); });
    add("still:depths/" + name + "/threads:1", [=](auto& s) { deforming(s, c, false, true); });
    add("bfr/" + name + "/threads:1", [=](auto& s) { bfr(s, c); });
    add("indexed/" + name + "/threads:1", [=](auto& s) { frames<fast::IndexedMesh<float>>(s, c, 1); });
  }
  if (!gl) add_set_ups();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
