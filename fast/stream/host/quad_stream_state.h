// SPDX-License-Identifier: MIT
// Frames of Catmull-Clark's scheme by row streaming.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "fast/frame/quad_state.h"
#include "fast/stream/host/quad_stream_worker.h"
#include "fast/stream/host/stream_hooks.h"

namespace limitcheck::fast::row_stream {

struct QuadStreamState final : QuadEngineState<float>, StreamHooks {
  /// throws   data::ArgumentError: what QuadEngineState and QuadRowStream refuse
  QuadStreamState(const data::ControlMesh& given, const TessellatorOptions& with, const QuadKernel& kernel);

  void points_moved() override;
  void prepare() override { worker_bytes = 0; }
  void draw(std::size_t first, std::size_t last, DrawList<float>& out) override;
  void index(const QuadIndexLayout& layout, IndexedMesh<float>& out) override;
  void write_patches(std::span<const PatchPlace> places, const PatchTarget<float>& out) override;
  SurfaceVertex<float> limit(std::int32_t v) const override { return stream_->limit(v); }
  std::int64_t zero_normals() const override { return stream_->rings().degenerate_normals(); }

 private:
  template <class Skip>
  void make_batches(std::size_t first, std::size_t last, Skip&& skip);
  template <class MakeWriter, class Skip>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer, Skip&& skip, bool placed = false);

  std::optional<QuadRowStream> stream_;
  const QuadKernel& narrow_;
  std::vector<std::int32_t> rank_;  // of each quad, in the order that is best for the lanes

  std::vector<QuadStreamWorker> workers_;
  std::vector<QuadPart> parts_;
  std::vector<QuadFrameBatch> batches_;
};

}  // namespace limitcheck::fast::row_stream
