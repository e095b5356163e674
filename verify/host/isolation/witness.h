// SPDX-License-Identifier: MIT
// The input on which a subject in a process of its own broke down, kept so that it can be repeated.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "verify/host/isolation/child_process.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// As one word for a shell: quoted if it needs to be.
std::string shell_word(const std::string& text);

struct Input {
  std::string flag, what;  // --program and its command; or a library's file or a built-in subject's name
  bool isolate = false;    // a built-in subject
  std::string options;
  ProcessLimits limits;
  const lc_mesh* mesh = nullptr;             // none: it broke down before it got one
  std::span<const std::int32_t> face_depth;  // none: it was not asked to tessellate
};

/// Saves the control mesh (OBJ, bit for bit) and, unless all are the same, the depths of the faces (one per
/// line) in `folder`, under names made from their contents, so that the same breakdown is kept once. Returns
/// "; again with: limitcheck audit ...", or why nothing could be saved. Never throws.
std::string save_input(const std::string& folder, const Input& input);

}  // namespace limitcheck::verify
