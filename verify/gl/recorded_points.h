// SPDX-License-Identifier: MIT
// What a FrameRecorder has kept, evaluated by OpenGL's device: for frames in the processor's memory, or in the device's.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "data/error.h"
#include "fast/frame/engine.h"
#include "fast/gpu/shaders.h"
#include "verify/gl/frame_recorder.h"

namespace limitcheck::verify {

class GlProgram;

/// Of shader storage. Throws std::runtime_error if there is no OpenGL.
std::size_t most_bytes_of_a_buffer();

/// Vertices of a frame in the device's memory, of 24 or 16 bytes.
struct PlacedVertices {
  std::uint32_t buffer = 0;
  const fast::row_stream::Vertex* first = nullptr;  // where the processor would have them
  bool compact = false;

  std::int64_t number(const float* place) const {
    return reinterpret_cast<const fast::row_stream::Vertex*>(place) - first;
  }
};

/// Batches in the device's memory, in the context of CurrentGl, which no caller may hold. What OpenGL refuses is a
/// std::runtime_error.
class RecordedPoints {
 public:
  /// most_bytes: no buffer is to be larger.
  explicit RecordedPoints(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  ~RecordedPoints();
  RecordedPoints(const RecordedPoints&) = delete;
  RecordedPoints& operator=(const RecordedPoints&) = delete;

  void clear();
  /// In place of those before; sorts them. Those of no place make `named` vertices, the first of which is the first one's.
  ///   more     numbers that are no kernel's, three for each position or normal, behind those of these vertices
  ///   copies   of vertices and of `more`, in threes of numbers, to the placed ones
  void give(std::span<FrameRecorder::Batch> batches, std::int64_t named, const PlacedVertices& placed = {},
            std::span<const float> more = {}, std::vector<fast::gpu::Copy> copies = {});
  /// Evaluates them all, and waits until the device is done.
  void run() const;
  /// The first of the vertices that have no place, six numbers each.
  void read(std::span<float> numbers) const;

 private:
  using Buffer = std::uint32_t;
  struct Dispatch {
    const GlProgram* program;
    Buffer uniforms, given, writes, reads, reads_too, places;
    std::size_t groups;
  };

  Buffer buffer(const void* content, std::size_t bytes);
  void forget();
  void add(std::span<const FrameRecorder::Batch> alike);
  void add_run(Dispatch dispatch, fast::gpu::BatchUniforms uniforms, std::size_t first, std::size_t groups);

  std::size_t most_bytes_;
  PlacedVertices placed_;
  std::int64_t first_ = 0;
  Buffer scratch_ = 0;
  std::vector<Buffer> buffers_;
  std::vector<Dispatch> dispatches_;
};

/// All vertices of a recorder whose grids are not placed, six numbers each, as many at a time as buffers of so many bytes hold;
/// and these in the place of their names.
std::vector<float> points_by_gl(FrameRecorder& recorder, std::size_t most_bytes = most_bytes_of_a_buffer());
void put_points(const std::vector<float>& points, std::span<fast::row_stream::Vertex> vertices);

/// A frame whose points are computed by OpenGL's device: Engine::frame() of an engine with the kernels of FrameRecorder that
/// place nothing, to depth fast::gpu::kMaxDepth, one more on faces that are cut into quads. In the context of CurrentGl,
/// which no caller may hold.
/// Throws std::runtime_error, too: there is no OpenGL, or it refuses something; data::ArgumentError: vertices are compact.
///
/// Bits: those of the scalar kernels on a number without fused multiply-add, on any GPU whose sums and products round
/// as IEEE 754 says; inside quads with the way that is taken to depth 4 at all (kFusedFrom).
template <class Output, class... Wanted>
fast::FrameStats frame_by_gl(fast::Engine<float>& engine, Output& out, const Wanted&... wanted) {
  if constexpr (requires { out.options().compact; })
    if (out.options().compact) throw data::ArgumentError("points by OpenGL: not of 16 bytes in this memory");
  FrameRecorder recorder;
  fast::FrameStats stats = engine.frame(wanted..., out);
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<float> points = points_by_gl(recorder);
  if constexpr (requires { out.vertices(); })
    put_points(points, out.vertices());
  else
    put_points(points, out.vertices);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  stats.seconds_evaluation += seconds, stats.seconds_total += seconds;
  return stats;
}

}  // namespace limitcheck::verify
