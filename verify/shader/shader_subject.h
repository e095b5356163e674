// SPDX-License-Identifier: MIT
// A GLSL file as a subject: verify/subject/SHADERS.md.
#pragma once

#include <string>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// The subject that this file is. There is one in a process: it is meant for the worker of one subject
/// (verify/host/isolation/worker.h). Throws SubjectError(LC_INVALID_INPUT), with the file's line: it cannot be read, or a pragma means
/// nothing. What the compiler refuses, and that there is no OpenGL, its capabilities() say.
const lc_subject& shader_subject(const std::string& file);

}  // namespace limitcheck::verify
