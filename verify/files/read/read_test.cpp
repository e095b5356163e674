// SPDX-License-Identifier: MIT
// glTF as exporters write it: nodes that move, shared and separate vertices, short indices, strips, mirrored
// nodes; and files that are broken.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sys/stat.h>
#include <tiny_gltf.h>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "verify/files/read/provenance.h"
#include "verify/files/read/tessellation_file.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

// A square in the plane z = 0, normals up; as one strip or as two triangles, below a node.
class Gltf : public testing::Test {
 protected:
  void SetUp() override {
    model_.asset.version = "2.0";
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0},
                normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    const std::uint16_t list[] = {0, 1, 2, 1, 3, 2}, strip[] = {0, 1, 2, 3};
    buffer_.data.resize(48 + 48 + 12 + 8);
    std::memcpy(&buffer_.data[0], positions, 48);
    std::memcpy(&buffer_.data[48], normals, 48);
    std::memcpy(&buffer_.data[96], list, 12);
    std::memcpy(&buffer_.data[108], strip, 8);
    for (const auto& [offset, length] : {std::pair{0, 48}, {48, 48}, {96, 12}, {108, 8}}) {
      tinygltf::BufferView view;
      view.buffer = 0;
      view.byteOffset = static_cast<std::size_t>(offset);
      view.byteLength = static_cast<std::size_t>(length);
      model_.bufferViews.push_back(view);
    }
    const auto accessor = [&](int view, int component, int type, std::size_t count) {
      tinygltf::Accessor a;
      a.bufferView = view;
      a.componentType = component;
      a.type = type;
      a.count = count;
      model_.accessors.push_back(a);
    };
    accessor(0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 4);
    accessor(1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 4);
    accessor(2, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, 6);
    accessor(3, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, 4);
    tinygltf::Primitive p;
    p.attributes = {{"POSITION", 0}, {"NORMAL", 1}};
    p.indices = 2;
    p.mode = TINYGLTF_MODE_TRIANGLES;
    tinygltf::Mesh mesh;
    mesh.primitives = {p};
    model_.meshes = {mesh};
    tinygltf::Node node;
    node.mesh = 0;
    model_.nodes = {node};
    tinygltf::Scene scene;
    scene.nodes = {0};
    model_.scenes = {scene};
    model_.defaultScene = 0;
  }

  FileTessellation read(const std::string& name = "t.glb") {
    model_.buffers = {buffer_};
    const fs::path file = folder_ / name;
    EXPECT_TRUE(tinygltf::TinyGLTF().WriteGltfSceneToFile(&model_, file.string(), false, false, false,
                                                          name.ends_with(".glb")));
    return read_tessellation(file);
  }
  std::string code() {
    const auto error = thrown<data::InputError>([&] { read(); });
    return error ? error->code() : "none";
  }

  TestFolder folder_;
  tinygltf::Model model_;
  tinygltf::Buffer buffer_;
};

using Triangles = std::vector<std::array<std::int32_t, 3>>;

TEST_F(Gltf, ListsAndStripsAndPrimitivesThatShareVerticesAreTheSameSquare) {
  for (const std::string name : {"t.glb", "t.gltf"}) {
    const FileTessellation list = read(name);
    EXPECT_EQ(list.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
    EXPECT_EQ(list.positions[3], (Vector{1, 1, 0}));
    ASSERT_EQ(list.normals.size(), 4U);
    EXPECT_EQ(list.normals[2].direction, (Vector{0, 0, 1}));
  }
  model_.meshes[0].primitives[0].mode = TINYGLTF_MODE_TRIANGLE_STRIP;
  model_.meshes[0].primitives[0].indices = 3;
  EXPECT_EQ(read().triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
  model_.meshes[0].primitives.push_back(model_.meshes[0].primitives[0]);
  EXPECT_EQ(read().positions.size(), 4U);
}

TEST_F(Gltf, NodesPutTheirMeshesWhereTheySay) {
  tinygltf::Node above;
  above.children = {0};
  above.translation = {10, 0, 0};
  above.rotation = {0, 0, std::sqrt(.5), std::sqrt(.5)};  // a quarter turn about z
  above.scale = {2, 2, 2};
  model_.nodes.push_back(above);
  model_.nodes[0].translation = {0, 0, 1};
  model_.scenes[0].nodes = {1};
  const FileTessellation t = read();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(t.positions[1][axis], (Vector{10, 2, 2})[axis], 1e-12);
    EXPECT_NEAR(t.positions[2][axis], (Vector{8, 0, 2})[axis], 1e-12);
  }
  model_.nodes[1].scale = {-1, 1, 1};  // mirrored: the corners turn, so that the outside stays outside
  const FileTessellation mirrored = read();
  EXPECT_EQ(mirrored.triangles[0], (std::array<std::int32_t, 3>{0, 2, 1}));
  EXPECT_GT(mirrored.normals[0].direction[2], 0);
}

TEST_F(Gltf, WithoutNormalsInOnePrimitiveThereAreNone) {
  model_.meshes[0].primitives.push_back(model_.meshes[0].primitives[0]);
  model_.meshes[0].primitives[1].attributes.erase("NORMAL");
  const FileTessellation t = read();
  EXPECT_TRUE(t.normals.empty());
  EXPECT_EQ(t.positions.size(), 8U);
  EXPECT_EQ(t.triangles.size(), 4U);
}

TEST_F(Gltf, BrokenFilesAreRefused) {
  const tinygltf::Model good = model_;
  const auto with = [&](auto&& fault) {
    model_ = good;
    fault(model_);
    return code();
  };
  EXPECT_EQ(with([](auto& m) { m.accessors[0].count = 5; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.accessors[0].count = SIZE_MAX / 2; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.bufferViews[1].byteLength = 1000; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.meshes[0].primitives[0].attributes["POSITION"] = 17; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.accessors[0].componentType = TINYGLTF_COMPONENT_TYPE_SHORT; }),
            "FILE_UNSUPPORTED");
  EXPECT_EQ(with([](auto& m) { m.nodes[0].children = {0}; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.scenes[0].nodes = {0, 0}; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.nodes[0].matrix = std::vector<double>(15, 1); }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.nodes[0].rotation = {1, 0, 0}; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.nodes[0].scale = {1}; }), "FILE_SYNTAX");
  EXPECT_EQ(with([](auto& m) { m.scenes[0].nodes = {9}; }), "FILE_SYNTAX");
  std::ofstream(folder_ / "torn.glb") << "glTF";
  EXPECT_THROW(read_tessellation(folder_ / "torn.glb"), data::InputError);
  EXPECT_THROW(read_tessellation(folder_ / "absent.gltf"), data::InputError);
}

// As text, because no writer writes them: each number once as something that it must not be. Some were taken for
// none, or modulo 2^32.
TEST_F(Gltf, WholeNumbersThatAreNegativeOrBrokenOrTooLargeAreRefused) {
  (void)read("t.gltf");
  const std::string good = contents_of(folder_ / "t.gltf");
  const auto said = [&](const std::string& field, const std::string& number, const std::string& instead) {
    const std::string old = "\"" + field + "\":" + number;
    const std::size_t at = good.find(old);
    if (at == std::string::npos) return "no " + old + " in " + good;
    std::ofstream(folder_ / "wrong.gltf") << std::string(good).replace(at, old.size(), instead);
    return refusal_of<data::InputError>([&] { (void)read_tessellation(folder_ / "wrong.gltf"); });
  };
  struct Field {
    std::string name, number, most;
  };
  for (const Field& f : std::vector<Field>{{"mode", "4", "7"},
                                           {"mesh", "0", "2147483648"},
                                           {"indices", "2", "4294967298"},
                                           {"POSITION", "0", "4294967296"},
                                           {"bufferView", "0", "4294967296"},
                                           {"componentType", "5126", "4294972422"},
                                           {"count", "4", "9007199254740993"},
                                           {"buffer", "0", "4294967296"},
                                           {"byteLength", "48", "18446744073709551664"},
                                           {"scene", "0", "4294967296"}}) {
    const std::string name = "\"" + f.name + "\":";
    EXPECT_EQ(said(f.name, f.number, name + f.number), "accepted");
    for (const std::string& wrong : {f.most, "-" + f.most, std::string("-1"), f.number + ".5",
                                     "\"" + f.number + "\"", std::string("null"), "[" + f.number + "]"})
      EXPECT_TRUE(says(said(f.name, f.number, name + wrong), "not a whole number from"))
          << f.name << " " << wrong;
  }
  for (const std::string wrong : {"-12", "256", "12.5", "4294967308"})
    EXPECT_TRUE(
        says(said("byteLength", "48", "\"byteLength\":48,\"byteStride\":" + wrong), "byteStride\" is"))
        << wrong;
  EXPECT_EQ(said("byteLength", "48", "\"byteLength\":48,\"byteStride\":12"), "accepted");
  EXPECT_TRUE(says(said("mode", "4", "\"mode\":4,\"mode\":1"), "stands twice"));
}

// Sixty nodes that each hold the next one twice are 2^60 paths to the last.
TEST_F(Gltf, NodesThatAreNoTreeAreRefusedAtOnce) {
  model_.scenes[0].nodes = {1};
  for (int k = 1; k <= 60; ++k) {
    tinygltf::Node node;
    node.children = {k < 60 ? k + 1 : 0, k < 60 ? k + 1 : 0};
    model_.nodes.push_back(node);
  }
  EXPECT_EQ(code(), "FILE_SYNTAX");
}

// The parser recurses into what it does not know.
TEST_F(Gltf, JsonThatNestsTooDeepIsRefused) {
  for (const int depth : {100, 20000, 2000000}) {
    const std::string deep =
        std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
    const fs::path file = folder_ / "deep.gltf";
    std::ofstream(file) << R"({"asset": {"version": "2.0", "extras": )" << deep << "}}";
    const std::string said = refusal_of<data::InputError>([&] { (void)read_tessellation(file); });
    EXPECT_NE(said, "accepted");
    EXPECT_EQ(bool(says(said, "FILE_UNSUPPORTED: its JSON nests")), depth > 100) << said;
  }
  // Brackets in texts do not nest.
  const fs::path file = folder_ / "texts.gltf";
  std::ofstream(file) << R"({"asset": {"version": "2.0", "generator": ")" << std::string(1000, '[')
                      << R"(\"{[", "copyright": "\\"}})";
  const std::string said = refusal_of<data::InputError>([&] { (void)read_tessellation(file); });
  EXPECT_NE(said, "accepted");
  EXPECT_FALSE(says(said, "nests"));
}

TEST_F(Gltf, WhatItRequiresAndIsNotReadIsRefused) {
  model_.extensionsRequired = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(code(), "FILE_UNSUPPORTED");
  model_.extensionsRequired = {"KHR_materials_unlit", "KHR_texture_transform"};
  EXPECT_EQ(code(), "none") << "looks are of no interest";
}

TEST_F(Gltf, BuffersArePlainFiles) {
  const std::string head = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 8, "uri": ")";
  ASSERT_EQ(mkfifo((folder_ / "pipe.bin").c_str(), 0600), 0);
  for (const std::string uri : {"pipe.bin", "/dev/zero", ".", "absent.bin"}) {
    std::ofstream(folder_ / "t.gltf") << head << uri << "\"}]}";
    EXPECT_THROW((void)read_tessellation(folder_ / "t.gltf"), data::InputError) << uri;
  }
}

using Coordinates = std::array<double, 3>;

// For a tessellation of four vertices, and a control mesh of eight triangles.
auto parse(const std::string& text, const std::string& name) {
  return parse_provenance(text, name, 4, data::octahedron(), data::Scheme::kLoop);
}

TEST(Provenance, ReadsParametersAndLatticePointsWithAndWithoutAHeading) {
  const auto real = parse("0,7,0.25,1/2\n3, 2, 0, 1\n", "t");
  ASSERT_EQ(real.size(), 2U);
  EXPECT_EQ(real[0].at.face, 7);
  EXPECT_EQ(real[0].at.l, (Coordinates{.25, .25, .5}));
  EXPECT_EQ(real[1].vertex, 3);
  EXPECT_EQ(real[1].at.l, (Coordinates{0, 0, 1}));
  const auto lattice = parse("# made by hand\nface,i,j,denominator,vertex\n7,1,2,4,0\n\n", "t");
  ASSERT_EQ(lattice.size(), 1U);
  EXPECT_EQ(lattice[0].at.l, (Coordinates{.25, .25, .5}));
}

TEST(Provenance, OfCatmullClarksSchemeNamesTheCornerOfAFaceThatIsNoQuad) {
  const data::ControlMesh prism = data::polygon_prism(5);  // two pentagons and five quads, in some order
  std::int64_t pentagon = 0, quad = 0;
  for (std::size_t f = 0; f < prism.faces.size(); ++f)
    (prism.faces[f].size() == 5 ? pentagon : quad) = static_cast<std::int64_t>(f);
  const auto read = [&](const std::string& text) {
    return parse_provenance(text, "map.csv", 4, prism, data::Scheme::kCatmullClark);
  };
  const auto rows = read(fmt::format("vertex,face,corner,u,v\n0,{},3,1/4,1\n1,{},,1,1\n", pentagon, quad));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at.face, pentagon);
  EXPECT_EQ(rows[0].corner, 3);
  EXPECT_EQ(rows[0].at.l[1], .25);
  EXPECT_EQ(rows[0].at.l[2], 1);
  EXPECT_EQ(rows[1].corner, -1);
  for (const std::string wrong : {"vertex,face,corner,u,v\n0,{},5,0,0\n", "vertex,face,u,v\n0,{},0,0\n",
                                  "vertex,face,corner,u,v\n0,{},0,0,1.5\n"})
    EXPECT_THROW(read(fmt::format(fmt::runtime(wrong), pentagon)), data::InputError) << wrong;
  EXPECT_THROW(read(fmt::format("vertex,face,corner,u,v\n0,{},1,0,0\n", quad)), data::InputError);
}

std::string error_of(const std::string& text) {
  const std::string said = refusal_of<data::InputError>([&] { parse(text, "map.csv"); });
  return said.substr(0, said.find(": ", 12));
}

TEST(Provenance, RefusesWhatItCannotMeanWithTheLine) {
  EXPECT_EQ(error_of("vertex,face\n0,1\n"), "map.csv:1: FILE_SYNTAX");
  EXPECT_EQ(error_of("0,1,0,0\n1,1,0\n"), "map.csv:2: FILE_SYNTAX");
  EXPECT_EQ(error_of("0,1,x,0\n"), "map.csv:1: FILE_SYNTAX");
  EXPECT_EQ(error_of("4,1,0,0\n"), "map.csv:1: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,8,0,0\n"), "map.csv:1: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,1,0.6,0.6\n"), "map.csv:1: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,1,0,0\n0,1,0,0\n"), "map.csv:2: FILE_PROVENANCE");
  EXPECT_EQ(error_of("0,1,1,1,0\n"), "map.csv:1: FILE_SYNTAX");  // denominator 0
  EXPECT_EQ(error_of(""), "map.csv: FILE_TRUNCATED");
}

}  // namespace
}  // namespace limitcheck::verify
