// SPDX-License-Identifier: MIT
// The GLSL that stands before and behind a shader of the shader door: verify/subject/SHADERS.md says what it gives.
#pragma once

#include <memory>
#include <vector>

#include "verify/gl/compute.h"
#include "verify/shader/source.h"

namespace limitcheck::verify {

/// The programs of a file for one scheme: one, or one for each pass. Throws SubjectError(LC_INVALID_INPUT), with the
/// file's line.
std::vector<std::unique_ptr<GlProgram>> compiled(const ShaderSource& source, lc_scheme scheme);

// Words of the output buffer before its first vertex: the largest number of a vertex that is none and the smallest one,
// less 1; the same of triangles. -1: all were vertices, or triangles.
inline constexpr std::size_t kOutputHead = 4;
// Numbers of a patch in the input: face, corner, steps.
inline constexpr std::size_t kPatchWords = 3;
// Numbers that lc_put delivers of a vertex: position, normal, face, corner, u, v.
inline constexpr std::size_t kPutWords = 10;

}  // namespace limitcheck::verify
