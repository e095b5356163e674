// SPDX-License-Identifier: MIT
// Files as they are: their format, their bytes.
#pragma once

#include <filesystem>
#include <string>

#include "data/io/read.h"

namespace limitcheck::data::io {

/// The extension of a file in lower case: ".obj".
std::string lower_extension(const std::filesystem::path& file);

/// The format of a file by its extension, in any case. Throws InputError FILE_UNKNOWN_FORMAT.
FileFormat format_of(const std::filesystem::path& file);

/// All bytes of a file, or of a pipe until it ends. Throws InputError: FILE_CANNOT_OPEN (there is none, or it
/// is a directory or a device: that might never end), FILE_TOO_LARGE (more than 4 GiB).
std::string whole_content(const std::filesystem::path& file);

}  // namespace limitcheck::data::io
