// SPDX-License-Identifier: MIT
// Row streaming against everybody else, in one run; the ratios of the last lines are what counts.
// Names: subject/strategy/shape/faces:N/depth:M. Counter points/s: distinct limit points per pair of faces.
#include <benchmark/benchmark.h>
#include <immintrin.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/peer_bfr.h"
#include "data/generators/bumpy_sphere.h"
#include "fast/row_stream/compact_vertex.h"
#include "fast/row_stream/row_stream.h"
#include "fast/row_stream/stream_frame.h"
#include "fast/sliding_window.h"
#include "verify/subject/host.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
namespace rs = fast::row_stream;

const data::ControlMesh& mesh_of(int faces) {
  static std::map<int, data::ControlMesh> known;
  const auto found = known.find(faces);
  return found != known.end() ? found->second
                              : known.emplace(faces, data::bumpy_sphere(faces, 1)).first->second;
}

struct Prepared {
  explicit Prepared(const data::ControlMesh& mesh, int depth, const rs::Kernel& kernel)
      : adjacency(mesh),
        pairs(fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.triangles.size(), depth)).pairs),
        stream(mesh, adjacency, kernel) {}
  fast::Adjacency adjacency;
  std::vector<fast::Pair> pairs;
  rs::RowStream stream;
};

double points(std::size_t pairs, int depth) {
  return static_cast<double>(pairs) * rs::side(depth) * rs::side(depth);
}

void count(benchmark::State& state, double each) {
  state.counters["points/s"] = benchmark::Counter(each, benchmark::Counter::kIsIterationInvariantRate);
}

void row_buffer(benchmark::State& state, int faces, int depth, const rs::Kernel& kernel) {
  const Prepared p(mesh_of(faces), depth, kernel);
  rs::Workspace workspace;
  for (auto _ : state) p.stream.rows(p.pairs, depth, workspace, nullptr, nullptr);
  count(state, points(p.pairs.size(), depth));
  state.counters["bytes"] = static_cast<double>(workspace.bytes());
}

void whole_pairs(benchmark::State& state, int faces, int depth) {
  const Prepared p(mesh_of(faces), depth, rs::kernels().front());
  rs::Workspace workspace;
  std::vector<rs::Vertex> out(static_cast<std::size_t>(points(p.pairs.size(), depth)));
  for (auto _ : state) p.stream.whole(p.pairs, depth, workspace, out.data());
  count(state, points(p.pairs.size(), depth));
}

template <class Out>
void streamed(benchmark::State& state, int faces, int depth) {
  const Prepared p(mesh_of(faces), depth, rs::kernels().front());
  rs::Workspace workspace;
  std::vector<Out> out(static_cast<std::size_t>(points(p.pairs.size(), depth)));
  for (auto _ : state) p.stream.streamed(p.pairs, depth, workspace, out.data());
  count(state, points(p.pairs.size(), depth));
}

void from_scratch(benchmark::State& state, int faces, int depth) {
  const auto& mesh = mesh_of(faces);
  std::size_t pairs = 0;
  for (auto _ : state) {
    const Prepared p(mesh, depth, rs::kernels().front());
    rs::Workspace workspace;
    p.stream.rows(p.pairs, depth, workspace, nullptr, nullptr);
    pairs = p.pairs.size();
  }
  count(state, points(pairs, depth));
}

void set_up(benchmark::State& state, int faces) {
  for (auto _ : state) {
    const Prepared p(mesh_of(faces), 2, rs::kernels().front());
    benchmark::DoNotOptimize(p.pairs.data());
  }
  state.counters["faces/s"] = benchmark::Counter(faces, benchmark::Counter::kIsIterationInvariantRate);
}

void window(benchmark::State& state, int faces, int depth) {
  const auto& mesh = mesh_of(faces);
  const fast::Adjacency adjacency(mesh);
  std::vector<fast::Vec3<float>> positions;
  for (const auto& p : mesh.positions)
    positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  const fast::PreparedMesh<float> prepared(adjacency, positions);
  const auto pairing = fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.triangles.size(), depth));
  fast::SlidingWindow<float, fast::LimitSurface<float>, fast::NoCount, true> sliding(depth,
                                                                                     adjacency.max_valence());
  for (auto _ : state) {
    for (const fast::Pair& pair : pairing.pairs) {
      sliding.run(prepared, 3 * pair.face0 + pair.edge0, depth,
                  [](int, const fast::SurfaceVertex<float>* strip) { benchmark::DoNotOptimize(strip); });
    }
  }
  count(state, points(pairing.pairs.size(), depth));
}

void bfr_warm(benchmark::State& state, int faces, int depth) {
  bench::BfrPeer peer(mesh_of(faces));
  peer.stream(depth);
  for (auto _ : state) peer.stream(depth);
  count(state, points(static_cast<std::size_t>(faces) / 2, depth));
}

void bfr_from_scratch(benchmark::State& state, int faces, int depth) {
  for (auto _ : state) {
    bench::BfrPeer peer(mesh_of(faces));
    peer.stream(depth);
  }
  count(state, points(static_cast<std::size_t>(faces) / 2, depth));
}

void bfr_cached(benchmark::State& state, int faces, int depth) {
  bench::BfrPeer peer(mesh_of(faces));
  peer.cache_stencils(depth);
  for (auto _ : state) peer.apply_stencils();
  count(state, points(static_cast<std::size_t>(faces) / 2, depth));
  state.counters["bytes"] = static_cast<double>(peer.stencil_bytes());
}

/// Through the door, with output arrays: an upper bound of their cost, a few per cent above their own.
void peer(benchmark::State& state, const lc_subject* subject, int faces, int depth) {
  verify::Session session(*subject, mesh_of(faces), "");
  for (auto _ : state) {
    auto tessellation = session.tessellate(depth, 1);
    benchmark::DoNotOptimize(tessellation.vertex_count());
  }
  count(state, points(static_cast<std::size_t>(faces) / 2, depth));
}

/// Only writing the bytes: vectors to a buffer of `kilobytes`, over and over.
__attribute__((target("avx2"))) void write_only(benchmark::State& state, std::size_t kilobytes,
                                                bool streaming) {
  const std::size_t bytes = kilobytes << 10;
  std::unique_ptr<float, decltype(&std::free)> memory(static_cast<float*>(std::aligned_alloc(64, bytes)),
                                                      &std::free);
  std::memset(memory.get(), 0, bytes);
  for (auto _ : state) {
    const __m256 value = _mm256_set1_ps(static_cast<float>(state.iterations()));
    for (float *p = memory.get(), *end = p + bytes / 4; p != end; p += 8) {
      if (streaming)
        _mm256_stream_ps(p, value);
      else
        _mm256_store_ps(p, value);
    }
    benchmark::ClobberMemory();
  }
  count(state, static_cast<double>(bytes) / 24);
}

using Function = std::function<void(benchmark::State&)>;

void add(const std::string& name, Function function) {
  benchmark::RegisterBenchmark(name.c_str(), [function](benchmark::State& s) {
    function(s);
  })->Unit(benchmark::kMillisecond);
}

std::string place(int faces, int depth) {
  return "/bumpy/faces:" + std::to_string(faces) + "/depth:" + std::to_string(depth);
}

/// Remembers the best rate of each name over the repetitions, for the ratios.
class Ratios : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      const auto rate = run.counters.find("points/s");
      if (run.run_type != Run::RT_Iteration || rate == run.counters.end()) continue;
      double& best = best_[run.run_name.function_name];
      best = std::max(best, static_cast<double>(rate->second));
    }
  }
  void Finalize() override {
    ConsoleReporter::Finalize();
    const std::string buffer = std::string("row-stream/row-buffer-") + rs::kernels().front().name;
    std::printf("\nbest of all repetitions, and the least wanted:\n");
    ratio("depth 5, row buffer / Bfr cached stencils", buffer + place(4000, 5), "bfr/cached" + place(4000, 5),
          40);
    ratio("depth 5, row buffer / Bfr streaming warm", buffer + place(4000, 5),
          "bfr/streaming" + place(4000, 5), 120);
    ratio("depth 3, row buffer / Bfr cached stencils", buffer + place(4000, 3), "bfr/cached" + place(4000, 3),
          20);
    ratio("depth 5, row buffer / scalar sliding window", buffer + place(4000, 5),
          "window/carry" + place(4000, 5), 20);
    ratio("depth 5, scalar sliding window / Bfr streaming", "window/carry" + place(4000, 5),
          "bfr/streaming" + place(4000, 5), 6);
    ratio("depth 5, row buffer / write-only 1 MB", buffer + place(4000, 5), "bound/cached", .45);
    ratio("depth 5, row buffer / write-only 16 KB", buffer + place(4000, 5), "bound/first-level", 0);
    ratio("depth 5, whole pairs / write-only to memory", "row-stream/whole" + place(4000, 5),
          "bound/streaming", 0);
    ratio("depth 5, streamed / write-only to memory", "row-stream/streamed" + place(4000, 5),
          "bound/streaming", .5);
    ratio("depth 3, from scratch / Bfr from scratch", "row-stream/from-scratch" + place(4000, 3),
          "bfr/from-scratch" + place(4000, 3), 15);
  }

 private:
  void ratio(const char* what, const std::string& a, const std::string& b, double least) const {
    const auto x = best_.find(a), y = best_.find(b);
    if (x == best_.end() || y == best_.end()) return;
    std::printf("  %-46s %8.2f   (%g)\n", what, x->second / y->second, least);
  }
  std::map<std::string, double> best_;
};

}  // namespace

int main(int argc, char** argv) {
  const int faces = 4000;
  for (int depth = 1; depth <= 7; ++depth) {
    for (const rs::Kernel& kernel : rs::kernels()) {
      if (!kernel.fused && depth > 3) continue;  // the bits of the others, at the price of std::fma
      add(std::string("row-stream/row-buffer-") + kernel.name + place(faces, depth),
          [=, &kernel](auto& s) { row_buffer(s, faces, depth, kernel); });
    }
    add("window/carry" + place(faces, depth), [=](auto& s) { window(s, faces, depth); });
  }
  for (const int depth : {3, 5}) {
    add("row-stream/whole" + place(faces, depth), [=](auto& s) { whole_pairs(s, faces, depth); });
    add("row-stream/streamed" + place(faces, depth), [=](auto& s) { streamed<rs::Vertex>(s, faces, depth); });
    add("row-stream/streamed-compact" + place(faces, depth),
        [=](auto& s) { streamed<rs::CompactVertex>(s, faces, depth); });
    add("row-stream/from-scratch" + place(faces, depth), [=](auto& s) { from_scratch(s, faces, depth); });
    add("bfr/streaming" + place(faces, depth), [=](auto& s) { bfr_warm(s, faces, depth); });
    add("bfr/from-scratch" + place(faces, depth), [=](auto& s) { bfr_from_scratch(s, faces, depth); });
    add("bfr/cached" + place(faces, depth), [=](auto& s) { bfr_cached(s, faces, depth); });
  }
  for (const lc_subject* subject : {lc_subject_opensubdiv_far(), lc_subject_cgal(), lc_subject_openmesh()}) {
    add(std::string(subject->name) + "/door" + place(faces, 3), [=](auto& s) { peer(s, subject, faces, 3); });
  }
  for (const int many : {4000, 100000})
    add("row-stream/set-up" + place(many, 2), [=](auto& s) { set_up(s, many); });
  add("row-stream/row-buffer-many" + place(100000, 5),
      [](auto& s) { row_buffer(s, 100000, 5, rs::kernels().front()); });
  add("bound/first-level", [](auto& s) { write_only(s, 16, false); });
  add("bound/cached", [](auto& s) { write_only(s, 1024, false); });
  add("bound/streaming", [](auto& s) { write_only(s, std::size_t{256} << 10, true); });

  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Ratios ratios;
  benchmark::RunSpecifiedBenchmarks(&ratios);
  return 0;
}
