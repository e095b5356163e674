// SPDX-License-Identifier: MIT
// What the two forms of a shader that compute run on: OpenGL, or Vulkan for a module of SPIR-V.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "verify/shader/source.h"

namespace limitcheck::verify {

/// What a program knows besides its buffers: uniforms, or push constants in this order.
inline constexpr std::array kParameters{"lc_V",     "lc_F",     "lc_C",      "lc_E",        "lc_depth",
                                        "lc_level", "lc_items", "lc_places", "lc_vertices", "lc_triangles"};
using Parameters = std::array<std::int32_t, kParameters.size()>;

/// A storage buffer. `content` is what it begins with, and afterwards that of its `size` bytes and of those behind them
/// up to the last that was written, within a guard zone.
struct ComputeBuffer {
  std::uint32_t binding;
  std::vector<std::byte> content;
  std::size_t size = content.size();
};

struct ComputeStep {
  std::size_t program;
  std::int64_t items;
  Parameters parameters;
};

/// The programs of a file for one scheme: one, or one for each pass.
class ComputePrograms {
 public:
  virtual ~ComputePrograms() = default;
  /// Device and driver, as a report names them.
  virtual const std::string& device() const = 0;
  virtual std::int64_t most_bytes_of_a_buffer() const = 0;
  /// One step after the other: what one writes, the next one reads.
  virtual void run(std::span<const ComputeStep> steps, std::vector<ComputeBuffer>& buffers) const = 0;
};

/// Of `my.spv`, or, with a pass NAME, of my.NAME.spv for each. Throws SubjectError(LC_INVALID_INPUT): there is no such file, no
/// Vulkan here, or the module is not what verify/subject/SHADERS.md asks for.
std::unique_ptr<ComputePrograms> spirv_programs(const ShaderSource& source);

}  // namespace limitcheck::verify
