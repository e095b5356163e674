// SPDX-License-Identifier: MIT
// The sliding window: cost per limit point and stage, against the naive subdivider and OpenSubdiv's streaming
// use. [mueller2000, 4.3; claims C18, C51, C55]
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "fast/crack_edge.h"
#include "fast/frame.h"
#include "fast/sliding_window.h"
#include "reference/naive.h"
#include "verify/subject/host.h"
#include "verify/subject/registry.h"

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
void window(benchmark::State& state) {
  const auto& mesh = mesh_of(static_cast<int>(state.range(0)));
  const int depth = static_cast<int>(state.range(1));
  const fast::Adjacency adjacency(mesh);
  std::vector<fast::Vec3<Real>> positions;
  for (const auto& p : mesh.positions)
    positions.push_back({static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2])});
  const fast::PreparedMesh<Real> prepared(adjacency, positions);
  const auto pairing = fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.triangles.size(), depth));
  fast::SlidingWindow<Real, fast::LimitSurface<Real>, fast::NoCount, Carry> sliding(depth,
                                                                                    adjacency.max_valence());
  for (auto _ : state) {
    for (const fast::Pair& pair : pairing.pairs)
      sliding.run(prepared, 3 * pair.face0 + pair.edge0, depth,
                  [](int, const fast::SurfaceVertex<Real>* strip) { benchmark::DoNotOptimize(strip); });
  }
  const double side = (1 << depth) + 1;
  state.counters["points/s"] = benchmark::Counter(static_cast<double>(pairing.pairs.size()) * side * side,
                                                  benchmark::Counter::kIsIterationInvariantRate);
}

/// Whole frames at one depth; the share of each stage.
template <class Output>
void frame(benchmark::State& state, int threads) {
  const auto& mesh = mesh_of(static_cast<int>(state.range(0)));
  fast::TessellatorOptions options;
  options.threads = threads;
  fast::Tessellator<float> tessellator(mesh, options);
  const std::vector<std::int32_t> depth(mesh.triangles.size(), static_cast<std::int32_t>(state.range(1)));
  Output out;
  fast::FrameStats sum;
  for (auto _ : state) {
    const auto stats = tessellator.frame(depth, out);
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

/// The paper's recursive subdivider in double, every face by itself; compare with window-double. [C18]
void naive(benchmark::State& state) {
  const auto& mesh = mesh_of(static_cast<int>(state.range(0)));
  const int depth = static_cast<int>(state.range(1));
  const reference::NaiveSubdivider<double> subdivider(mesh);
  std::int64_t leaves = 0;
  for (auto _ : state) {
    for (std::size_t f = 0; f < subdivider.face_count(); f += 16)
      subdivider.tessellate(f, depth, [&](const auto&) { ++leaves; });
  }
  benchmark::DoNotOptimize(leaves);
  const double side = (1 << depth) + 1;
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>((mesh.triangles.size() + 15) / 16) / 2 * side * side,
                         benchmark::Counter::kIsIterationInvariantRate);
}

/// A subject through the door, its points counted as the window's: distinct per face pair.
void subject(benchmark::State& state, const lc_subject* which, const char* options) {
  const auto& mesh = mesh_of(static_cast<int>(state.range(0)));
  const int depth = static_cast<int>(state.range(1));
  verify::Session session(*which, mesh, options);
  for (auto _ : state) {
    auto tessellation = session.tessellate(depth, 1);
    benchmark::DoNotOptimize(tessellation.vertex_count());
  }
  const double side = (1 << depth) + 1;
  state.counters["points/s"] =
      benchmark::Counter(static_cast<double>(mesh.triangles.size()) / 2 * side * side,
                         benchmark::Counter::kIsIterationInvariantRate);
}

void edges(benchmark::State& state) {
  const auto& mesh = mesh_of(static_cast<int>(state.range(0)));
  const int depth = static_cast<int>(state.range(1));
  const fast::Adjacency adjacency(mesh);
  std::vector<fast::Vec3<float>> positions;
  for (const auto& p : mesh.positions)
    positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  const fast::PreparedMesh<float> prepared(adjacency, positions);
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

void add(const char* name, void (*function)(benchmark::State&), int low, int high) {
  for (int depth = low; depth <= high; ++depth) {
    benchmark::RegisterBenchmark(
        (std::string(name) + "/uniform/bumpy/faces:4000/depth:" + std::to_string(depth)).c_str(), function)
        ->Args({4000, depth})
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  add("window-carry", window<float, true>, 0, 7);
  add("window-double", window<double, true>, 3, 5);
  add("naive-double", naive, 3, 5);
  add("window-as-printed", window<float, false>, 3, 7);
  add(
      "frame-strips", [](benchmark::State& s) { frame<fast::DrawList<float>>(s, 1); }, 0, 6);
  add(
      "frame-strips-all-threads", [](benchmark::State& s) { frame<fast::DrawList<float>>(s, 0); }, 3, 6);
  add(
      "frame-indexed", [](benchmark::State& s) { frame<fast::IndexedMesh<float>>(s, 1); }, 3, 6);
  add("crack-edges", edges, 3, 6);
  add(
      "subject-sliding-window", [](benchmark::State& s) { subject(s, lc_subject_sliding_window(), ""); }, 3,
      5);
  add(
      "subject-opensubdiv-bfr", [](benchmark::State& s) { subject(s, lc_subject_opensubdiv_bfr(), ""); }, 3,
      5);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
