// SPDX-License-Identifier: MIT
// Whole frames by row streaming: any depth per face, pairing, cracks closed, in parallel.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "data/control_mesh.h"
#include "fast/frame/engine.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

/// Tessellation on the fly by row streaming; see Engine for what it can do and what it throws. Grids of one
/// depth are evaluated together, one in each lane of a vector; an edge between unequal depths is evaluated at
/// its own depth, which gives the bits that a grid of that depth has there. Results do not depend on the
/// kernel.
///
/// The options name the scheme: Loop's for triangles, or Catmull-Clark's for any polygons, with infinitely
/// sharp edges and vertices; the constructor throws data::ArgumentError where something is semi-sharp and, of
/// triangles, where an edge inside the surface is sharp. The kernel for quads is the one of that name
/// unless another is given.
class StreamTessellator : public Engine<float> {
 public:
  explicit StreamTessellator(const data::ControlMesh& mesh, const TessellatorOptions& options = {},
                             const Kernel& kernel = kernels().front(), const QuadKernel* quads = nullptr);

  /// Called with the number of patches done and of all patches while they are evaluated (of one part of the
  /// frame after the other if it goes to a sink): by any thread, one at a time, some calls left out.
  void on_progress(std::function<void(std::size_t done, std::size_t total)> tell);

  /// Largest memory of a thread in the frames so far, output aside; at depth 5 at most 256 000 bytes,
  /// whatever the mesh. Of these 156 000 are the kernel's, the rest are border points of faces in repair.
  std::size_t worker_bytes() const;

 private:
  static std::unique_ptr<FrameEngine<float>> make_state(const data::ControlMesh& mesh,
                                                        const TessellatorOptions& options,
                                                        const Kernel& kernel, const QuadKernel* quads);
};

}  // namespace limitcheck::fast::row_stream
