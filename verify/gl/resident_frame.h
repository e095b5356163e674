// SPDX-License-Identifier: MIT
// Frames of the engine whose points are made on a GPU and stay there: what a renderer would do with the shaders of
// fast/gpu.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/stream/stream_tessellator.h"
#include "verify/gl/frame_recorder.h"
#include "verify/gl/recorded_points.h"

namespace limitcheck::verify {

/// Frames as patches (PatchMesh): the processor culls, pairs faces, plans cracks and index patterns, and gathers rings; OpenGL's
/// device evaluates, in the context of CurrentGl, which no caller may hold. Vertices have the bits of frame_by_gl(), of 16 bytes
/// where the device divides as IEEE 754 says; else packed normals may be a step off.
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

  /// Plans a frame, at depths to fast::gpu::kMaxDepth (one more on faces that are cut into quads) or by a strategy and a camera
  /// as Engine::frame() does, and gives the device what it needs. Throws std::runtime_error if the vertices of this frame are
  /// more than a buffer of the device holds; after any exception there is no frame until the next plan.
  template <class... Wanted>
  fast::FrameStats plan(const Wanted&... wanted) try {
    for (bool anew = false;; anew = true) {
      FrameRecorder recorder;
      const fast::FrameStats stats = engine_.frame(wanted..., patches_);
      if (give(recorder, anew)) return stats;
    }
  } catch (...) {
    forget();
    throw;
  }
  /// As Engine::move_points(): the next plan is for these.
  void move_points(std::span<const std::array<double, 3>> positions) { engine_.move_points(positions); }

  /// Evaluates what the last plan has added, as often as it is called, and waits until the device is done. The next plan takes
  /// for granted that it was called.
  void run() const;

  /// The calls that draw the frame and the index patterns; its vertices are not here but in vertices().
  const fast::PatchMesh<float>& patches() const { return patches_; }
  /// The buffer of SurfaceVertex or CompactVertex, until the next plan.
  std::uint32_t vertices() const { return vertices_; }
  /// The bytes of all vertices, those of no draw as well.
  std::vector<std::byte> read() const;

 private:
  std::size_t bytes() const;  // of the vertices
  void make_room();
  bool give(FrameRecorder& recorder, bool anew);
  void forget();
  std::vector<fast::gpu::Copy> copies(const FrameRecorder& recorder, const PlacedVertices& placed,
                                      std::vector<float>& more) const;

  fast::row_stream::StreamTessellator engine_;
  fast::PatchMesh<float> patches_;
  bool compact_;
  std::size_t most_bytes_;
  RecordedPoints points_;
  std::uint32_t vertices_ = 0;
  std::size_t room_ = 0;  // bytes of vertices_
};

}  // namespace limitcheck::verify
