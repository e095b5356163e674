// SPDX-License-Identifier: MIT
// The sliding window: cost per limit point and stage. [mueller2000, 4.3; claims C51, C55]
#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/tessellator.h"

namespace {

using namespace limitcheck;

const data::ControlMesh& mesh_of(int faces) {
  static std::vector<std::pair<int, std::unique_ptr<data::ControlMesh>>> known;
  for (const auto& [n, mesh] : known)
    if (n == faces) return *mesh;
  known.emplace_back(faces, std::make_unique<data::ControlMesh>(data::bumpy_sphere(faces, 1)));
  return *known.back().second;
}

/// One thread, every pair of the mesh, the strips looked at and forgotten.
template <class Real, bool Carry>
void window(benchmark::State& state, int faces, int depth) {
  const auto& mesh = mesh_of(faces);
  const fast::Adjacency adjacency(mesh);
  const fast::PreparedMesh<Real> prepared(adjacency, fast::positions_of<Real>(mesh));
  const auto pairing = fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth));
  fast::SlidingWindow<Real, fast::LimitSurface<Real>, fast::NoProbe, Carry> sliding(depth,
                                                                                    adjacency.max_valence());
  for (auto _ : state) {
    for (const fast::Grid& pair : pairing.grids)
      sliding.run(prepared, 3 * pair.face0 + pair.edge0, depth,
                  [](int, const fast::SurfaceVertex<Real>* strip) { benchmark::DoNotOptimize(strip); });
  }
  const double side = (1 << depth) + 1;
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(pairing.grids.size()) * side * side,
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

/// Whole frames at one depth; the share of each stage.
template <class Output>
void frame(benchmark::State& state, int faces, int depth, int threads) {
  const auto& mesh = mesh_of(faces);
  fast::TessellatorOptions options;
  options.threads = threads;
  fast::Tessellator<float> tessellator(mesh, options);
  const std::vector<std::int32_t> depths(mesh.faces.size(), depth);
  Output out;
  fast::FrameStats sum;
  for (auto _ : state) {
    const auto stats = tessellator.frame(depths, out);
    sum.seconds_pairing += stats.seconds_pairing;
    sum.seconds_planning += stats.seconds_planning;
    sum.seconds_evaluation += stats.seconds_evaluation;
    sum.seconds_total += stats.seconds_total;
    sum.limit_points = stats.limit_points;
  }
  state.counters["pairing%"] = 100 * sum.seconds_pairing / sum.seconds_total;
  state.counters["planning%"] = 100 * sum.seconds_planning / sum.seconds_total;
  state.counters["window%"] = 100 * sum.seconds_evaluation / sum.seconds_total;
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(sum.limit_points),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

void edges(benchmark::State& state, int faces, int depth) {
  const auto& mesh = mesh_of(faces);
  const fast::Adjacency adjacency(mesh);
  const fast::PreparedMesh<float> prepared(adjacency, fast::positions_of<float>(mesh));
  fast::EdgeStrip<float> strip(depth, adjacency.max_valence());
  std::vector<fast::SurfaceVertex<float>> out((std::size_t{1} << depth) + 1);
  for (auto _ : state) {
    for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h)
      strip.evaluate(prepared, h, depth, out.data());
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["points/s"] = benchmark::Counter(3. * adjacency.face_count() * (1 << depth),
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

constexpr int kFaces = 4000;

std::string full_name(const std::string& name, int depth) {
  return name + "/uniform/bumpy/faces:" + std::to_string(kFaces) + "/depth:" + std::to_string(depth);
}

void add(const char* name, const std::function<void(benchmark::State&, int, int)>& function, int low,
         int high) {
  for (int depth = low; depth <= high; ++depth) {
    benchmark::RegisterBenchmark(full_name(name, depth).c_str(), [function, depth](benchmark::State& s) {
      function(s, kFaces, depth);
    })->Unit(benchmark::kMillisecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  add("window-carry", window<float, true>, 0, 7);
  add("window-double", window<double, true>, 3, 5);
  add("window-as-printed", window<float, false>, 3, 7);
  add(
      "frame-strips", [](auto& s, int faces, int depth) { frame<fast::DrawList<float>>(s, faces, depth, 1); },
      0, 6);
  add(
      "frame-strips-all-threads",
      [](auto& s, int faces, int depth) { frame<fast::DrawList<float>>(s, faces, depth, 0); }, 3, 6);
  add(
      "frame-indexed",
      [](auto& s, int faces, int depth) { frame<fast::IndexedMesh<float>>(s, faces, depth, 1); }, 3, 6);
  add("crack-edges", edges, 3, 6);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
