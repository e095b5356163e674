// SPDX-License-Identifier: MIT
// Row streaming and all other routes in one run; compare the ratios of the last lines. --scheme loop (the default) or
// catmull-clark; --gl: by OpenGL, too, on its device. Names: route/steady|scratch/shape/faces:N/depth:M/threads:T, where
// the shape is bumpy, split (two of three pairs of faces are regular) or torus (all) or, of quads, quads, half-regular or
// regular. Counters: points/s distinct limit points, written/s bytes of evaluated points, 24 each; peak: bytes by which the
// process grows in one run from scratch, the control mesh not counted.
#include <benchmark/benchmark.h>
#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "bench/cases/shapes.h"
#include "bench/contenders/contender.h"
#include "bench/machine.h"
#include "data/scheme.h"
#include "fast/stream/kernel/targets.h"

namespace limitcheck::bench {
namespace {

/// Quads, of whose quads none, half or all are regular; and many.
const Shape kQuads{"quads", 4002}, kHalfRegularQuads{"half-regular", 4008}, kRegularQuads{"regular", 4000},
    kManyQuads{"quads", 100'002}, kBumpy{"bumpy", 4000}, kManyFaces{"bumpy", 100'000};

std::string steady(const std::string& route, int depth, const Shape& shape = kBumpy, int threads = 1) {
  return full_name(route, "steady", shape, depth, threads);
}

/// Prints each run, keeps the best rate over its repetitions, and at the end prints the ratios of those that
/// ran, each beside its target.
class RatioTable : public benchmark::ConsoleReporter {
 public:
  /// best: name of the row-streaming route of the best target.
  RatioTable(data::Scheme scheme, std::string best, int all_threads)
      : scheme_(scheme), best_(std::move(best)), all_threads_(all_threads) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      for (const auto& [counter, value] : run.counters) {
        double& best = rates_[counter + " " + run.run_name.function_name];
        best = std::max(best, static_cast<double>(value));
      }
    }
  }

  void Finalize() override {
    ConsoleReporter::Finalize();
    std::printf(
        "\nratios of rates, best of all repetitions (and the least wanted); one thread unless said\n");
    if (scheme_ == data::Scheme::kLoop) {
      print_triangles();
    } else {
      print_quads();
    }
    std::printf("\n");
  }

 private:
  /// 0: did not run.
  double rate(const std::string& counter, const std::string& name) const {
    const auto found = rates_.find(counter + " " + name);
    return found == rates_.end() ? 0 : found->second;
  }
  double points(const std::string& name) const { return rate("points/s", name); }
  double points(const std::string& route, int depth, const Shape& shape = kBumpy, int threads = 1) const {
    return points(steady(route, depth, shape, threads));
  }
  double scratch(int depth, const Shape& shape) const {
    return points(full_name(best_, "scratch", shape, depth, 1));
  }
  double fastest_peer(const std::string& use, const Shape& shape, int depth) const {
    double best = 0;
    for (const char* peer : {"bfr/streaming", "bfr/cached-stencils", "far/uniform", "far/limit-stencils",
                             "cgal/refinement", "openmesh/refinement"})
      best = std::max(best, points(full_name(peer, use, shape, depth, 1)));
    return best;
  }

  static void print(const std::string& what, double a, double b, double least = 0) {
    if (a == 0 || b == 0) return;
    std::printf("  %-58s %8.2f", what.c_str(), a / b);
    if (least > 0) std::printf("   (%g)", least);
    std::printf("\n");
  }

  void print_quads() const {
    struct Wanted {
      Shape shape;
      double depth_3, depth_5;
    };
    const Wanted all[] = {{kQuads, 24, 50}, {kHalfRegularQuads, 0, 55}, {kRegularQuads, 0, 0}};
    for (const Wanted& wanted : all) {
      const Shape& shape = wanted.shape;
      for (const int depth : {3, 5}) {
        const std::string at = shape.name + ", depth " + std::to_string(depth) + ", ";
        const double rows = points(best_, depth, shape),
                     stencils = points("bfr/cached-stencils", depth, shape);
        print(at + "rows / Bfr cached stencils", rows, stencils,
              depth == 3 ? wanted.depth_3 : wanted.depth_5);
        print(at + "streamed / Bfr cached stencils", points("row-stream/streamed", depth, shape), stencils);
        print(at + "rows / Bfr streaming", rows, points("bfr/streaming", depth, shape));
        print(at + "rows / fastest peer", rows, fastest_peer("steady", shape, depth));
        print(at + "rows from scratch / fastest peer from scratch", scratch(depth, shape),
              fastest_peer("scratch", shape, depth));
      }
    }
    print("100 000 quads, depth 5, all threads / one", points(best_, 5, kManyQuads, all_threads_),
          points(best_, 5, kManyQuads), 1.85);
  }

  void print_triangles() const {
    const double rows = points(best_, 5), window = points("sliding-window", 5);
    const auto written = [&](const std::string& route) { return rate("written/s", steady(route, 5)); };
    const auto memory = [&](const char* part) {
      return rate("written/s", std::string("write-only/") + part);
    };
    print("depth 5, rows / Bfr cached stencils", rows, points("bfr/cached-stencils", 5), 40);
    print("depth 5, rows / Bfr streaming", rows, points("bfr/streaming", 5), 120);
    print("depth 3, rows / Bfr cached stencils", points(best_, 3), points("bfr/cached-stencils", 3), 20);
    print("depth 5, rows / scalar sliding window", rows, window, 20);
    print("depth 5, rows / fastest peer", rows, fastest_peer("steady", kBumpy, 5));
    print("depth 5, scalar sliding window / Bfr streaming", window, points("bfr/streaming", 5), 6);
    print("depth 5, scalar sliding window / naive", window, points("naive", 5));
    print("depth 5, rows / write-only in 1 MB, bytes", written(best_), memory("cached"), .45);
    print("depth 5, rows / write-only in 16 KB, bytes", written(best_), memory("first-level"));
    for (const auto& [form, least] : {std::pair{"row-stream/whole-pairs", 0.}, {"row-stream/streamed", .5}})
      print(std::string("depth 5, ") + form + " / write-only to memory, bytes", written(form),
            memory("memory"), least);
    for (const auto& [depth, least] : {std::pair{3, 15.}, {5, 0.}})
      print("depth " + std::to_string(depth) + ", rows from scratch / fastest peer from scratch",
            scratch(depth, kBumpy), fastest_peer("scratch", kBumpy, depth), least);
    print("100 000 faces, depth 5, all threads / one", points(best_, 5, kManyFaces, all_threads_),
          points(best_, 5, kManyFaces), 1.85);
    print("depth 5, rows by OpenGL / rows", points("row-stream/gl", 5), rows);
  }

  data::Scheme scheme_;
  std::string best_;
  int all_threads_;
  std::map<std::string, double> rates_;  // by counter and name
};

}  // namespace
}  // namespace limitcheck::bench

namespace {

using namespace limitcheck;
using bench::mesh_of, bench::Route, bench::Shape;

void count(benchmark::State& state, const data::ControlMesh& mesh, int depth, double evaluated) {
  using benchmark::Counter;
  state.counters["points/s"] =
      Counter(bench::distinct_points(mesh, depth), Counter::kIsIterationInvariantRate);
  state.counters["written/s"] = Counter(24 * evaluated, Counter::kIsIterationInvariantRate);
}

void steady(benchmark::State& state, const Route& route, const Shape& shape, int depth, int threads) {
  const auto& mesh = mesh_of(shape);
  const auto contender = route.make(mesh, depth, threads);
  contender->run();
  for (auto _ : state) contender->run();
  count(state, mesh, depth, contender->evaluated());
}

void from_scratch(benchmark::State& state, const Route& route, const Shape& shape, int depth) {
  const auto& mesh = mesh_of(shape);
  static std::map<std::string, double> peaks;  // once per case, not per repetition
  double& peak = peaks[bench::full_name(route.name, "scratch", shape, depth, 1)];
  if (peak == 0 && !route.on_a_device) peak = bench::peak_memory([&] { route.make(mesh, depth, 1)->run(); });
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

void set_up(benchmark::State& state, const Route& route, const Shape& shape) {
  const auto& mesh = mesh_of(shape);
  for (auto _ : state) benchmark::DoNotOptimize(route.make(mesh, 2, 1));
  state.counters["faces/s"] = benchmark::Counter(shape.faces, benchmark::Counter::kIsIterationInvariantRate);
}

void write_only(benchmark::State& state, std::size_t bytes, bool streaming) {
  const std::size_t count = bytes / sizeof(float);
  const auto memory = hwy::AllocateAligned<float>(count);
  std::fill_n(memory.get(), count, 0.F);
  for (auto _ : state) {
    bench::write_all({memory.get(), count}, streaming);
    benchmark::ClobberMemory();
  }
  state.counters["written/s"] =
      benchmark::Counter(static_cast<double>(bytes), benchmark::Counter::kIsIterationInvariantRate);
}

/// Processor time of one thread, which others on the machine do not add to; of more, and of a device, the time on the wall.
template <class Function>
void add(const std::string& name, Function function, bool on_a_device = false) {
  auto* one = benchmark::RegisterBenchmark(name.c_str(), function)->Unit(benchmark::kMillisecond);
  if (on_a_device || (name.find("threads:") != std::string::npos && !name.ends_with("threads:1")))
    one->UseRealTime();
}

bool of_triangles(const Shape& shape) {
  return shape.name == "bumpy" || shape.name == "split" || shape.name == "torus";
}

/// Cases that would take more than some seconds or a few gigabytes are left out.
bool affordable(const Route& route, const Shape& shape, int depth, bool scratch) {
  const double points = shape.faces * std::ldexp(1., 2 * depth) / (of_triangles(shape) ? 2 : 1);
  return points * route.bytes_per_point < 4e9 &&
         points * route.nanoseconds_per_point < (scratch ? 4e9 : 2e9) * (shape.faces < 5000 ? 2 : 1);
}

void add_route(const Route& route, const std::vector<Shape>& shapes, const std::vector<int>& threads) {
  for (const Shape& shape : shapes) {
    for (int depth = 1; depth <= 7; ++depth) {
      if (!affordable(route, shape, depth, false)) continue;
      for (const int t : threads) {
        if (t > 1 && !route.threads) continue;
        add(
            bench::full_name(route.name, "steady", shape, depth, t),
            [=](auto& s) { steady(s, route, shape, depth, t); }, route.on_a_device);
      }
      if (affordable(route, shape, depth, true)) {
        add(
            bench::full_name(route.name, "scratch", shape, depth, 1),
            [=](auto& s) { from_scratch(s, route, shape, depth); }, route.on_a_device);
      }
    }
  }
}

/// --scheme NAME or --scheme=NAME, taken out of the arguments.
data::Scheme take_scheme(std::vector<char*>& arguments) {
  for (std::size_t k = 1; k < arguments.size(); ++k) {
    std::string value = arguments[k];
    std::size_t used = 1;
    if (value == "--scheme" && k + 1 < arguments.size()) {
      value = arguments[k + 1], used = 2;
    } else if (value.starts_with("--scheme=")) {
      value = value.substr(9);
    } else {
      continue;
    }
    arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(k),
                    arguments.begin() + static_cast<std::ptrdiff_t>(k + used));
    for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark})
      if (value == name_of(scheme)) return scheme;
    std::fprintf(stderr, "throughput_bench: the scheme is loop or catmull-clark\n");
    std::exit(2);
  }
  return data::Scheme::kLoop;
}

bool take_gl(std::vector<char*>& arguments) {
  return std::erase_if(arguments, [](const char* word) { return std::string_view(word) == "--gl"; }) > 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  const bool gl = take_gl(arguments);
  const data::Scheme scheme = take_scheme(arguments);
  const bool triangles = scheme == data::Scheme::kLoop;
  std::vector<int> threads{1};
  if (const auto all = static_cast<int>(std::thread::hardware_concurrency()); all > 1) threads.push_back(all);

  const std::vector<Route> ours = triangles ? bench::our_routes() : bench::our_quad_routes();
  std::vector<Route> routes = ours;
  for (const auto& make : {bench::bfr_streaming, bench::bfr_cached_stencils, bench::far_uniform,
                           bench::far_limit_stencils, bench::cgal_refinement, bench::openmesh_refinement})
    routes.push_back(make());
  if (!triangles) routes.push_back(bench::embree_interpolation());
  if (gl) try {
      routes.push_back(bench::row_stream_by_gl());
    } catch (const std::runtime_error& error) {
      std::fprintf(stderr, "throughput_bench: %s\n", error.what());
      return 2;
    }
  std::vector<Shape> shapes{bench::kQuads, bench::kHalfRegularQuads, bench::kRegularQuads, bench::kManyQuads};
  if (triangles) {
    shapes.clear();
    for (const int faces : {200, 1000, 4000, 100'000, 1'000'000}) shapes.push_back({"bumpy", faces});
    shapes.push_back({"split", 4000}), shapes.push_back({"torus", 4000});
  }
  for (const Route& route : routes) add_route(route, shapes, threads);
  for (const Shape& shape : shapes) {
    if (shape.faces < 4000) continue;
    add("row-stream/set-up/" + shape.name + "/faces:" + std::to_string(shape.faces),
        [=](auto& s) { set_up(s, ours[0], shape); });
  }
  add("write-only/first-level", [](auto& s) { write_only(s, 16 << 10, false); });
  add("write-only/cached", [](auto& s) { write_only(s, 1 << 20, false); });
  add("write-only/memory", [](auto& s) { write_only(s, 256 << 20, true); });

  // Hundreds of cases: a tenth of a second each unless asked otherwise.
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

  bench::RatioTable table(scheme, ours.front().name, threads.back());
  benchmark::RunSpecifiedBenchmarks(&table);
  for (const Route& route : routes) std::printf("%-26s %s\n", route.name.c_str(), route.what.c_str());
  return 0;
}
