// SPDX-License-Identifier: MIT
// All grids or quads of a mesh at once on a GPU, whose points stay there: what a renderer would do with the shaders of
// fast/gpu.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "fast/gpu/shaders.h"
#include "fast/plan/pairing.h"
#include "fast/stream/gather/rings.h"

namespace limitcheck::verify {

class GlProgram;

/// Grids or quads of one depth, ready in the memory of OpenGL's device; in the context of CurrentGl, which no caller may hold.
/// Their points have the bits of engine_kernels_by_gl(). None lies next to a sharp edge inside a surface of triangles, or to
/// a semi-sharp one.
class ResidentPoints {
 public:
  /// depth   to fast::gpu::kMaxDepth
  /// most    that are evaluated together, if buffers and dispatches of the device hold so many
  /// Throws std::runtime_error if there is no OpenGL, and data::ArgumentError.
  ResidentPoints(const fast::row_stream::LoopRings& rings, std::span<const fast::Grid> grids, int depth,
                 std::size_t most = kMost);
  /// Those that can go together should follow each other (QuadRowStream::sorted).
  ResidentPoints(const fast::row_stream::QuadRings& rings, std::span<const std::int32_t> faces, int depth,
                 std::size_t most = kMost);
  ~ResidentPoints();
  ResidentPoints(const ResidentPoints&) = delete;
  ResidentPoints& operator=(const ResidentPoints&) = delete;

  /// Evaluates all, those that do not fit in one after the other into the same memory, and waits until the device is done.
  /// read: gets the six numbers of each vertex, row by row, grid after grid; regular quads before the others.
  void run(const std::function<void(std::span<const float>)>& read = nullptr) const;

 private:
  static constexpr std::size_t kMost = std::size_t{1} << 20;
  using Buffer = std::uint32_t;
  struct Step {  // of each part, or of a run of alike batches in it
    const GlProgram* program;
    std::size_t each;  // work groups of a grid
    Buffer reads, reads_too, writes;
  };
  struct Dispatch {
    Step step;
    Buffer uniforms;
    std::size_t groups;
  };
  struct Part {
    Buffer given;
    std::size_t grids;
    std::vector<Dispatch> dispatches;
  };

  void begin(int depth, std::size_t most);
  Buffer buffer(const void* content, std::size_t bytes);
  const GlProgram* program(fast::gpu::Shader shader, bool local);
  template <class Item, class Gather>
  void add_parts(std::span<const Item> items, int input_size, const std::vector<Step>& steps,
                 const Gather& gather);

  int depth_ = 0;
  std::size_t most_ = 0, points_of_a_grid_ = 0;
  std::vector<std::unique_ptr<GlProgram>> programs_;
  std::vector<Buffer> buffers_;
  std::vector<Part> parts_;
  Buffer points_ = 0;
};

}  // namespace limitcheck::verify
