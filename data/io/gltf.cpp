// SPDX-License-Identifier: MIT
#include "data/io/gltf.h"

#include <fmt/core.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "data/error.h"
#include "data/io/gltf_matrix.h"
#include "data/io/text_scanner.h"
#include "data/io/whole_content.h"
#include "data/untrusted_json.h"

namespace limitcheck::data::io {
namespace {

constexpr int kDeepest = 256;              // nodes above a mesh
constexpr std::size_t kDeepestJson = 128;  // brackets: no glTF needs more than ten, and the parser recurses
constexpr std::size_t kMost = 1 << 28;     // vertices, and corners: a small file may repeat a mesh very often

// A GLB file is a header of 12 bytes, then the length and the kind of the first chunk, then that: the JSON.
std::string_view json_of(std::string_view content, bool binary) {
  if (!binary) return content;
  if (content.size() < 20) return {};
  std::uint32_t length = 0;
  std::memcpy(&length, content.data() + 12, sizeof length);
  return content.substr(20, length);
}

// The whole numbers of a glTF that are read here, and what they may be: "*" stands for every element.
struct IntegerField {
  std::string_view path;
  std::int64_t most = std::numeric_limits<int>::max(), least = 0;
};
constexpr std::int64_t kMostBytes = std::int64_t{1} << 53;
constexpr IntegerField kIntegers[] = {
    {"scene"},
    {"scenes/*/nodes/*"},
    {"nodes/*/mesh"},
    {"nodes/*/children/*"},
    {"meshes/*/primitives/*/attributes/*"},
    {"meshes/*/primitives/*/indices"},
    {"meshes/*/primitives/*/mode", TINYGLTF_MODE_TRIANGLE_FAN},
    {"accessors/*/bufferView"},
    {"accessors/*/byteOffset", kMostBytes},
    {"accessors/*/componentType", TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_COMPONENT_TYPE_BYTE},
    {"accessors/*/count", kMostBytes},
    {"bufferViews/*/buffer"},
    {"bufferViews/*/byteOffset", kMostBytes},
    {"bufferViews/*/byteLength", kMostBytes},
    {"bufferViews/*/byteStride", 252},
    {"buffers/*/byteLength", kMostBytes}};

// What is wrong with the numbers of a field, below `json` at `path`; tinygltf takes them modulo 2^32, or for none.
std::string wrong_integer(const nlohmann::json& json, std::string_view path, const IntegerField& field,
                          const std::string& where = {}) {
  if (path.empty()) {
    const bool whole = json.is_number_integer();
    if (json.is_number_unsigned() ? json.get<std::uint64_t>() <= static_cast<std::uint64_t>(field.most) &&
                                        json.get<std::uint64_t>() >= static_cast<std::uint64_t>(field.least)
                                  : whole && json.get<std::int64_t>() >= field.least)
      return "";
    return fmt::format("{} is {}, not a whole number from {} to {}", io::quoted(where),
                       io::quoted(json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)),
                       field.least, field.most);
  }
  const std::size_t slash = std::min(path.find('/'), path.size());
  const std::string_view key = path.substr(0, slash), rest = path.substr(std::min(slash + 1, path.size()));
  for (const auto& [name, value] : json.items()) {
    if (key != "*" && key != name) continue;
    std::string wrong = wrong_integer(value, rest, field, where.empty() ? name : where + "/" + name);
    if (!wrong.empty()) return wrong;
  }
  return "";
}

// Extensions that a viewer needs but that do not change the shape.
bool is_about_looks(const std::string& extension) {
  static constexpr std::array kLooks{"KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_"};
  return std::any_of(kLooks.begin(), kLooks.end(),
                     [&](const char* begin) { return extension.starts_with(begin); });
}

// Does not open the file, because opening a pipe would block.
bool is_beside(const std::string& file, void*) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

// Buffers beside the file: regular files only, of a size that is read.
bool read_beside(std::vector<unsigned char>* out, std::string* error, const std::string& file, void*) try {
  const std::string content = whole_content(file);
  out->assign(content.begin(), content.end());
  return true;
} catch (const InputError& refusal) {
  *error += refusal.what();
  return false;
}

class Reader {
 public:
  Reader(std::string_view content, bool binary, const std::string& folder, std::string name)
      : name_(std::move(name)) {
    tinygltf::TinyGLTF loader;
    // Pictures are of no interest, and must not fail.
    loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    loader.SetFsCallbacks({&is_beside, &tinygltf::ExpandFilePath, &read_beside, nullptr, nullptr});
    const std::string_view json = json_of(content, binary);
    if (const std::size_t depth = json_nesting(json); depth > kDeepestJson)
      refuse("FILE_UNSUPPORTED", fmt::format("its JSON nests {} deep; {} are read", depth, kDeepestJson));
    check_integers(json);
    if (content.size() > std::numeric_limits<unsigned>::max()) refuse("FILE_TOO_LARGE", "more than 4 GiB");
    const auto size = static_cast<unsigned>(content.size());
    std::string error, warning;
    const bool read =
        binary ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                             reinterpret_cast<const unsigned char*>(content.data()), size,
                                             folder)
               : loader.LoadASCIIFromString(&model_, &error, &warning, content.data(), size, folder);
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!read) refuse("FILE_SYNTAX", error.empty() ? "not glTF 2.0" : error);
    for (const std::string& extension : model_.extensionsRequired)
      if (!is_about_looks(extension))
        refuse("FILE_UNSUPPORTED", fmt::format("it requires the extension {}", io::quoted(extension)));
    visited_.resize(model_.nodes.size());
  }

  PolygonSoup run() {
    if (model_.scenes.empty()) {
      for (const tinygltf::Mesh& m : model_.meshes) add(m, kIdentity, -1);
    } else {
      const int scene = std::max(model_.defaultScene, 0);
      for (const int node : element(model_.scenes, scene, "scene").nodes) visit(node, kIdentity, 0);
    }
    for (PolygonSoup::SoupChannel& channel : soup_.channels) {
      const std::vector<std::int64_t> of_vertex = std::exchange(channel.corners, soup_.corners);
      for (std::int64_t& c : channel.corners)
        c = c >= 0 && static_cast<std::size_t>(c) < of_vertex.size() ? of_vertex[static_cast<std::size_t>(c)]
                                                                     : -1;
    }
    return std::move(soup_);
  }

 private:
  [[noreturn]] void refuse(const char* code, const std::string& why) const {
    throw InputError(code, name_, 0, why);
  }
  // What is no JSON is left to the reader of glTF.
  void check_integers(std::string_view text) const try {
    const nlohmann::json json = parse_untrusted(text, kDeepestJson);
    for (const IntegerField& field : kIntegers)
      if (const std::string wrong = wrong_integer(json, field.path, field); !wrong.empty())
        refuse("FILE_SYNTAX", wrong);
  } catch (const ArgumentError& error) {
    refuse("FILE_SYNTAX", error.what());
  }
  template <class T>
  const T& element(const std::vector<T>& list, int index, const char* what) const {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
      refuse("FILE_SYNTAX", fmt::format("it names {} {}, which is not there", what, index));
    return list[index];
  }

  Matrix local(const tinygltf::Node& node, int index) const {
    const auto numbers = [&](const std::vector<double>& list, std::size_t count, const char* what) {
      if (!list.empty() && list.size() != count)
        refuse("FILE_SYNTAX",
               fmt::format("the {} of node {} has {} numbers, not {}", what, index, list.size(), count));
    };
    numbers(node.matrix, 16, "matrix");
    numbers(node.rotation, 4, "rotation");
    numbers(node.scale, 3, "scale");
    numbers(node.translation, 3, "translation");
    Matrix m = kIdentity;
    if (node.matrix.size() == 16) {
      std::copy(node.matrix.begin(), node.matrix.end(), m.begin());
      return m;
    }
    if (node.rotation.size() == 4) {
      const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
      const std::array<double, 9> turn{
          1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
          2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
          2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
      for (std::size_t k = 0; k < 9; ++k) m[4 * (k / 3) + k % 3] = turn[k];
    }
    for (int column = 0; column < 3 && node.scale.size() == 3; ++column)
      for (int row = 0; row < 3; ++row) m[4 * column + row] *= node.scale[column];
    for (int row = 0; row < 3 && node.translation.size() == 3; ++row) m[12 + row] = node.translation[row];
    return m;
  }

  void visit(int index, const Matrix& above, int depth) {
    const tinygltf::Node& node = element(model_.nodes, index, "node");
    if (depth > kDeepest)
      refuse("FILE_UNSUPPORTED", fmt::format("more than {} nodes above each other", kDeepest));
    if (visited_[index])
      refuse("FILE_SYNTAX", fmt::format("node {} occurs twice: the nodes of a scene must be trees", index));
    visited_[index] = true;
    const Matrix m = above * local(node, index);
    if (node.mesh >= 0) add(element(model_.meshes, node.mesh, "mesh"), m, index);
    for (const int child : node.children) visit(child, m, depth + 1);
  }

  // The bytes of one element after another.
  struct Bytes {
    const unsigned char* first = nullptr;
    std::size_t stride = 0, count = 0;
    int component = 0;
    const unsigned char* operator[](std::size_t k) const { return first + k * stride; }
  };
  Bytes bytes(int index, int type) const {
    const tinygltf::Accessor& a = element(model_.accessors, index, "accessor");
    if (a.sparse.isSparse || a.bufferView < 0) refuse("FILE_UNSUPPORTED", "a sparse or compressed accessor");
    if (a.type != type)
      refuse("FILE_SYNTAX", fmt::format("accessor {} has another type than it must", index));
    const tinygltf::BufferView& view = element(model_.bufferViews, a.bufferView, "buffer view");
    const tinygltf::Buffer& buffer = element(model_.buffers, view.buffer, "buffer");
    const int stride = a.ByteStride(view), size = tinygltf::GetComponentSizeInBytes(a.componentType) *
                                                  tinygltf::GetNumComponentsInType(type);
    const std::size_t begin = view.byteOffset + a.byteOffset, end = view.byteOffset + view.byteLength;
    if (stride < size || size <= 0 || end > buffer.data.size() || begin > end ||
        (a.count > 0 &&
         (end - begin < static_cast<std::size_t>(size) ||
          (end - begin - static_cast<std::size_t>(size)) / static_cast<std::size_t>(stride) < a.count - 1)))
      refuse("FILE_SYNTAX", fmt::format("accessor {} reaches beyond its buffer", index));
    return {buffer.data.data() + begin, static_cast<std::size_t>(stride), a.count, a.componentType};
  }
  template <class Number>
  static Number number(const unsigned char* bytes) {
    Number value{};
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  static std::array<double, 3> vector(const Bytes& b, std::size_t k) {
    const auto v = number<std::array<float, 3>>(b[k]);
    return {v[0], v[1], v[2]};
  }
  std::int64_t index(const Bytes& b, std::size_t k) const {
    switch (b.component) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return *b[k];
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return number<std::uint16_t>(b[k]);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return number<std::uint32_t>(b[k]);
      default:
        refuse("FILE_SYNTAX", "indices that are no unsigned integers");
    }
  }

  void add(const tinygltf::Mesh& mesh, const Matrix& m, int node) {
    for (const tinygltf::Primitive& p : mesh.primitives) {
      const int mode = p.mode < 0 ? TINYGLTF_MODE_TRIANGLES : p.mode;
      if (mode < TINYGLTF_MODE_TRIANGLES) continue;  // points and lines
      const auto attribute = [&](const std::string& name) {
        const auto found = p.attributes.find(name);
        return found == p.attributes.end() ? -1 : found->second;
      };
      if (attribute("POSITION") < 0) continue;
      std::vector<int> texture;  // TEXCOORD_0, _1, ..
      while (attribute(fmt::format("TEXCOORD_{}", texture.size())) >= 0)
        texture.push_back(attribute(fmt::format("TEXCOORD_{}", texture.size())));
      const auto [first, vertex_count] =
          vertices(attribute("POSITION"), attribute("NORMAL"), texture, m, node);
      Bytes list;
      if (p.indices >= 0) list = bytes(p.indices, TINYGLTF_TYPE_SCALAR);
      if (soup_.positions.size() > kMost ||
          (vertex_count + static_cast<std::int64_t>(list.count)) > static_cast<std::int64_t>(kMost) ||
          soup_.corners.size() > kMost)
        refuse("MESH_TOO_LARGE", fmt::format("more than {} vertices or corners", kMost));
      const std::int64_t count = p.indices >= 0 ? static_cast<std::int64_t>(list.count) : vertex_count;
      const auto corner = [&, begin = first, end = vertex_count](std::int64_t k) {
        const std::int64_t v = p.indices >= 0 ? index(list, static_cast<std::size_t>(k)) : k;
        return v < end ? begin + v : -1;  // the reader of tessellations counts what is out of range
      };
      const bool plain = mode == TINYGLTF_MODE_TRIANGLES, mirrored = determinant(m) < 0;
      for (std::int64_t k = 0; k + 2 < count; k += plain ? 3 : 1) {
        const bool odd = (mode == TINYGLTF_MODE_TRIANGLE_STRIP && k % 2 == 1) != mirrored;
        const std::int64_t a = mode == TINYGLTF_MODE_TRIANGLE_FAN ? 0 : k;
        for (const std::int64_t c : {a, odd ? k + 2 : k + 1, odd ? k + 1 : k + 2})
          soup_.corners.push_back(corner(c));
        soup_.close_polygon();
      }
    }
  }

  // Where the vertices of these accessors begin, and how many there are; read once for each node.
  std::pair<std::int64_t, std::int64_t> vertices(int positions, int normals, const std::vector<int>& texture,
                                                 const Matrix& m, int node) {
    const auto begin = static_cast<std::int64_t>(soup_.positions.size());
    const auto [known, is_new] = seen_.try_emplace({positions, normals, texture, node}, begin, 0);
    if (!is_new) return known->second;
    const Bytes p = bytes(positions, TINYGLTF_TYPE_VEC3);
    Bytes n;
    if (normals >= 0) n = bytes(normals, TINYGLTF_TYPE_VEC3);
    if (p.component != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        (normals >= 0 && (n.component != TINYGLTF_COMPONENT_TYPE_FLOAT || n.count != p.count)))
      refuse("FILE_UNSUPPORTED", "positions or normals that are not floats, one for each vertex");
    without_normals_ = without_normals_ || normals < 0;
    for (std::size_t k = 0; k < p.count; ++k) {
      soup_.positions.push_back(m == kIdentity ? vector(p, k) : moved(m, vector(p, k)));
      if (normals >= 0) soup_.normals.push_back(m == kIdentity ? vector(n, k) : turned(m, vector(n, k)));
    }
    if (without_normals_) soup_.normals.clear();  // not of all: as if of none
    for (std::size_t k = 0; k < texture.size(); ++k)
      add_texture(k, texture[k], static_cast<std::size_t>(begin), p.count);
    known->second.second = static_cast<std::int64_t>(p.count);
    return known->second;
  }

  // Values of vertices from `begin` on; other vertices have none.
  void add_texture(std::size_t channel, int accessor, std::size_t begin, std::size_t count) try {
    const Bytes values = bytes(accessor, TINYGLTF_TYPE_VEC2);
    if (values.count != count)
      refuse("FILE_UNSUPPORTED", fmt::format("{} texture coordinates for {} vertices", values.count, count));
    const auto pair = [&](std::size_t k) -> std::array<double, 2> {
      const auto of = [](const auto& v, double one) { return std::array<double, 2>{v[0] / one, v[1] / one}; };
      if (values.component == TINYGLTF_COMPONENT_TYPE_FLOAT)
        return of(number<std::array<float, 2>>(values[k]), 1);
      if (values.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        return of(number<std::array<std::uint8_t, 2>>(values[k]), 255);
      if (values.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        return of(number<std::array<std::uint16_t, 2>>(values[k]), 65535);
      refuse("FILE_UNSUPPORTED", "texture coordinates that are no floats, bytes or shorts without a sign");
    };
    while (soup_.channels.size() <= channel)
      soup_.channels.push_back({.name = fmt::format("TEXCOORD_{}", soup_.channels.size()), .by_value = true});
    PolygonSoup::SoupChannel& to = soup_.channels[channel];  // its corners are vertices until the end
    to.corners.resize(begin, -1);
    for (std::size_t k = 0; k < count; ++k) {
      const auto value = pair(k);
      to.corners.push_back(static_cast<std::int64_t>(to.values.size() / 2));
      to.values.insert(to.values.end(), value.begin(), value.end());
    }
  } catch (const InputError& refusal) {
    soup_.notes.push_back(fmt::format("TEXCOORD_{} is left out: {}", channel, refusal.what()));
  }

  std::string name_;
  tinygltf::Model model_;
  PolygonSoup soup_;
  std::vector<bool> visited_;  // nodes
  std::map<std::tuple<int, int, std::vector<int>, int>, std::pair<std::int64_t, std::int64_t>> seen_;
  bool without_normals_ = false;
};

}  // namespace

bool is_gltf(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".gltf" || extension == ".glb";
}

PolygonSoup read_gltf(std::string_view content, bool binary, const std::string& folder,
                      const std::string& name) {
  return Reader(content, binary, folder, name).run();
}

PolygonSoup read_gltf(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw InputError("FILE_CANNOT_OPEN", file.string(), 0, "there is no such file");
  return read_gltf(whole_content(file), lower_extension(file) == ".glb", file.parent_path().string(),
                   file.string());
}

PolygonSoup read_control_soup(const std::filesystem::path& file) {
  if (!is_gltf(file)) return read_soup(file);
  PolygonSoup soup = read_gltf(file);
  for (std::array<double, 3>& p : soup.positions)
    for (double& x : p) x += 0.0;  // -0 is 0
  const std::size_t before = soup.positions.size();
  join_equal_positions(soup);
  soup.normals.clear();
  if (before > soup.positions.size())
    soup.notes.push_back(fmt::format("{} vertices at {} different positions: those at equal ones are one",
                                     before, soup.positions.size()));
  return soup;
}

}  // namespace limitcheck::data::io
