// SPDX-License-Identifier: MIT
#include "data/io/format.h"

#include <algorithm>
#include <cctype>

#include "data/error.h"

namespace limitcheck::data::io {

FileFormat format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return FileFormat::kObj;
  if (extension == ".off") return FileFormat::kOff;
  if (extension == ".ply") return FileFormat::kPly;
  if (extension == ".stl") return FileFormat::kStl;
  throw InputError("FILE_UNKNOWN_FORMAT", file.string(), 0,
                   "the name does not end in .obj, .off, .ply or .stl");
}

}  // namespace limitcheck::data::io
