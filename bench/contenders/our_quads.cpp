// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "bench/contenders/contender.h"
#include "fast/stream/quad_row_stream.h"

namespace limitcheck::bench {

namespace {

namespace rs = fast::row_stream;

/// Adjacency, rings and vertex limits, the faces sorted for the lanes; then rows or whole quads.
class QuadStreaming final : public Contender {
 public:
  enum class Form { kRows, kWhole, kStreamed };

  QuadStreaming(const data::ControlMesh& mesh, int depth, int threads, const rs::QuadKernel& kernel,
                Form form)
      : depth_(depth), threads_(threads), form_(form), mesh_(mesh), stream_(mesh_, kernel) {
    faces_.resize(mesh.faces.size());
    std::iota(faces_.begin(), faces_.end(), 0);
    faces_ = stream_.sorted(faces_);
    if (form != Form::kRows) out_.resize(faces_.size() * per_quad());
  }

  void run() override {
    // Pieces of some batches each, for the quads of a piece that do not fill a batch run in one that is not
    // full.
    constexpr std::size_t kPiece = 256;
    in_parallel((faces_.size() + kPiece - 1) / kPiece, threads_, [&](std::size_t first, std::size_t last) {
      first *= kPiece, last = std::min(last * kPiece, faces_.size());
      const auto some = std::span<const std::int32_t>(faces_).subspan(first, last - first);
      auto workspace = pool_.take([] { return std::make_unique<rs::Workspace>(); });
      rs::Vertex* out = out_.data() + first * (out_.empty() ? 0 : per_quad());
      if (form_ == Form::kRows) stream_.rows(some, depth_, *workspace, nullptr, nullptr);
      if (form_ == Form::kWhole) stream_.whole(some, depth_, *workspace, out);
      if (form_ == Form::kStreamed) stream_.streamed(some, depth_, *workspace, out);
      pool_.give(std::move(workspace));
    });
    benchmark::ClobberMemory();
  }
  double evaluated() const override { return static_cast<double>(faces_.size() * per_quad()); }

 private:
  std::size_t per_quad() const { return static_cast<std::size_t>(rs::side(depth_) * rs::side(depth_)); }

  int depth_, threads_;
  Form form_;
  fast::QuadMesh mesh_;
  rs::QuadRowStream stream_;
  std::vector<std::int32_t> faces_;
  Pool<rs::Workspace> pool_;
  std::vector<rs::Vertex> out_;
};

}  // namespace

std::vector<Route> our_quad_routes() {
  std::vector<Route> routes;
  const auto add = [&](std::string name, std::string what, const rs::QuadKernel& kernel,
                       QuadStreaming::Form form) {
    routes.push_back({std::move(name), std::move(what), kernel.fused ? 5. : 100.,
                      form == QuadStreaming::Form::kRows ? 0. : 24., true,
                      [&kernel, form](const auto& mesh, int depth, int threads) {
                        return std::make_unique<QuadStreaming>(mesh, depth, threads, kernel, form);
                      }});
  };
  for (const rs::QuadKernel& kernel : rs::quad_kernels())
    add(std::string("row-stream/") + kernel.name, "row streaming, rows of a batch overwritten", kernel,
        QuadStreaming::Form::kRows);
  add("row-stream/whole-quads", "row streaming, all vertices kept", rs::quad_kernels().front(),
      QuadStreaming::Form::kWhole);
  add("row-stream/streamed", "row streaming, all vertices kept, written past the caches",
      rs::quad_kernels().front(), QuadStreaming::Form::kStreamed);
  return routes;
}

}  // namespace limitcheck::bench
