// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace limitcheck::data::io {

/// All bytes of a file, or of a pipe until it ends. Throws InputError: FILE_CANNOT_OPEN (there is none, or it
/// is a directory or a device: that might never end), FILE_TOO_LARGE (more than 4 GiB).
std::string whole_content(const std::filesystem::path& file);

}  // namespace limitcheck::data::io
