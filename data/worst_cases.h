// SPDX-License-Identifier: MIT
// Files of cases that stand beside these sources, or where they were installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace limitcheck::data {

/// A file of this folder by its name, in the source tree, or where it was installed.
std::filesystem::path data_file(const std::string& name);

/// The meshes on which tessellators have come nearest to their bounds, or failed, so far: the names
/// (data/generators/named_mesh.h) in worst_cases.json, each once, in the order of the file. Throws
/// InputError (FILE_CANNOT_OPEN, FILE_SYNTAX) if the file is absent or not of its form.
std::vector<std::string> worst_case_meshes();

}  // namespace limitcheck::data
