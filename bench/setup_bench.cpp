// SPDX-License-Identifier: MIT
// What a frame costs before the first point is computed: adjacency, the per-mesh part of the heuristics, the
// depths of one view, the pairing. `per_face` is the time per control face.
// Names: stage/variant/shape/faces:N.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "data/generators/bumpy_sphere.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/depth.h"
#include "fast/plan/printed_rules.h"
#include "fast/stream/gather/rings.h"

namespace {

using namespace limitcheck;

struct Scene {
  explicit Scene(int faces)
      : mesh(data::bumpy_sphere(faces, 1)), adjacency(mesh), heuristics(mesh, adjacency) {}
  data::ControlMesh mesh;
  fast::Adjacency adjacency;
  fast::DepthHeuristics heuristics;
};

// A hull of half a million points takes seconds, so each size is made once, when first needed.
const Scene& scene(int faces) {
  static std::map<int, std::unique_ptr<Scene>> scenes;
  auto& entry = scenes[faces];
  if (!entry) entry = std::make_unique<Scene>(faces);
  return *entry;
}

using Stage = std::function<void(const Scene&)>;

void run(benchmark::State& state, int faces, const Stage& stage) {
  const Scene& s = scene(faces);
  stage(s);  // lazily prepared tables are not part of a frame
  for (auto _ : state) stage(s);
  state.counters["per_face"] = benchmark::Counter(static_cast<double>(state.iterations()) * faces,
                                                  benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

fast::DepthOptions strategy(fast::Strategy s) {
  fast::DepthOptions options;
  options.strategy = s;
  return options;
}

void add(const std::string& name, const Stage& stage) {
  for (const int faces : {800, 4000, 100'000, 1'000'000}) {
    benchmark::RegisterBenchmark((name + "/bumpy/faces:" + std::to_string(faces)).c_str(), run, faces, stage);
  }
}

}  // namespace

int main(int argc, char** argv) {
  add("adjacency/build",
      [](const Scene& s) { benchmark::DoNotOptimize(fast::Adjacency(s.mesh).max_valence()); });
  add("rings/build", [](const Scene& s) {
    benchmark::DoNotOptimize(fast::row_stream::Rings(s.mesh, s.adjacency).degenerate_normals());
  });
  add("depth/per-mesh", [](const Scene& s) {
    benchmark::DoNotOptimize(fast::DepthHeuristics(s.mesh, s.adjacency).degenerate_normals());
  });
  add("depth/per-mesh-with-cones", [](const Scene& s) {
    benchmark::DoNotOptimize(fast::DepthHeuristics(s.mesh, s.adjacency).cone_cosine(0, 0));
  });
  for (const auto s : {fast::Strategy::kUniform, fast::Strategy::kRandom, fast::Strategy::kProjectSphere,
                       fast::Strategy::kCurvature, fast::Strategy::kCombined}) {
    add("depth/" + std::string(fast::name(s)), [options = strategy(s)](const Scene& sc) {
      benchmark::DoNotOptimize(sc.heuristics.depths(options, {}).data());
    });
  }
  for (const auto& [rule, rule_name] : {std::pair{fast::PairingRule::kCorrected, "corrected"},
                                        std::pair{fast::PairingRule::kPrinted, "printed"}}) {
    for (const auto s : {fast::Strategy::kUniform, fast::Strategy::kRandom, fast::Strategy::kCombined}) {
      std::map<const Scene*, std::vector<std::int32_t>> cache;
      add("pairing/" + std::string(rule_name) + "-" + std::string(fast::name(s)),
          [options = strategy(s), pairing = fast::PrintedRules{rule}, cache](const Scene& sc) mutable {
            std::vector<std::int32_t>& depth = cache[&sc];
            if (depth.empty()) depth = sc.heuristics.depths(options, {});
            benchmark::DoNotOptimize(fast::pair_faces(sc.adjacency, depth, pairing).singletons);
          });
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
