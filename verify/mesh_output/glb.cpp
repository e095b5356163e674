// SPDX-License-Identifier: MIT
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "data/error.h"
#include "verify/mesh_output/atomic_file.h"
#include "verify/mesh_output/formats.h"

namespace limitcheck::verify {

namespace {

using Vertex = fast::SurfaceVertex<float>;

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

}  // namespace

void write_glb(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
               const Colouring& colouring) {
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

  AtomicFile output(file);
  tinygltf::TinyGLTF writer;
  writer.WriteGltfSceneToStream(&model, output.stream(), false, true);
  output.commit();
}

}  // namespace limitcheck::verify
