// SPDX-License-Identifier: MIT
#include "data/io/write.h"

#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iterator>

#include "data/error.h"
#include "data/io/format.h"

namespace limitcheck::data {
namespace {

void append_obj(std::string& text, const ControlMesh& mesh) {
  for (const auto& p : mesh.positions)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) {
    fmt::format_to(std::back_inserter(text), "f {} {} {}\n", std::int64_t{t[0]} + 1, std::int64_t{t[1]} + 1,
                   std::int64_t{t[2]} + 1);
  }
}

// The body of OFF and of ascii PLY.
void append_lines(std::string& text, const ControlMesh& mesh) {
  for (const auto& p : mesh.positions)
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles)
    fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", t[0], t[1], t[2]);
}

template <class Integer>
void append_little_endian(std::string& bytes, Integer bits) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) bytes += static_cast<char>(bits >> 8 * i & 0xff);
}

void append_ply(std::string& text, const ControlMesh& mesh, bool ascii) {
  text += fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      ascii ? "ascii" : "binary_little_endian", mesh.positions.size(), mesh.triangles.size());
  if (ascii) {
    append_lines(text, mesh);
    return;
  }
  for (const auto& p : mesh.positions) {
    for (const double x : p) append_little_endian(text, std::bit_cast<std::uint64_t>(x));
  }
  for (const auto& t : mesh.triangles) {
    text += '\3';
    for (const std::int32_t v : t) append_little_endian(text, static_cast<std::uint32_t>(v));
  }
}

// Empty, or the system's reason why the content could not be written.
std::string write_all(const std::filesystem::path& file, const char* mode, const std::string& content) {
  std::FILE* stream = std::fopen(file.c_str(), mode);
  if (stream == nullptr) return std::strerror(errno);
  const bool written = std::fwrite(content.data(), 1, content.size(), stream) == content.size();
  int error = written ? 0 : errno;
  if (std::fclose(stream) != 0 && error == 0) error = errno;
  return error == 0 ? "" : std::strerror(error);
}

}  // namespace

std::string mesh_content(const ControlMesh& mesh, FileFormat format, const WriteOptions& options) {
  std::string text;
  switch (format) {
    case FileFormat::kObj:
      append_obj(text, mesh);
      break;
    case FileFormat::kOff:
      text = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
      append_lines(text, mesh);
      break;
    case FileFormat::kPly:
      append_ply(text, mesh, options.ascii_ply);
      break;
    case FileFormat::kStl:
      throw InputError("FILE_UNSUPPORTED", "", 0, "STL is read, not written: it has no vertices");
  }
  return text;
}

void write_mesh(const std::filesystem::path& name, const ControlMesh& mesh, const WriteOptions& options) {
  const std::string content = mesh_content(mesh, io::format_of(name), options);
  const auto refuse = [&](const std::string& why) {
    throw InputError("FILE_CANNOT_WRITE", name.string(), 0, why);
  };

  std::error_code error;
  // Through a link, as any program that opens it would, rather than in its place.
  std::filesystem::path file = name;
  if (std::filesystem::is_symlink(name, error))
    if (auto target = std::filesystem::canonical(name, error); !error) file = std::move(target);
  const auto type = std::filesystem::status(file, error).type();
  if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular) {
    const std::string why = write_all(file, "wb", content);
    if (!why.empty()) refuse(why);
    return;
  }

  const std::filesystem::path temporary = file.string() + fmt::format(".partial-{}", getpid());
  std::string why = write_all(temporary, "wbx", content);
  if (why.empty()) {
    std::filesystem::rename(temporary, file, error);
    if (error) why = error.message();
  }
  if (!why.empty()) {
    std::filesystem::remove(temporary, error);
    refuse(why);
  }
}

}  // namespace limitcheck::data
