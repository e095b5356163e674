// SPDX-License-Identifier: MIT
// The format of a file from its name.
#pragma once

#include <filesystem>

#include "data/io/read.h"

namespace limitcheck::data::io {

/// By extension, in any case. Throws InputError FILE_UNKNOWN_FORMAT.
FileFormat format_of(const std::filesystem::path& file);

}  // namespace limitcheck::data::io
