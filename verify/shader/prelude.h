// SPDX-License-Identifier: MIT
// What a shader of the shader door is given (verify/subject/SHADERS.md): the control mesh as numbers in one buffer, and
// the GLSL before and behind it that reads them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "verify/gl/compute.h"
#include "verify/gl/context.h"
#include "verify/shader/programs.h"

namespace limitcheck::verify {

/// 3 V coordinates. Of each half-edge (h begins at corner h): vertex, twin (-1 at the boundary), edge, face, sharpness
/// (10 at the boundary). The first half-edge of each face, and C. The sharpness of each vertex. Coordinates and
/// sharpness are bits of floats. The mesh is an oriented manifold.
struct HalfEdges {
  std::vector<std::int32_t> words;
  std::array<std::int64_t, 4> counts{};  // V F C E
  explicit HalfEdges(const lc_mesh& mesh);
};

/// A file by OpenGL, for one scheme. Throws SubjectError(LC_INVALID_INPUT), with the file's line, if the driver refuses it, and
/// std::runtime_error if there is no OpenGL.
class GlPrograms : public ComputePrograms {
 public:
  GlPrograms(const ShaderSource& source, lc_scheme scheme);
  const std::string& device() const override { return gl_device(); }
  std::int64_t most_bytes_of_a_buffer() const override;
  void run(std::span<const ComputeStep> steps, std::vector<ComputeBuffer>& buffers) const override;
  /// In use, knowing these. The caller holds a CurrentGl.
  const GlProgram& used(std::size_t program, const Parameters& parameters) const;

 private:
  std::vector<std::unique_ptr<GlProgram>> programs_;
};

/// A file of one of the first two forms with all that it is given, as glslangValidator takes it: `-V`, and for a pass `-DNAME`.
/// Throws SubjectError(LC_INVALID_INPUT).
std::string vulkan_text(const ShaderSource& source);

// Words of the output buffer before its first vertex: the largest number of a vertex that is none and the smallest one,
// less 1; the same of triangles. -1: all were vertices, or triangles.
inline constexpr std::size_t kOutputHead = 4;
// Numbers of a patch in the input: face, corner, steps.
inline constexpr std::size_t kPatchWords = 3;
// Numbers that lc_put delivers of a vertex: position, normal, face, corner, u, v.
inline constexpr std::size_t kPutWords = 10;

}  // namespace limitcheck::verify
