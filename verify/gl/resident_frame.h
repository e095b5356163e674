// SPDX-License-Identifier: MIT
// Frames of the engine whose points are made on a GPU and stay there: what a renderer would do with the shaders of
// fast/gpu.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/gpu/shaders.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/gl/frame_recorder.h"

namespace limitcheck::verify {

class GlProgram;

/// Frames as patches (PatchMesh): the processor culls, pairs faces, plans cracks and index patterns, and gathers rings; OpenGL's
/// device evaluates, in the context of CurrentGl, which no caller may hold. Vertices have the bits of a StreamTessellator with
/// engine_kernels_by_gl(), of 16 bytes where the device divides as IEEE 754 says; else packed normals may be a step off.
class ResidentFrame {
 public:
  /// form   `incremental`: patches that are as they were are not evaluated again; `compact`: vertices of 16 bytes
  /// Throws std::runtime_error if there is no OpenGL, and what StreamTessellator throws; provenance cannot be had
  /// (data::ArgumentError).
  ResidentFrame(const data::ControlMesh& mesh, const fast::TessellatorOptions& options,
                const fast::PatchOptions& form = {});
  ~ResidentFrame();
  ResidentFrame(const ResidentFrame&) = delete;
  ResidentFrame& operator=(const ResidentFrame&) = delete;

  /// Plans a frame, at depths to fast::gpu::kMaxDepth or by a strategy and a camera as Engine::frame() does, and gives the
  /// device what it needs. Throws std::runtime_error if the vertices are more than a buffer of the device holds.
  template <class... Wanted>
  fast::FrameStats plan(const Wanted&... wanted) {
    FrameRecorder recorder;
    const fast::FrameStats stats = engine_.frame(wanted..., patches_);
    give(recorder);
    return stats;
  }
  /// As Engine::move_points(): the next plan is for these.
  void move_points(std::span<const std::array<double, 3>> positions) { engine_.move_points(positions); }

  /// Evaluates what the last plan wants, as often as it is called, and waits until the device is done.
  void run() const;

  /// The calls that draw the frame and the index patterns; its vertices are not here but in vertices().
  const fast::PatchMesh<float>& patches() const { return patches_; }
  /// The buffer of SurfaceVertex or CompactVertex, until the next plan.
  std::uint32_t vertices() const { return vertices_; }
  /// The bytes of all vertices, those of no draw as well.
  std::vector<std::byte> read() const;

 private:
  using Buffer = std::uint32_t;
  struct Dispatch {
    const GlProgram* program;
    Buffer uniforms, given, writes, reads, reads_too, places;
    std::size_t groups;
  };

  std::size_t vertex_bytes() const;
  std::size_t vertex_count() const { return patches_.vertices().size(); }
  Buffer buffer(const void* content, std::size_t bytes);
  void forget();
  void make_room();
  void give(FrameRecorder& recorder);
  void add(std::span<const FrameRecorder::Batch> alike, Buffer scratch);
  void add_run(Dispatch dispatch, fast::gpu::BatchUniforms uniforms, std::size_t first, std::size_t groups);
  std::vector<fast::gpu::Copy> copies(const FrameRecorder& recorder, std::vector<float>& given) const;

  fast::row_stream::StreamTessellator engine_;
  fast::PatchMesh<float> patches_;
  bool compact_;
  std::size_t most_bytes_ = 0;  // of a buffer
  Buffer vertices_ = 0;
  std::size_t room_ = 0;         // bytes of vertices_
  std::vector<Buffer> buffers_;  // of the last plan
  std::vector<Dispatch> dispatches_;
};

}  // namespace limitcheck::verify
