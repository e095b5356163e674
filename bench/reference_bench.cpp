// SPDX-License-Identifier: MIT
// How fast the reference is. It need not be fast, but an audit calls it millions of times.
#include <benchmark/benchmark.h>

#include "data/generators/named_mesh.h"
#include "data/scheme.h"
#include "reference/loop/recursion.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "reference/surface/surface.h"

namespace {

using namespace limitcheck;
using reference::Order;

data::ControlMesh bumpy(std::int64_t faces) {
  return data::named_mesh("bumpy:" + std::to_string(faces));
}

/// Lattice points of depth 5, face after face, as an audit visits them: of a triangle, of a quad, or of the sub-quads of
/// another face.
void evaluate(benchmark::State& state, const char* name, Order order) {
  const data::ControlMesh mesh = data::named_mesh(name);
  const bool loop = mesh.faces.are_triangles();
  const reference::Surface surface(mesh, data::natural_scheme(mesh));
  std::int64_t points = 0;
  std::size_t face = 0;
  for (auto _ : state) {
    const auto size = static_cast<int>(mesh.faces[face].size());
    const bool whole = loop || size == 4;
    const int n = whole ? 32 : 16;
    for (int corner = 0; corner < (whole ? 1 : size); ++corner)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= (loop ? n - j : n); ++i, ++points)
          benchmark::DoNotOptimize(
              surface.evaluate(static_cast<int>(face), corner, i / double(n), j / double(n), order));
    face = (face + 1) % mesh.faces.size();
  }
  state.SetItemsProcessed(points);
}
BENCHMARK_CAPTURE(evaluate, 800, "bumpy:800", Order::kFirst)
    ->Name("reference/stam/position+normal/bumpy/faces:800");
BENCHMARK_CAPTURE(evaluate, 4000, "bumpy:4000", Order::kFirst)
    ->Name("reference/stam/position+normal/bumpy/faces:4000");
BENCHMARK_CAPTURE(evaluate, second, "bumpy:4000", Order::kSecond)
    ->Name("reference/stam/position+normal+second/bumpy/faces:4000");
BENCHMARK_CAPTURE(evaluate, regular, "quad-torus:64:32", Order::kFirst)
    ->Name("reference/catmull-clark/position+normal/quad-torus");
BENCHMARK_CAPTURE(evaluate, dual, "dual:bumpy:4000", Order::kFirst)
    ->Name("reference/catmull-clark/position+normal/dual-of-bumpy:4000");
BENCHMARK_CAPTURE(evaluate, mixed, "mixed:1:4000", Order::kFirst)
    ->Name("reference/catmull-clark/position+normal/mixed:4000");
BENCHMARK_CAPTURE(evaluate, dual_second, "dual:bumpy:4000", Order::kSecond)
    ->Name("reference/catmull-clark/position+normal+second/dual-of-bumpy:4000");

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
