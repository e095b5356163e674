// SPDX-License-Identifier: MIT
// Row streaming and all other routes in one run; compare the ratios of the last lines. Names:
// route/steady|scratch/bumpy/faces:N/depth:M/threads:T. Counters: points/s distinct limit points, written/s
// bytes of evaluated points, 24 each; peak: bytes by which the process grows in one run from scratch, the
// control mesh not counted.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "bench/contenders/contender.h"
#include "bench/peak_memory.h"
#include "bench/ratio_table.h"
#include "bench/write_only.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/stream/targets.h"

namespace {

using namespace limitcheck;
using bench::Route;

const data::ControlMesh& mesh_of(int faces) {
  static std::map<int, data::ControlMesh> known;
  const auto found = known.find(faces);
  return found != known.end() ? found->second
                              : known.emplace(faces, data::bumpy_sphere(faces, 1)).first->second;
}

void count(benchmark::State& state, const data::ControlMesh& mesh, int depth, double evaluated) {
  using benchmark::Counter;
  state.counters["points/s"] =
      Counter(bench::distinct_points(mesh, depth), Counter::kIsIterationInvariantRate);
  state.counters["written/s"] = Counter(24 * evaluated, Counter::kIsIterationInvariantRate);
}

void steady(benchmark::State& state, const Route& route, int faces, int depth, int threads) {
  const auto& mesh = mesh_of(faces);
  const auto contender = route.make(mesh, depth, threads);
  contender->run();
  for (auto _ : state) contender->run();
  count(state, mesh, depth, contender->evaluated());
}

void from_scratch(benchmark::State& state, const Route& route, int faces, int depth) {
  const auto& mesh = mesh_of(faces);
  static std::map<std::string, double> peaks;  // once per case, not per repetition
  double& peak = peaks[route.name + "/" + std::to_string(faces) + "/" + std::to_string(depth)];
  if (peak == 0) peak = bench::peak_memory([&] { route.make(mesh, depth, 1)->run(); });
  double evaluated = 0;
  for (auto _ : state) {
    const auto contender = route.make(mesh, depth, 1);
    contender->run();
    evaluated = contender->evaluated();
  }
  count(state, mesh, depth, evaluated);
  state.counters["peak"] =
      benchmark::Counter(peak, benchmark::Counter::kDefaults, benchmark::Counter::kIs1024);
}

void set_up(benchmark::State& state, const Route& route, int faces) {
  const auto& mesh = mesh_of(faces);
  for (auto _ : state) benchmark::DoNotOptimize(route.make(mesh, 2, 1));
  state.counters["faces/s"] = benchmark::Counter(faces, benchmark::Counter::kIsIterationInvariantRate);
}

void write_only(benchmark::State& state, std::size_t bytes, bool streaming) {
  bench::WriteOnly memory(bytes);
  for (auto _ : state) {
    memory.run(streaming);
    benchmark::ClobberMemory();
  }
  state.counters["written/s"] =
      benchmark::Counter(static_cast<double>(bytes), benchmark::Counter::kIsIterationInvariantRate);
}

template <class Function>
void add(const std::string& name, Function function) {
  benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMillisecond)->UseRealTime();
}

/// Cases that would take more than some seconds or a few gigabytes are left out.
bool affordable(const Route& route, int faces, int depth, bool scratch) {
  const double points = faces * std::ldexp(1., 2 * depth) / 2;
  return points * route.bytes_per_point < 4e9 &&
         points * route.nanoseconds_per_point < (scratch ? 4e9 : 2e9) * (faces == 4000 ? 2 : 1);
}

void add_route(const Route& route, const std::vector<int>& threads) {
  for (const int faces : {200, 1000, 4000, 100'000, 1'000'000}) {
    for (int depth = 1; depth <= 7; ++depth) {
      if (!affordable(route, faces, depth, false)) continue;
      for (const int t : threads) {
        if (t > 1 && !route.threads) continue;
        add(bench::full_name(route.name, "steady", faces, depth, t),
            [=](auto& s) { steady(s, route, faces, depth, t); });
      }
      if (affordable(route, faces, depth, true)) {
        add(bench::full_name(route.name, "scratch", faces, depth, 1),
            [=](auto& s) { from_scratch(s, route, faces, depth); });
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> threads{1};
  if (const auto all = static_cast<int>(std::thread::hardware_concurrency()); all > 1) threads.push_back(all);

  const std::vector<Route> ours = bench::our_routes();
  std::vector<Route> routes = ours;
  for (const auto& make : {bench::bfr_streaming, bench::bfr_cached_stencils, bench::far_uniform,
                           bench::far_limit_stencils, bench::cgal_refinement, bench::openmesh_refinement})
    routes.push_back(make());
  for (const Route& route : routes) add_route(route, threads);
  for (const int faces : {4000, 100'000, 1'000'000})
    add("row-stream/set-up/bumpy/faces:" + std::to_string(faces),
        [=](auto& s) { set_up(s, ours[0], faces); });
  add("write-only/first-level", [](auto& s) { write_only(s, 16 << 10, false); });
  add("write-only/cached", [](auto& s) { write_only(s, 1 << 20, false); });
  add("write-only/memory", [](auto& s) { write_only(s, 256 << 20, true); });

  // Hundreds of cases: a tenth of a second each unless asked otherwise.
  std::vector<char*> arguments(argv, argv + argc);
  std::string min_time = "--benchmark_min_time=0.1";
  arguments.insert(arguments.begin() + 1, min_time.data());
  int arguments_left = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&arguments_left, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(arguments_left, arguments.data())) return 2;

  // Runs that differ in these must not be compared.
  std::string targets;
  for (const auto& kernel : fast::row_stream::kernels())
    targets += std::string(targets.empty() ? "" : " ") + kernel.name;
  benchmark::AddCustomContext("compiler", LIMITCHECK_COMPILER);
  benchmark::AddCustomContext("flags", LIMITCHECK_FLAGS);
  benchmark::AddCustomContext("targets", targets);

  bench::RatioTable table(ours.front().name, threads.back());
  benchmark::RunSpecifiedBenchmarks(&table);
  for (const Route& route : routes) std::printf("%-26s %s\n", route.name.c_str(), route.what.c_str());
  return 0;
}
