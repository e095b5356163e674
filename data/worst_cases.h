// SPDX-License-Identifier: MIT
// The meshes on which tessellators have come nearest to their bounds, or failed, so far.
#pragma once

#include <string>
#include <vector>

namespace limitcheck::data {

/// The names of the meshes in worst_cases.json (data/generators/named_mesh.h), each once, in the order of the
/// file; it stands beside known_answers.json. Throws InputError (FILE_CANNOT_OPEN, FILE_SYNTAX).
std::vector<std::string> worst_case_meshes();

}  // namespace limitcheck::data
