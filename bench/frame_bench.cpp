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
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "bench/contenders/contender.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/stream/stream_tessellator.h"

namespace {

using namespace limitcheck;
using benchmark::Counter;

const data::ControlMesh& mesh_of(int faces) {
  static std::map<int, data::ControlMesh> known;
  const auto [at, fresh] = known.try_emplace(faces);
  if (fresh) at->second = data::bumpy_sphere(faces, 1);
  return at->second;
}

/// The camera in step i of a walk around the mesh, so many degrees a step.
fast::Camera turned(std::int64_t i, double degrees) {
  const double angle = static_cast<double>(i) * degrees * std::numbers::pi / 180;
  fast::Camera camera;
  camera.eye = {4 * std::sin(angle), 0, 4 * std::cos(angle)};
  return camera;
}

struct Case {
  std::string name;
  int faces;
  fast::DepthOptions strategy;
};

std::vector<Case> cases() {
  const auto uniform = [](int depth) {
    fast::DepthOptions o;
    o.strategy = fast::Strategy::kUniform;
    o.depth = depth;
    return o;
  };
  const auto adaptive = [](fast::Strategy strategy, double pixels) {
    fast::DepthOptions o;
    o.strategy = strategy;
    o.target_pixels = pixels;
    return o;
  };
  const fast::DepthOptions combined = adaptive(fast::Strategy::kCombined, fast::DepthOptions{}.target_pixels);
  return {{"project-sphere:60", 800, adaptive(fast::Strategy::kProjectSphere, 60)},
          {"uniform:1", 800, uniform(1)},
          {"uniform:3", 800, uniform(3)},
          {"uniform:5", 800, uniform(5)},
          {"combined", 4000, combined},
          {"project-sphere:10", 4000, adaptive(fast::Strategy::kProjectSphere, 10)}};
}

void count(benchmark::State& state, double triangles, Counter::Flags flags) {
  state.counters["frames/s"] = Counter(1, Counter::kIsIterationInvariantRate);
  state.counters["triangles/s"] = Counter(triangles, flags);
}

template <class Output>
void frames(benchmark::State& state, const Case& c, int threads, Output out = {}, double degrees = 1) {
  fast::TessellatorOptions options;
  options.threads = threads;
  fast::row_stream::StreamTessellator tessellator(mesh_of(c.faces), options);
  fast::FrameStats stats;
  double triangles = 0;
  for (std::int64_t i = 0; i < 360; i += 30) tessellator.frame(c.strategy, turned(i, 1), out);
  for (std::int64_t i = -20; i < 0; ++i) tessellator.frame(c.strategy, turned(i, degrees), out);
  std::int64_t i = 0;
  for (auto _ : state) {
    stats = tessellator.frame(c.strategy, turned(i++, degrees), out);
    triangles += static_cast<double>(stats.triangles);
    benchmark::ClobberMemory();
  }
  count(state, triangles, Counter::kIsRate);
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

/// `moves`: else the frames are as they would be if the points had not moved.
void deforming(benchmark::State& state, const Case& c, bool moves, bool same_depths) {
  fast::TessellatorOptions options;
  options.threads = 1;
  fast::row_stream::StreamTessellator tessellator(mesh_of(c.faces), options);
  const auto points = breaths(mesh_of(c.faces));
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
  fast::row_stream::StreamTessellator tessellator(mesh_of(c.faces));
  fast::PatchMesh<float> out;
  const fast::FrameStats stats = tessellator.frame(c.strategy, turned(0, 1), out);
  const auto peer = bench::bfr_frame(mesh_of(c.faces), tessellator.last_pairing().depth);
  for (auto _ : state) peer->run();
  count(state, static_cast<double>(stats.triangles), Counter::kIsIterationInvariantRate);
}

/// Processor time of one thread, which others on the machine do not add to; of more the time on the wall.
template <class Function>
void add(const std::string& name, Function function) {
  auto* one = benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMicrosecond);
  if (!name.ends_with("threads:1")) one->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  for (const Case& c : cases()) {
    const std::string name = c.name + "/faces:" + std::to_string(c.faces);
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
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
