// SPDX-License-Identifier: MIT
#include "data/io/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>

#include "data/error.h"
#include "data/io/atomic_file.h"
#include "data/io/whole_content.h"

namespace limitcheck::data {
namespace {

// As a number in text: infinity has no spelling that all readers know.
float finite(float sharpness) {
  return std::min(sharpness, kInfiniteSharpness);
}

// OpenSubdiv's tags (obj.cpp).
void append_tags(std::string& text, const Sharpness& sharpness) {
  const auto line = [&](auto... arguments) { fmt::format_to(std::back_inserter(text), arguments...); };
  for (const SharpEdge& e : sharpness.edges)
    line(FMT_STRING("t crease 2/1/0 {} {} {}\n"), e.a, e.b, finite(e.sharpness));
  for (const SharpVertex& v : sharpness.vertices)
    line(FMT_STRING("t corner 1/1/0 {} {}\n"), v.vertex, finite(v.sharpness));
  if (sharpness.boundary == Boundary::kEdgeAndCorner) text += "t interpolateboundary 1/0/0 1\n";
  if (sharpness.creasing == Creasing::kChaikin) text += "t creasemethod 0/0/1 chaikin\n";
  if (sharpness.triangles == TriangleRule::kSmooth) text += "t smoothtriangles 0/0/1 smooth\n";
}

// The one channel that a format has a place for.
const Channel* texture_of(const ControlMesh& mesh, FileFormat format) {
  const auto found = std::find_if(mesh.channels.begin(), mesh.channels.end(), [&](const Channel& c) {
    return c.name == "uv" &&
           (format == FileFormat::kObj ? c.components <= 3 : format == FileFormat::kPly && c.components == 2);
  });
  return found == mesh.channels.end() ? nullptr : &*found;
}

void append_obj(std::string& text, const ControlMesh& mesh) {
  for (const auto& p : mesh.positions)
    fmt::format_to(std::back_inserter(text), "v {} {} {}\n", p[0], p[1], p[2]);
  const Channel* const uv = texture_of(mesh, FileFormat::kObj);
  if (uv)
    for (std::size_t i = 0; i < uv->values.size(); i += static_cast<std::size_t>(uv->components))
      fmt::format_to(
          std::back_inserter(text), "vt {}\n",
          fmt::join(std::span(uv->values).subspan(i, static_cast<std::size_t>(uv->components)), " "));
  for (std::size_t f = 0, corner = 0; f < mesh.faces.size(); ++f) {
    text += 'f';
    for (const std::int32_t v : mesh.faces[f]) {
      fmt::format_to(std::back_inserter(text), " {}", std::int64_t{v} + 1);
      if (uv) fmt::format_to(std::back_inserter(text), "/{}", std::int64_t{uv->corners[corner++]} + 1);
    }
    text += '\n';
  }
  if (uv && uv->rule)
    fmt::format_to(std::back_inserter(text), "t facevaryinginterpolateboundary 1/0/0 {}\n",
                   static_cast<int>(*uv->rule));
  append_tags(text, mesh.sharpness);
  for (const std::int32_t f : mesh.holes) fmt::format_to(std::back_inserter(text), "t hole 1/0/0 {}\n", f);
}

// A format that would lose some of it says so.
void require_only(const char* format, const ControlMesh& mesh, bool edges) {
  if (!mesh.holes.empty())
    throw InputError("FILE_UNSUPPORTED", "", 0, fmt::format("{} has no place for holes; OBJ has", format));
  Sharpness rest = mesh.sharpness;
  if (edges) rest.edges.clear();
  if (!rest.empty() || rest.creasing != Creasing::kUniform)
    throw InputError("FILE_UNSUPPORTED", "", 0,
                     fmt::format("{} has no place for {}; OBJ has", format,
                                 edges ? "sharp vertices and the choices of creases" : "sharpness"));
}

// The body of OFF and of ascii PLY.
void append_lines(std::string& text, const ControlMesh& mesh, const Channel* uv = nullptr) {
  for (const auto& p : mesh.positions)
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", p[0], p[1], p[2]);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    fmt::format_to(std::back_inserter(text), "{}", corners.size());
    for (const std::int32_t v : corners) fmt::format_to(std::back_inserter(text), " {}", v);
    if (uv != nullptr) fmt::format_to(std::back_inserter(text), " {}", 2 * corners.size());
    for (std::size_t k = 0; uv != nullptr && k < 2 * corners.size(); ++k)
      fmt::format_to(std::back_inserter(text), " {}",
                     uv->at(mesh.faces.first_corner(f) + k / 2, static_cast<int>(k % 2)));
    text += '\n';
  }
}

template <class Integer>
void append_little_endian(std::string& bytes, Integer bits) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) bytes += static_cast<char>(bits >> 8 * i & 0xff);
}

void append_ply(std::string& text, const ControlMesh& mesh, bool ascii) {
  std::size_t most = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) most = std::max(most, mesh.faces[f].size());
  const Channel* const uv = texture_of(mesh, FileFormat::kPly);
  const bool small = most < (uv == nullptr ? 256 : 128);
  text += fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list {} int vertex_indices\n",
      ascii ? "ascii" : "binary_little_endian", mesh.positions.size(), mesh.faces.size(),
      small ? "uchar" : "uint");
  if (uv != nullptr) text += fmt::format("property list {} double texcoord\n", small ? "uchar" : "uint");
  const auto& edges = mesh.sharpness.edges;
  if (!edges.empty())
    text +=
        fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\nproperty float sharpness\n",
                    edges.size());
  text += "end_header\n";
  if (ascii) {
    append_lines(text, mesh, uv);
    for (const SharpEdge& e : edges)
      fmt::format_to(std::back_inserter(text), "{} {} {}\n", e.a, e.b, finite(e.sharpness));
    return;
  }
  for (const auto& p : mesh.positions) {
    for (const double x : p) append_little_endian(text, std::bit_cast<std::uint64_t>(x));
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    const auto put_count = [&](std::size_t count) {
      if (small)
        text += static_cast<char>(count);
      else
        append_little_endian(text, static_cast<std::uint32_t>(count));
    };
    put_count(corners.size());
    for (const std::int32_t v : corners) append_little_endian(text, static_cast<std::uint32_t>(v));
    if (uv != nullptr) put_count(2 * corners.size());
    for (std::size_t k = 0; uv != nullptr && k < 2 * corners.size(); ++k)
      append_little_endian(text, std::bit_cast<std::uint64_t>(
                                     uv->at(mesh.faces.first_corner(f) + k / 2, static_cast<int>(k % 2))));
  }
  for (const SharpEdge& e : edges) {
    for (const std::int32_t v : {e.a, e.b}) append_little_endian(text, static_cast<std::uint32_t>(v));
    append_little_endian(text, std::bit_cast<std::uint32_t>(finite(e.sharpness)));
  }
}

}  // namespace

std::string left_out(const ControlMesh& mesh, FileFormat format) {
  std::string lost;
  const auto say = [&](const std::string& what) { lost += (lost.empty() ? "" : ", ") + what; };
  const Channel* const uv = texture_of(mesh, format);
  for (const Channel& c : mesh.channels)
    if (&c != uv)
      say("the channel " + c.name);
    else if (c.rule && format != FileFormat::kObj)
      say("the rule of the channel " + c.name);
  return lost;
}

std::string mesh_content(const ControlMesh& mesh, FileFormat format, const WriteOptions& options) {
  std::string text;
  switch (format) {
    case FileFormat::kObj:
      append_obj(text, mesh);
      break;
    case FileFormat::kOff:
      require_only("OFF", mesh, false);
      text = fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), mesh.faces.size());
      append_lines(text, mesh);
      break;
    case FileFormat::kPly:
      require_only("PLY", mesh, true);
      append_ply(text, mesh, options.ascii_ply);
      break;
    case FileFormat::kStl:
      throw InputError("FILE_UNSUPPORTED", "", 0, "STL is read, not written: it has no vertices");
    case FileFormat::kUsda:
      throw InputError("FILE_UNSUPPORTED", "", 0, "USD is read, not written: OBJ has a place for all of it");
  }
  return text;
}

void write_mesh(const std::filesystem::path& file, const ControlMesh& mesh, const WriteOptions& options) {
  const std::string content = mesh_content(mesh, io::format_of(file), options);
  AtomicFile out(file);
  out.stream() << content;
  out.commit();
}

}  // namespace limitcheck::data
