// SPDX-License-Identifier: MIT
#include "data/io/read.h"

#include "data/io/format.h"
#include "data/io/polygon_soup.h"
#include "data/io/whole_content.h"

namespace limitcheck::data {
namespace {

io::PolygonSoup parse(std::string_view content, FileFormat format, const std::string& name) {
  switch (format) {
    case FileFormat::kObj:
      return io::read_obj(content, name);
    case FileFormat::kOff:
      return io::read_off(content, name);
    case FileFormat::kPly:
      return io::read_ply(content, name);
    case FileFormat::kStl:
      return io::read_stl(content, name);
  }
  return {};
}

}  // namespace

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
