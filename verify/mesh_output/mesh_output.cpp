// SPDX-License-Identifier: MIT
#include "verify/mesh_output/mesh_output.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "data/error.h"
#include "data/io/atomic_file.h"
#include "fast/plan/depth.h"

namespace limitcheck::verify {
namespace {

using Path = std::filesystem::path;
using Mesh = fast::IndexedMesh<float>;
using Vertex = fast::SurfaceVertex<float>;

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
            static_cast<std::streamsize>(mesh.vertices.size() * sizeof(fast::SurfaceVertex<float>)));

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

int add_view(tinygltf::Model& model, std::size_t offset, std::size_t length, std::size_t stride, int target) {
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = offset;
  view.byteLength = length;
  view.byteStride = stride;
  view.target = target;
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int add_accessor(tinygltf::Model& model, int view, std::size_t offset, int component, int type,
                 std::size_t count) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.byteOffset = offset;
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = count;
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

// glTF colours are linear, the palette is sRGB.
double linear(std::uint8_t value) {
  const double c = value / 255.;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

int add_material(tinygltf::Model& model, const ColourClass& c) {
  tinygltf::Material material;
  material.name = c.name;
  material.pbrMetallicRoughness.baseColorFactor = {linear(c.rgb[0]), linear(c.rgb[1]), linear(c.rgb[2]), 1};
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 0.8;
  material.doubleSided = true;  // surfaces with boundary are seen from both sides
  model.materials.push_back(material);
  return static_cast<int>(model.materials.size()) - 1;
}

void write_glb(const Path& file, const Mesh& mesh, const Colouring& colouring) {
  const std::size_t vertex_bytes = mesh.vertices.size() * sizeof(Vertex),
                    index_bytes = mesh.triangles.size() * 12;
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - (std::size_t{1} << 20);
  if (vertex_bytes + index_bytes > kMost) {
    throw data::InputError("FILE_UNSUPPORTED", file.string(), 0,
                           "a GLB holds at most 4 GiB; write a PLY instead");
  }

  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "limitcheck";
  if (!mesh.triangles.empty()) {
    tinygltf::Buffer buffer;
    buffer.data.resize(vertex_bytes + index_bytes);
    std::memcpy(buffer.data.data(), mesh.vertices.data(), vertex_bytes);
    const int vertices = add_view(model, 0, vertex_bytes, sizeof(Vertex), TINYGLTF_TARGET_ARRAY_BUFFER);
    const int indices = add_view(model, vertex_bytes, index_bytes, 0, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    const int positions = add_accessor(model, vertices, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                       mesh.vertices.size());
    const int normals = add_accessor(model, vertices, 12, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                     mesh.vertices.size());
    fast::Vec3<float> low = mesh.vertices[0].position, high = low;
    for (const Vertex& v : mesh.vertices) {
      low = {std::min(low.x, v.position.x), std::min(low.y, v.position.y), std::min(low.z, v.position.z)};
      high = {std::max(high.x, v.position.x), std::max(high.y, v.position.y), std::max(high.z, v.position.z)};
    }
    model.accessors[positions].minValues = {low.x, low.y, low.z};
    model.accessors[positions].maxValues = {high.x, high.y, high.z};

    tinygltf::Mesh glmesh;
    std::size_t offset = 0;
    const auto lists = triangles_by_class(mesh, colouring);
    for (std::size_t c = 0; c < lists.size(); ++c) {
      if (lists[c].empty()) continue;
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.attributes = {{"POSITION", positions}, {"NORMAL", normals}};
      primitive.indices = add_accessor(model, indices, offset, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                       TINYGLTF_TYPE_SCALAR, 3 * lists[c].size());
      primitive.material = add_material(
          model, colouring.classes.empty() ? ColourClass{"surface", {176, 190, 197}} : colouring.classes[c]);
      for (const std::uint32_t t : lists[c]) {
        std::memcpy(buffer.data.data() + vertex_bytes + offset, mesh.triangles[t].data(), 12);
        offset += 12;
      }
      glmesh.primitives.push_back(primitive);
    }
    model.buffers.push_back(std::move(buffer));
    model.meshes.push_back(glmesh);
    tinygltf::Node node;
    node.mesh = 0;
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.nodes = {0};
    model.scenes = {scene};
    model.defaultScene = 0;
  }

  data::AtomicFile output(file);
  tinygltf::TinyGLTF writer;
  writer.WriteGltfSceneToStream(&model, output.stream(), false, true);
  output.commit();
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

OutputFormat output_format(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".ply") return OutputFormat::kPly;
  if (extension == ".obj") return OutputFormat::kObj;
  if (extension == ".glb") return OutputFormat::kGlb;
  throw data::InputError("FILE_UNKNOWN_FORMAT", file.string(), 0,
                         "a tessellation is written as .ply, .obj or .glb");
}

void write_tessellation(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
                        const Colouring& colouring) {
  switch (output_format(file)) {
    case OutputFormat::kPly:
      return write_ply(file, mesh, colouring);
    case OutputFormat::kObj:
      return write_obj(file, mesh, colouring);
    case OutputFormat::kGlb:
      return write_glb(file, mesh, colouring);
  }
}

}  // namespace limitcheck::verify
