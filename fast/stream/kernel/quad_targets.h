// SPDX-License-Identifier: MIT
// The compiled variants of the float kernel for quads, and which of them this machine can run.
#pragma once

#include <span>

#include "fast/frame/stores.h"
#include "fast/stream/kernel/quad_layout.h"

namespace limitcheck::fast::row_stream {

/// One compiled variant, named as those for Loop's scheme. All give the same bits.
struct QuadKernel {
  const char* name;
  int lanes;   // quads per batch
  bool fused;  // hardware multiply-add; without it the bits come from std::fma, slowly
  /// A batch from input to target: quads of any valences, regular quads, sides alone. Each returns `name` of
  /// the variant that really ran, as compiled into it.
  using Run = const char*(const QuadBatch<float>& batch, const KernelPlacement<float>& placement, float* work,
                          const QuadTarget<float>& target);
  Run* quads;    // QuadStream
  Run* patches;  // QuadPatch
  Run* sides;    // QuadStream, row 0 only
  /// Quads and regular quads in whole cache lines, see Kernel::run_lines. Null: this variant has none.
  using Lines = void(const QuadBatch<float>& batch, const KernelPlacement<float>& placement, float* work,
                     float* const* lane, Stores stores);
  Lines* quad_lines;
  Lines* patch_lines;
};

/// The variants that this machine can run, best first; the last is plain scalar code and always there.
std::span<const QuadKernel> quad_kernels();

/// The variant of that name, or nullptr if there is none or the machine cannot run it.
const QuadKernel* find_quad_kernel(const char* name);

}  // namespace limitcheck::fast::row_stream
