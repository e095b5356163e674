// SPDX-License-Identifier: MIT
// The compiled variants of the float kernels of either scheme, and which of them this machine can run.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "fast/frame/stores.h"
#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::row_stream {

/// One compiled variant of the float kernel. All give the same bits.
struct Kernel {
  const char* name;  // "avx512", "avx2", "avx2/4" (128-bit), "sse4", "neon", "scalar"
  int lanes;         // grids per batch
  bool fused;        // hardware multiply-add; without it the bits come from std::fma, slowly
  /// A batch from input to target, see Stream. Returns `name` of the variant that really ran, as compiled
  /// into it.
  const char* (*run)(float* input, int depth, const BatchPlacement<float>& placement, float* work,
                     const Target<float>& target);
  /// `lanes` control edges, see EdgeStream: the vertices of edge e from out + e * lane_stride, in numbers.
  void (*run_edges)(const float* input, int depth, const BatchPlacement<float>& placement, float* work,
                    float* out, std::ptrdiff_t lane_stride);
  /// A batch to memory that each grid has for itself, in whole cache lines: that of lane k, row by row, from
  /// lane[k] on, and no byte beyond. Past the caches the caller fences. Null: this variant has rows alone.
  void (*run_lines)(float* input, int depth, const BatchPlacement<float>& placement, float* work,
                    float* const* lane, Stores stores);
  /// Regular grids alone, see TrianglePatch, in both forms. Null: this kernel knows no polynomials, and is
  /// not told where edges are regular.
  decltype(run) run_patches = nullptr;
  decltype(run_lines) patch_lines = nullptr;
};

/// The variants that this machine can run, best first; the last is plain scalar code and always there.
std::span<const Kernel> kernels();

/// One compiled variant, named as those for Loop's scheme. All give the same bits.
struct QuadKernel {
  const char* name;
  int lanes;   // quads per batch
  bool fused;  // hardware multiply-add; without it the bits come from std::fma, slowly
  /// A batch from input to target: quads of any valences, regular quads, sides alone. Each returns `name` of
  /// the variant that really ran, as compiled into it.
  using Run = const char*(const QuadBatch<float>& batch, const Placement<float>& placement, float* work,
                          const QuadTarget<float>& target);
  Run* quads;    // QuadStream
  Run* patches;  // QuadPatch
  Run* sides;    // QuadStream, row 0 only
  /// Quads and regular quads in whole cache lines, see Kernel::run_lines. Null: this variant has none.
  using Lines = void(const QuadBatch<float>& batch, const Placement<float>& placement, float* work,
                     float* const* lane, Stores stores);
  Lines* quad_lines;
  Lines* patch_lines;
};

/// The variants that this machine can run, best first; the last is plain scalar code and always there.
std::span<const QuadKernel> quad_kernels();

/// The variant of that name, or nullptr if there is none or the machine cannot run it.
template <class Variant>
const Variant* find_variant(std::span<const Variant> all, std::string_view name) {
  for (const Variant& variant : all)
    if (name == variant.name) return &variant;
  return nullptr;
}
/// The kernel of this name; nullptr: this machine has none.
inline const Kernel* find_kernel(const char* name) {
  return find_variant(kernels(), name);
}
/// The same of quads.
inline const QuadKernel* find_quad_kernel(const char* name) {
  return find_variant(quad_kernels(), name);
}

}  // namespace limitcheck::fast::row_stream
