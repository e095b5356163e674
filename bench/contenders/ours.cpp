// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bench/contenders/contender.h"
#include "fast/stream/row_stream.h"
#include "fast/window/sliding_window.h"
#include "reference/loop/naive.h"

namespace limitcheck::bench {

namespace {

namespace rs = fast::row_stream;

double per_pair(std::size_t pairs, int depth) {
  return static_cast<double>(pairs) * rs::side(depth) * rs::side(depth);
}

/// Adjacency, uniform pairing, rings and vertex limits; then rows or whole pairs.
class RowStreaming final : public Contender {
 public:
  enum class Form { kRows, kWhole, kStreamed };

  RowStreaming(const data::ControlMesh& mesh, int depth, int threads, const rs::Kernel& kernel, Form form)
      : depth_(depth),
        threads_(threads),
        form_(form),
        adjacency_(mesh),
        pairs_(fast::pair_faces(adjacency_, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids),
        stream_(mesh, adjacency_, kernel) {
    if (form == Form::kWhole || form == Form::kStreamed) out_.resize(evaluated());
  }

  void run() override {
    // A batch is as many pairs as the kernel has lanes: pieces are whole batches.
    const auto lanes = static_cast<std::size_t>(stream_.kernel().lanes);
    in_parallel((pairs_.size() + lanes - 1) / lanes, threads_, [&](std::size_t first, std::size_t last) {
      first *= lanes, last = std::min(last * lanes, pairs_.size());
      const auto some = std::span(pairs_).subspan(first, last - first);
      auto workspace = pool_.take([] { return std::make_unique<rs::Workspace>(); });
      const std::size_t start = first * static_cast<std::size_t>(per_pair(1, depth_));
      switch (form_) {
        case Form::kRows:
          stream_.rows(some, depth_, *workspace, nullptr, nullptr);
          break;
        case Form::kWhole:
          stream_.whole(some, depth_, *workspace, out_.data() + start);
          break;
        case Form::kStreamed:
          stream_.streamed(some, depth_, *workspace, out_.data() + start);
          break;
      }
      pool_.give(std::move(workspace));
    });
    benchmark::ClobberMemory();
  }
  double evaluated() const override { return per_pair(pairs_.size(), depth_); }

 private:
  int depth_, threads_;
  Form form_;
  fast::Adjacency adjacency_;
  std::vector<fast::Grid> pairs_;
  rs::RowStream stream_;
  Pool<rs::Workspace> pool_;
  std::vector<rs::Vertex> out_;
};

/// The paper's scheme, one point after the other, strips looked at and forgotten.
class Window : public Contender {
 public:
  Window(const data::ControlMesh& mesh, int depth, int threads)
      : depth_(depth),
        threads_(threads),
        adjacency_(mesh),
        pairs_(fast::pair_faces(adjacency_, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids),
        prepared_(adjacency_, fast::positions_of<float>(mesh)) {}

  void run() override {
    in_parallel(pairs_.size(), threads_, [&](std::size_t first, std::size_t last) {
      auto window = pool_.take([&] { return std::make_unique<Sliding>(depth_, adjacency_.max_valence()); });
      for (std::size_t k = first; k < last; ++k) {
        window->run(prepared_, 3 * pairs_[k].face0 + pairs_[k].edge0, depth_,
                    [](int, const fast::SurfaceVertex<float>* strip) { benchmark::DoNotOptimize(strip); });
      }
      pool_.give(std::move(window));
    });
  }
  double evaluated() const override { return per_pair(pairs_.size(), depth_); }

 private:
  using Sliding = fast::SlidingWindow<float, fast::LimitSurface<float>, fast::NoProbe, true>;

  int depth_, threads_;
  fast::Adjacency adjacency_;
  std::vector<fast::Grid> pairs_;
  fast::PreparedMesh<float> prepared_;
  Pool<Sliding> pool_;
};

/// The paper's recursive subdivider, every face by itself, in double.
class Naive : public Contender {
 public:
  Naive(const data::ControlMesh& mesh, int depth, int threads)
      : depth_(depth), threads_(threads), subdivider_(mesh) {}
  void run() override {
    in_parallel(subdivider_.face_count(), threads_, [&](std::size_t first, std::size_t last) {
      for (std::size_t f = first; f < last; ++f)
        subdivider_.tessellate(f, depth_, [](const auto& leaf) { benchmark::DoNotOptimize(&leaf); });
    });
  }
  double evaluated() const override {
    return 3 * static_cast<double>(subdivider_.face_count()) *
           static_cast<double>(std::size_t{1} << 2 * depth_);
  }

 private:
  int depth_, threads_;
  reference::NaiveSubdivider<double> subdivider_;
};

}  // namespace

std::vector<Route> our_routes() {
  std::vector<Route> routes;
  const auto add = [&](std::string name, std::string what, const rs::Kernel& kernel,
                       RowStreaming::Form form) {
    using Form = RowStreaming::Form;
    const double bytes = form == Form::kRows ? 0 : 24;
    routes.push_back({std::move(name), std::move(what), kernel.fused ? 5. : 100., bytes, true,
                      [&kernel, form](const auto& mesh, int depth, int threads) {
                        return std::make_unique<RowStreaming>(mesh, depth, threads, kernel, form);
                      }});
  };
  for (const rs::Kernel& kernel : rs::kernels())
    add(std::string("row-stream/") + kernel.name, "row streaming, rows of a batch overwritten", kernel,
        RowStreaming::Form::kRows);
  add("row-stream/whole-pairs", "row streaming, all vertices kept", rs::kernels().front(),
      RowStreaming::Form::kWhole);
  add("row-stream/streamed", "row streaming, all vertices kept, written past the caches",
      rs::kernels().front(), RowStreaming::Form::kStreamed);
  routes.push_back({"sliding-window", "the paper's scheme, scalar float, strips overwritten", 35, 0, true,
                    maker<Window>()});
  routes.push_back({"naive", "the paper's recursive subdivider, double, triangles forgotten", 1200, 0, true,
                    maker<Naive>()});
  return routes;
}

}  // namespace limitcheck::bench
