// SPDX-License-Identifier: MIT
// How fast the reference is. It need not be fast, but an audit calls it millions of times.
#include <benchmark/benchmark.h>

#include "data/generators/named_mesh.h"
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
void stam_position_normal(benchmark::State& state) {
  evaluate(state, Order::kFirst);
}
void stam_second(benchmark::State& state) {
  evaluate(state, Order::kSecond);
}
BENCHMARK(stam_position_normal)
    ->Name("reference/stam/position+normal/bumpy")
    ->ArgName("faces")
    ->Arg(800)
    ->Arg(4000);
BENCHMARK(stam_second)->Name("reference/stam/position+normal+second/bumpy")->ArgName("faces")->Arg(4000);

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
