// SPDX-License-Identifier: MIT
// How fast the reference is. It need not be fast, but an audit calls it millions of times.
#include <benchmark/benchmark.h>

#include "data/generators/named_mesh.h"
#include "reference/catmull_clark/stam.h"
#include "reference/loop/naive.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"

namespace {

using namespace limitcheck;
using reference::Order;

data::ControlMesh bumpy(std::int64_t faces) {
  return data::named_mesh("bumpy:" + std::to_string(faces));
}

/// Lattice points of depth 5, face after face, as an audit visits them.
void evaluate(benchmark::State& state, Order order) {
  const data::ControlMesh mesh = bumpy(state.range(0));
  const reference::StamEvaluator<double> stam(mesh);
  int face = 0, i = 0, j = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(stam.evaluate(face, i / 32.0, j / 32.0, order));
    if (i + j < 32) {
      ++i;
    } else if (j < 32) {
      i = 0;
      ++j;
    } else {
      i = j = 0;
      face = face + 1 < stam.face_count() ? face + 1 : 0;
    }
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(evaluate, first, Order::kFirst)
    ->Name("reference/stam/position+normal/bumpy")
    ->ArgName("faces")
    ->Arg(800)
    ->Arg(4000);
BENCHMARK_CAPTURE(evaluate, second, Order::kSecond)
    ->Name("reference/stam/position+normal+second/bumpy")
    ->ArgName("faces")
    ->Arg(4000);

void stam_set_up(benchmark::State& state) {
  const data::ControlMesh mesh = bumpy(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(reference::StamEvaluator<double>(mesh));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(stam_set_up)
    ->Name("reference/stam/set-up/bumpy")
    ->ArgName("faces")
    ->Arg(4000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

/// Lattice points of depth 5 of Catmull-Clark's surface: a quad's, or those of the sub-quads of another face.
void catmull_clark(benchmark::State& state, const char* name, Order order) {
  const data::ControlMesh mesh = data::named_mesh(name);
  const reference::catmull_clark::StamEvaluator<double> stam(mesh.faces,
                                                             reference::positions_of<double>(mesh));
  int face = 0, corner = 0, i = 0, j = 0;
  for (auto _ : state) {
    const auto corners = static_cast<int>(mesh.faces[static_cast<std::size_t>(face)].size());
    const int n = corners == 4 ? 32 : 16;
    benchmark::DoNotOptimize(stam.evaluate(face, corner, i / double(n), j / double(n), order));
    if (i++ < n) continue;
    i = 0;
    if (j++ < n) continue;
    j = 0;
    if (corners != 4 && ++corner < corners) continue;
    corner = 0;
    face = face + 1 < stam.face_count() ? face + 1 : 0;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(catmull_clark, regular, "quad-torus:64:32", Order::kFirst)
    ->Name("reference/catmull-clark/position+normal/quad-torus");
BENCHMARK_CAPTURE(catmull_clark, dual, "dual:bumpy:4000", Order::kFirst)
    ->Name("reference/catmull-clark/position+normal/dual-of-bumpy:4000");
BENCHMARK_CAPTURE(catmull_clark, mixed, "mixed:1:4000", Order::kFirst)
    ->Name("reference/catmull-clark/position+normal/mixed:4000");
BENCHMARK_CAPTURE(catmull_clark, second, "dual:bumpy:4000", Order::kSecond)
    ->Name("reference/catmull-clark/position+normal+second/dual-of-bumpy:4000");

void naive(benchmark::State& state) {
  const reference::NaiveSubdivider<double> subdivider(bumpy(state.range(0)));
  const auto depth = static_cast<int>(state.range(1));
  std::int64_t leaves = 0;
  for (auto _ : state)
    for (std::size_t f = 0; f < subdivider.face_count(); ++f)
      subdivider.tessellate(f, depth, [&](const reference::LeafTriangle<double>& leaf) {
        benchmark::DoNotOptimize(leaf);
        ++leaves;
      });
  state.SetItemsProcessed(leaves);
}
BENCHMARK(naive)
    ->Name("reference/naive/bumpy")
    ->ArgNames({"faces", "depth"})
    ->Args({800, 3})
    ->Args({4000, 5})
    ->Unit(benchmark::kMillisecond);

void refine(benchmark::State& state) {
  const data::ControlMesh mesh = bumpy(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(reference::refine<double>(mesh, static_cast<int>(state.range(1))).limits());
}
BENCHMARK(refine)
    ->Name("reference/refine+limits/bumpy")
    ->ArgNames({"faces", "depth"})
    ->Args({800, 3})
    ->Args({4000, 5})
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
