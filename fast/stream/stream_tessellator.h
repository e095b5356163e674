// SPDX-License-Identifier: MIT
// Whole frames by row streaming: any depth per face, pairing, cracks closed, in parallel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "data/control_mesh.h"
#include "fast/frame/frame_options.h"
#include "fast/frame/sink.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

/// As fast::Tessellator<float>, with the points from row streaming: pairs of one
/// depth together in the lanes of a vector, edges between unequal depths evaluated at
/// the edge's own depth, which gives the bits that a pair of that depth has there.
/// Depths 0..10. Results do not depend on the number of threads nor on the kernel.
///   throws   std::invalid_argument, as fast::Tessellator
class StreamTessellator {
 public:
  explicit StreamTessellator(const data::ControlMesh& mesh, const TessellatorOptions& options = {},
                             const Kernel& kernel = kernels().front());
  ~StreamTessellator();
  StreamTessellator(StreamTessellator&&) noexcept;
  StreamTessellator& operator=(StreamTessellator&&) noexcept;

  const Adjacency& adjacency() const;

  FrameStats frame(std::span<const std::int32_t> depth, DrawList<float>& out);
  FrameStats frame(std::span<const std::int32_t> depth, IndexedMesh<float>& out);
  /// Depths by a strategy of section 4.1, at most options.max_depth.
  FrameStats frame(const DepthOptions& strategy, const Camera& camera, DrawList<float>& out);
  FrameStats frame(const DepthOptions& strategy, const Camera& camera, IndexedMesh<float>& out);

  /// The depths of the last frame after pairing, one per face, and its pairs.
  const PairingResult& last_pairing() const;

  /// Called with batches done and their number while a frame is evaluated: by any thread, one at a time, some
  /// calls left out.
  void on_progress(std::function<void(std::size_t done, std::size_t total)> tell);

  /// Largest memory of a thread in the last frame, output aside; at depth 5 at most 200 000 bytes, whatever
  /// the mesh.
  std::size_t worker_bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limitcheck::fast::row_stream
