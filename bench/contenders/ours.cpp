// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/contenders/contender.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::bench {

namespace {

namespace rs = fast::row_stream;

std::size_t points_of(int depth) {
  return static_cast<std::size_t>(rs::side(depth) * rs::side(depth));
}

std::vector<fast::Grid> uniform_pairs(const data::ControlMesh& mesh, const fast::Adjacency& adjacency,
                                      int depth) {
  return fast::pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
}

/// Adjacency, uniform pairing, rings and vertex limits.
struct Pairs {
  using Kernel = rs::Kernel;
  Pairs(const data::ControlMesh& control, int depth, const Kernel& kernel)
      : adjacency(control),
        items(uniform_pairs(control, adjacency, depth)),
        stream(control, adjacency, kernel) {
    items = stream.sorted(items);
  }
  /// A batch is as many pairs as the kernel has lanes: pieces are whole batches.
  std::size_t piece() const { return static_cast<std::size_t>(stream.kernel().lanes); }

  fast::Adjacency adjacency;
  std::vector<fast::Grid> items;
  rs::RowStream stream;
};

/// Adjacency, rings and vertex limits, the faces sorted for the lanes.
struct Quads {
  using Kernel = rs::QuadKernel;
  Quads(const data::ControlMesh& control, int, const Kernel& kernel) : mesh(control), stream(mesh, kernel) {
    items.resize(control.faces.size());
    std::iota(items.begin(), items.end(), 0);
    items = stream.sorted(items);
  }
  /// Some batches, for the quads of a piece that do not fill a batch run in one that is not full.
  static std::size_t piece() { return 256; }

  fast::QuadMesh mesh;
  rs::QuadRowStream stream;
  std::vector<std::int32_t> items;
};

enum class Form { kRows, kWhole, kStreamed };

/// Rows, or whole pairs or quads.
template <class Prepared>
class RowStreaming final : public Contender {
 public:
  RowStreaming(const data::ControlMesh& mesh, int depth, int threads, const typename Prepared::Kernel& kernel,
               Form form)
      : depth_(depth), threads_(threads), form_(form), prepared_(mesh, depth, kernel) {
    if (form != Form::kRows) out_.resize(prepared_.items.size() * points_of(depth));
  }

  void run() override {
    const std::size_t piece = prepared_.piece();
    in_parallel((prepared_.items.size() + piece - 1) / piece, threads_,
                [&](std::size_t first, std::size_t last) {
                  first *= piece, last = std::min(last * piece, prepared_.items.size());
                  const auto some = std::span(std::as_const(prepared_.items)).subspan(first, last - first);
                  auto workspace = pool_.take([] { return std::make_unique<rs::Workspace>(); });
                  rs::Vertex* out = out_.data() + first * (out_.empty() ? 0 : points_of(depth_));
                  if (form_ == Form::kRows) prepared_.stream.rows(some, depth_, *workspace, nullptr, nullptr);
                  if (form_ == Form::kWhole) prepared_.stream.whole(some, depth_, *workspace, out);
                  if (form_ == Form::kStreamed) prepared_.stream.streamed(some, depth_, *workspace, out);
                  pool_.give(std::move(workspace));
                });
    benchmark::ClobberMemory();
  }
  double evaluated() const override {
    return static_cast<double>(prepared_.items.size() * points_of(depth_));
  }

 private:
  int depth_, threads_;
  Form form_;
  Prepared prepared_;
  Pool<rs::Workspace> pool_;
  std::vector<rs::Vertex> out_;
};

/// Row streaming on every target of this machine and in every output form.
///   items   "pairs" or "quads"
template <class Prepared>
std::vector<Route> row_stream_routes(std::span<const typename Prepared::Kernel> kernels,
                                     const std::string& items) {
  std::vector<Route> routes;
  const auto add = [&](const std::string& name, std::string what, const typename Prepared::Kernel& kernel,
                       Form form) {
    routes.push_back({"row-stream/" + name, std::move(what), kernel.fused ? 5. : 100.,
                      form == Form::kRows ? 0. : 24., true,
                      [&kernel, form](const auto& mesh, int depth, int threads) {
                        return std::make_unique<RowStreaming<Prepared>>(mesh, depth, threads, kernel, form);
                      }});
  };
  for (const auto& kernel : kernels)
    add(kernel.name, "row streaming, rows of a batch overwritten", kernel, Form::kRows);
  add("whole-" + items, "row streaming, all vertices kept", kernels.front(), Form::kWhole);
  add("streamed", "row streaming, all vertices kept, written past the caches", kernels.front(),
      Form::kStreamed);
  return routes;
}

}  // namespace

std::vector<Route> our_routes() {
  std::vector<Route> routes = row_stream_routes<Pairs>(rs::kernels(), "pairs");
  for (Route& route : paper_routes()) routes.push_back(std::move(route));
  return routes;
}

std::vector<Route> our_quad_routes() {
  return row_stream_routes<Quads>(rs::quad_kernels(), "quads");
}

}  // namespace limitcheck::bench
