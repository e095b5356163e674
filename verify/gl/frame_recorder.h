// SPDX-License-Identifier: MIT
// Kernels that compute nothing: they keep what they are asked for, and put names where points would go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "fast/gpu/shaders.h"
#include "fast/stream/kernel/targets.h"

namespace limitcheck::verify {

/// While it lives, a frame of a StreamTessellator that has its kernels is planned but not evaluated: `batches` gets what is
/// to be evaluated. The frame's vertices then have names where positions and normals would be, but for what the processor
/// itself has computed, and for whole grids of patches if they are placed. One at a time, in the whole process.
class FrameRecorder {
 public:
  struct Batch {
    fast::gpu::Shader shader;
    bool local;  // some part has an origin of its own
    fast::gpu::BatchUniforms uniforms;
    // Of each lane's grid, where nothing is written; the last ones may be the same. Or there are none, and its vertices have
    // numbers from `first` on, lane after lane.
    std::vector<const float*> place = {};
    std::vector<float> input = {};  // lanes() side by side
    std::int64_t first = 0;

    std::size_t lanes() const { return static_cast<std::size_t>(uniforms.given_stride); }
    bool placed() const { return !place.empty(); }
  };

  /// The kernels of the recorder that lives, without which they throw std::logic_error. Depths beyond fast::gpu::kMaxDepth are
  /// a data::ArgumentError.
  ///   placed   whether whole grids of patches are: then a batch has as many lanes as there can be, else four
  static const fast::row_stream::Kernel& triangles(bool placed = false);
  static const fast::row_stream::QuadKernel& quads(bool placed = false);

  FrameRecorder();
  ~FrameRecorder();
  FrameRecorder(const FrameRecorder&) = delete;
  FrameRecorder& operator=(const FrameRecorder&) = delete;

  /// The number that a position or normal stands for, if it is a name: twice that of the vertex, and one more for the normal.
  static std::optional<std::int64_t> named(const fast::Vec3<float>& v);

  std::vector<Batch> batches;
  std::int64_t vertices = 0;  // of those that are not placed

 private:
  template <bool placed>
  friend struct RecordingKernels;
  std::int64_t add(Batch batch, const float* input, int numbers, int rows);

  std::lock_guard<std::mutex> alone_;
  std::mutex adding_;
};

}  // namespace limitcheck::verify
