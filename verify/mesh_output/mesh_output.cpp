// SPDX-License-Identifier: MIT
#include "verify/mesh_output/mesh_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "data/error.h"
#include "data/io/atomic_file.h"
#include "data/io/whole_content.h"
#include "fast/plan/depth.h"

namespace limitcheck::verify {
namespace {

using Path = std::filesystem::path;
using Mesh = fast::IndexedMesh<float>;
using Vertex = fast::SurfaceVertex<float>;
using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "records are written as they lie in memory");
static_assert(sizeof(Vertex) == 24, "x y z nx ny nz, as the headers of the files say");

// Viridis at equal steps, depths 0 .. kDeepest.
constexpr std::array kDepthColours{0x440154U, 0x482475U, 0x414487U, 0x355F8DU, 0x2A788EU, 0x21918CU,
                                   0x22A884U, 0x44BF70U, 0x7AD151U, 0xBDDF26U, 0xFDE725U};
static_assert(kDepthColours.size() == fast::kDeepest + 1);

// The triangles of each class in their order; one list of all without classes.
std::vector<std::vector<std::uint32_t>> triangles_by_class(const Mesh& mesh, const Colouring& colouring) {
  std::vector<std::vector<std::uint32_t>> lists(std::max<std::size_t>(1, colouring.classes.size()));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    lists[colouring.classes.empty() ? 0 : colouring.of_triangle[t]].push_back(t);
  }
  return lists;
}

void write_ply(const Path& file, const Mesh& mesh, const Colouring& colouring) {
  const bool coloured = !colouring.classes.empty();
  data::AtomicFile output(file);
  std::ostream& out = output.stream();
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment limitcheck\nelement vertex {}\nproperty float "
      "x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face {}\n"
      "property list uchar int vertex_indices\n{}end_header\n",
      mesh.vertices.size(), mesh.triangles.size(),
      coloured ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
  out.write(reinterpret_cast<const char*>(mesh.vertices.data()),
            static_cast<std::streamsize>(mesh.vertices.size() * sizeof(Vertex)));

  std::array<char, 16> record{};
  record[0] = 3;
  const std::streamsize size = coloured ? 16 : 13;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::memcpy(record.data() + 1, mesh.triangles[t].data(), 12);
    if (coloured) std::memcpy(record.data() + 13, colouring.classes[colouring.of_triangle[t]].rgb.data(), 3);
    out.write(record.data(), size);
  }
  output.commit();
}

void write_materials(const Path& file, const Colouring& colouring) {
  data::AtomicFile output(file);
  for (const ColourClass& c : colouring.classes) {
    output.stream() << fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", c.name, c.rgb[0] / 255.,
                                   c.rgb[1] / 255., c.rgb[2] / 255.);
  }
  output.commit();
}

void write_obj(const Path& file, const Mesh& mesh, const Colouring& colouring) {
  const bool coloured = !colouring.classes.empty();
  data::AtomicFile output(file);
  fmt::memory_buffer text;
  const auto add = [&](auto format, const auto&... values) {
    fmt::format_to(std::back_inserter(text), format, values...);
    if (text.size() > (1 << 16)) {
      output.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
      text.clear();
    }
  };

  auto materials = file;
  materials.replace_extension(".mtl");
  if (coloured) add(FMT_STRING("mtllib {}\n"), materials.filename().string());
  for (const auto& v : mesh.vertices)
    add(FMT_STRING("v {} {} {}\n"), v.position.x, v.position.y, v.position.z);
  for (const auto& v : mesh.vertices) add(FMT_STRING("vn {} {} {}\n"), v.normal.x, v.normal.y, v.normal.z);
  const auto lists = triangles_by_class(mesh, colouring);
  for (std::size_t c = 0; c < lists.size(); ++c) {
    if (coloured && !lists[c].empty()) add(FMT_STRING("usemtl {}\n"), colouring.classes[c].name);
    for (const std::uint32_t t : lists[c]) {
      const std::uint64_t i = mesh.triangles[t][0] + std::uint64_t{1},
                          j = mesh.triangles[t][1] + std::uint64_t{1},
                          k = mesh.triangles[t][2] + std::uint64_t{1};
      add(FMT_STRING("f {}//{} {}//{} {}//{}\n"), i, i, j, j, k, k);
    }
  }
  output.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  output.commit();
  if (coloured) write_materials(materials, colouring);
}

// glTF colours are linear, the palette is sRGB.
double linear(std::uint8_t value) {
  const double c = value / 255.;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

Json material(const ColourClass& c) {
  return {{"name", c.name},
          {"doubleSided", true},  // surfaces with boundary are seen from both sides
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {linear(c.rgb[0]), linear(c.rgb[1]), linear(c.rgb[2]), 1.}},
            {"metallicFactor", 0.},
            {"roughnessFactor", .8}}}};
}

Json accessor(int view, std::size_t offset, int component, const char* type, std::size_t count) {
  Json json{{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}};
  if (offset > 0) json["byteOffset"] = offset;
  return json;
}

// What a GLB says of its binary chunk, in which the vertices lie, and behind them the triangles class by class.
void describe(const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& lists,
              const Colouring& colouring, Json& model) {
  constexpr int kFloat = 5126, kUnsigned = 5125, kTriangles = 4, kVertexBuffer = 34962, kIndexBuffer = 34963;
  const std::size_t vertices = mesh.vertices.size(), vertex_bytes = vertices * sizeof(Vertex),
                    index_bytes = mesh.triangles.size() * 12;
  Json& accessors = model["accessors"];
  accessors = {accessor(0, 0, kFloat, "VEC3", vertices), accessor(0, 12, kFloat, "VEC3", vertices)};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto coordinate = [c](const Vertex& v) { return v.position[c]; };
    accessors[0]["min"][c] = coordinate(*std::ranges::min_element(mesh.vertices, {}, coordinate));
    accessors[0]["max"][c] = coordinate(*std::ranges::max_element(mesh.vertices, {}, coordinate));
  }
  Json primitives;
  std::size_t offset = 0;
  for (std::size_t c = 0; c < lists.size(); ++c) {
    if (lists[c].empty()) continue;
    const bool coloured = !colouring.classes.empty();
    model["materials"].push_back(
        material(coloured ? colouring.classes[c] : ColourClass{"surface", {176, 190, 197}}));
    primitives.push_back({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}},
                          {"indices", accessors.size()},
                          {"material", primitives.size()},
                          {"mode", kTriangles}});
    accessors.push_back(accessor(1, offset, kUnsigned, "SCALAR", 3 * lists[c].size()));
    offset += 12 * lists[c].size();
  }
  model["bufferViews"] = {
      {{"buffer", 0},
       {"byteLength", vertex_bytes},
       {"byteStride", sizeof(Vertex)},
       {"target", kVertexBuffer}},
      {{"buffer", 0}, {"byteLength", index_bytes}, {"byteOffset", vertex_bytes}, {"target", kIndexBuffer}}};
  model["buffers"][0]["byteLength"] = vertex_bytes + index_bytes;
  model["meshes"][0]["primitives"] = std::move(primitives);
  model["nodes"][0]["mesh"] = 0;
  model["scenes"][0]["nodes"][0] = 0;
  model["scene"] = 0;
}

void write_glb(const Path& file, const Mesh& mesh, const Colouring& colouring) {
  const std::size_t bytes = mesh.vertices.size() * sizeof(Vertex) + mesh.triangles.size() * 12;
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - (std::size_t{1} << 20);
  if (bytes > kMost) {
    throw data::InputError("FILE_UNSUPPORTED", file.string(), 0,
                           "a GLB holds at most 4 GiB; write a PLY instead");
  }
  const auto lists = triangles_by_class(mesh, colouring);
  const bool empty = mesh.triangles.empty();
  Json model{{"asset", {{"version", "2.0"}, {"generator", "limitcheck"}}}};
  if (!empty) describe(mesh, lists, colouring, model);
  std::string text = model.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');

  data::AtomicFile output(file);
  const auto put = [&](const void* from, std::size_t size) {
    output.stream().write(static_cast<const char*>(from), static_cast<std::streamsize>(size));
  };
  const auto put_words = [&](auto... words) {
    for (const std::uint32_t word : {static_cast<std::uint32_t>(words)...}) put(&word, 4);
  };
  constexpr std::uint32_t kGlb = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  put_words(kGlb, kVersion, 12 + 8 + text.size() + (empty ? 0 : 8 + bytes), text.size(), kJson);
  put(text.data(), text.size());
  if (!empty) {
    put_words(bytes, kBinary);
    put(mesh.vertices.data(), mesh.vertices.size() * sizeof(Vertex));
    for (const auto& list : lists)
      for (const std::uint32_t t : list) put(mesh.triangles[t].data(), 12);
  }
  output.commit();
}

// The formats, by extension.
struct Format {
  const char* extension;
  void (*write)(const Path& file, const Mesh& mesh, const Colouring& colouring);
};
constexpr Format kFormats[]{{".ply", write_ply}, {".obj", write_obj}, {".glb", write_glb}};

const Format& format_of(const Path& file) {
  const std::string extension = data::io::lower_extension(file);
  for (const Format& format : kFormats)
    if (extension == format.extension) return format;
  throw data::InputError("FILE_UNKNOWN_FORMAT", file.string(), 0,
                         "a tessellation is written as .ply, .obj or .glb");
}

}  // namespace

Colouring colour_by_depth(const fast::IndexedMesh<float>& mesh, std::span<const std::int32_t> depth) {
  Colouring colouring;
  for (const unsigned rgb : kDepthColours) {
    const auto byte = [&](int shift) { return static_cast<std::uint8_t>(rgb >> shift & 255U); };
    colouring.classes.push_back(
        {fmt::format("depth_{}", colouring.classes.size()), {byte(16), byte(8), byte(0)}});
  }
  colouring.of_triangle.reserve(mesh.triangles.size());
  for (const std::int32_t face : mesh.triangle_face) {
    colouring.of_triangle.push_back(static_cast<std::uint8_t>(depth[face]));
  }
  return colouring;
}

Colouring colour_by_kind(const fast::IndexedMesh<float>& mesh) {
  Colouring colouring;
  colouring.classes = {{"pair", {176, 190, 197}},
                       {"singleton", {255, 160, 0}},
                       {"fan", {198, 40, 40}},
                       {"stitched", {46, 125, 50}}};
  colouring.of_triangle.reserve(mesh.triangles.size());
  for (const fast::Kind kind : mesh.triangle_kind)
    colouring.of_triangle.push_back(static_cast<std::uint8_t>(kind));
  return colouring;
}

void check_extension(const std::filesystem::path& file) {
  (void)format_of(file);
}

void write_tessellation(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
                        const Colouring& colouring) {
  format_of(file).write(file, mesh, colouring);
}

}  // namespace limitcheck::verify
