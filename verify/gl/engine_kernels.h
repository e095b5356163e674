// SPDX-License-Identifier: MIT
// Our engine on a GPU: the kernels of row streaming by OpenGL.
#pragma once

#include "fast/gpu/shaders.h"
#include "fast/stream/kernel/targets.h"

namespace limitcheck::verify {

class GlProgram;

/// A shader of the engine, compiled when it is first asked for; it stays as long as the process. In a context that is current.
const GlProgram& engine_program(fast::gpu::Shader shader, int depth, bool local, fast::gpu::Output output);

struct EngineKernels {
  const fast::row_stream::Kernel& triangles;
  const fast::row_stream::QuadKernel& quads;
};

/// The shaders of fast/gpu as kernels, in the context of CurrentGl, which no caller may hold: a RowStream,
/// QuadRowStream or StreamTessellator that is made with them computes the points of grids, quads, edges and sides there
/// and the rest here, as with any kernel. Depths to fast::gpu::kMaxDepth, data::ArgumentError for others. Threads wait for each
/// other. Throws std::runtime_error if there is no OpenGL, and kernels do if the driver refuses a shader.
///
/// Bits: those of the scalar kernels on a number without fused multiply-add, on any GPU whose sums and products round
/// as IEEE 754 says; inside quads with the way that is taken to depth 4 at all (kFusedFrom).
EngineKernels engine_kernels_by_gl();

}  // namespace limitcheck::verify
