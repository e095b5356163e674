// SPDX-License-Identifier: MIT
#include "data/io/read.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/whole_content.h"

namespace limitcheck::data {
namespace {

// The content is held in memory, and what is made of it takes up to twelve times as much.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{4} << 30;

struct Format {
  std::string_view extension;
  io::PolygonSoup (*read)(std::string_view content, const std::string& name);
};
// In the order of FileFormat.
constexpr Format kFormats[] = {{".obj", io::read_obj},
                               {".off", io::read_off},
                               {".ply", io::read_ply},
                               {".stl", io::read_stl},
                               {".usda", io::read_usda}};

io::PolygonSoup parse(std::string_view content, FileFormat format, const std::string& name) {
  return kFormats[static_cast<std::size_t>(format)].read(content, name);
}

}  // namespace

std::string io::lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

FileFormat io::format_of(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  for (std::size_t k = 0; k < std::size(kFormats); ++k)
    if (extension == kFormats[k].extension) return static_cast<FileFormat>(k);
  throw InputError("FILE_UNKNOWN_FORMAT", file.string(), 0,
                   "the name does not end in .obj, .off, .ply, .stl, .usda, .gltf or .glb");
}

std::string io::whole_content(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("FILE_CANNOT_OPEN", file.string(), 0, why);
  };
  std::error_code ignored;
  const auto type = std::filesystem::status(file, ignored).type();
  // A pipe is welcome; a device might never end.
  if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular &&
      type != std::filesystem::file_type::fifo) {
    refuse("not a file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) refuse(std::strerror(errno));
  std::string content;
  const auto size = std::filesystem::file_size(file, ignored);
  const auto too_large = [&] {
    throw InputError("FILE_TOO_LARGE", file.string(), 0,
                     fmt::format("more than {} GiB, the largest file that is read", kMostBytes >> 30));
  };
  if (!ignored && size > kMostBytes) too_large();
  if (!ignored) content.reserve(size);
  char buffer[1 << 16];
  for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, stream.get())) > 0;) {
    if (content.size() + count > kMostBytes) too_large();  // of a pipe
    content.append(buffer, count);
  }
  if (std::ferror(stream.get()) != 0) refuse(std::strerror(errno));
  return content;
}

io::PolygonSoup io::read_soup(const std::filesystem::path& file) {
  const FileFormat format = format_of(file);
  return parse(io::whole_content(file), format, file.string());
}

ControlMesh read_mesh(const std::filesystem::path& file, const ReadOptions& options) {
  const FileFormat format = io::format_of(file);
  return read_mesh(io::whole_content(file), format, file.string(), options);
}

ControlMesh read_mesh(std::string_view content, FileFormat format, const std::string& name,
                      const ReadOptions& options) {
  return io::require_valid(parse(content, format, name), name, options).mesh;
}

}  // namespace limitcheck::data
