// SPDX-License-Identifier: MIT
// Channels: what makes one, and how OBJ has them.
#include "data/channel.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "data/control_mesh.h"
#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/test_support/assertions.h"

namespace limitcheck::data {
namespace {

// Two quads side by side; each has texture coordinates of its own along the edge between them.
const std::string kPositions = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n";
const std::string kTexture = "vt 0 0\nvt .5 0\nvt .5 1\nvt 0 1\nvt .6 0\nvt 1 0\nvt 1 1\nvt .6 1\n";
const std::string kFaces = "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n";

io::Examination read(const std::string& text, const ReadOptions& options = {}) {
  return io::examine(io::read_obj(text, "two.obj"), options);
}

TEST(Channels, OfObjAreItsTextureCoordinates) {
  const ControlMesh mesh = read(kPositions + kTexture + kFaces).mesh;
  ASSERT_EQ(mesh.channels.size(), 1U);
  const Channel& uv = channel_of(mesh, "uv");
  EXPECT_EQ(uv.components, 2);
  EXPECT_EQ(uv.corners, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(uv.at(4, 0), .6);
  EXPECT_EQ(uv.at(7, 1), 1);
  EXPECT_FALSE(uv.rule.has_value());
  EXPECT_EQ(read(kPositions + kTexture + "f 1/-8 2/-7 5/-6 4/-5\nf 2/-4 3/-3 6/-2 5/-1\n").mesh, mesh);
  EXPECT_TRUE(says(refusal_of<ArgumentError>([&] { channel_of(mesh, "colour"); }), "it has uv"));
}

TEST(Channels, OfObjHaveAsManyComponentsAsTheLongestLine) {
  const auto components = [](const std::string& first, const std::string& second) {
    const auto found =
        read("vt" + first + "\nvt" + second + "\n" + kPositions + "f 1/1 2/2 5/1 4/2\nf 2/2 3/1 6/2 5/1\n");
    return found.mesh.channels.empty() ? std::vector<double>{} : channel_of(found.mesh, "uv").values;
  };
  EXPECT_EQ(components(" 5", " 1"), (std::vector<double>{5, 1}));
  EXPECT_EQ(components(" 5", " 1 2"), (std::vector<double>{5, 0, 1, 2}));
  EXPECT_EQ(components(" 5 6 7", " 1"), (std::vector<double>{5, 6, 7, 1, 0, 0}));
  for (const char* none : {"", " 1 2 3 4"}) EXPECT_EQ(components(" 5 6", none), std::vector<double>{});
}

TEST(Channels, OfObjHaveTheRuleOfTheTag) {
  const auto rule = [](const std::string& tags) {
    return channel_of(read(kPositions + kTexture + kFaces + tags).mesh, "uv").rule;
  };
  for (int k = 0; k < 6; ++k)
    EXPECT_EQ(rule("t facevaryinginterpolateboundary 1/0/0 " + std::to_string(k) + "\n"),
              static_cast<ChannelRule>(k));
  EXPECT_EQ(rule("t facevaryingpropagatecorners 1/0/0 1\n"), ChannelRule::kCornersPlus2);
  EXPECT_EQ(rule("t facevaryingpropagatecorners 1/0/0 0\n"), std::nullopt);
  EXPECT_EQ(rule("t facevaryinginterpolateboundary 1/0/0 1\nt facevaryingpropagatecorners 1/0/0 1\n"),
            ChannelRule::kCornersOnly);
}

TEST(Channels, AreWrittenAndReadAgain) {
  ControlMesh mesh = read(kPositions + kTexture + kFaces + "t facevaryinginterpolateboundary 1/0/0 4\n").mesh;
  EXPECT_EQ(read_mesh(mesh_content(mesh, FileFormat::kObj), FileFormat::kObj, "again.obj"), mesh);
  EXPECT_EQ(left_out(mesh, FileFormat::kObj), "");
  ControlMesh bare = mesh;
  bare.channels.clear();
  EXPECT_EQ(read_mesh(mesh_content(mesh, FileFormat::kOff), FileFormat::kOff, "again"), bare);
  EXPECT_EQ(left_out(mesh, FileFormat::kOff), "the channel uv");
  // PLY has the values of corners, and no rule.
  EXPECT_EQ(left_out(mesh, FileFormat::kPly), "the rule of the channel uv");
  for (const bool ascii : {true, false}) {
    const ControlMesh again =
        read_mesh(mesh_content(mesh, FileFormat::kPly, {.ascii_ply = ascii}), FileFormat::kPly, "again");
    const Channel& uv = channel_of(again, "uv");
    EXPECT_EQ(uv.rule, std::nullopt);
    ASSERT_EQ(uv.corners.size(), mesh.channels[0].corners.size());
    for (std::size_t c = 0; c < uv.corners.size(); ++c)
      for (const int k : {0, 1}) EXPECT_EQ(uv.at(c, k), mesh.channels[0].at(c, k));
  }
  mesh.channels.push_back({"colour", 4, {0, 0, 0, 1}, std::vector<std::int32_t>(8, 0)});
  EXPECT_EQ(left_out(mesh, FileFormat::kObj), "the channel colour");
}

TEST(Channels, FollowTheCornersOfPolygonsThatAreCut) {
  const ControlMesh mesh = read(kPositions + kTexture + kFaces, {.polygons = Triangulation::kFan}).mesh;
  EXPECT_EQ(channel_of(mesh, "uv").corners, (std::vector<std::int32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}));
}

// What makes texture coordinates unusable does not make the mesh so.
TEST(Channels, ThatAreUnusableAreLeftOutWithANote) {
  const auto note = [](const std::string& texture, const std::string& faces) {
    const auto found = read(kPositions + texture + faces);
    EXPECT_TRUE(found.faults.empty());
    EXPECT_TRUE(found.mesh.channels.empty());
    return found.notes.size() == 1 ? found.notes[0] : std::to_string(found.notes.size()) + " notes";
  };
  EXPECT_EQ(note(kTexture, "f 1/1 2/2 5/3 4/4\nf 2 3/6 6/7 5/8\n"),
            "the channel uv is left out: face 2 has a corner without a value");
  EXPECT_EQ(note(kTexture, "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/9 5/8\n"),
            "the channel uv is left out: face 2 names value 9, there are 8");
  EXPECT_EQ(note(kTexture, "f 1/1 2/2 5/3 4/4\nf 2/99999999999 3/6 6/7 5/8\n"),
            "the channel uv is left out: face 2 has an index of no value");
  EXPECT_EQ(note(kTexture, "f 1/1 2/2 5/3 4/4\nf 2/0 3/6 6/7 5/8\n"),
            "the channel uv is left out: face 2 has an index of no value");
  EXPECT_EQ(note(kTexture + "vt x 1\n", kFaces), "the channel uv is left out: value 9 is not finite");
  EXPECT_EQ(note("", "f 1 2 5 4\nf 2 3 6 5\n"), "0 notes");
}

// Ply has values of vertices, or of corners, which are the same where their numbers are.
TEST(Channels, OfPlyAreThoseOfVerticesOrOfCorners) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n";
  const auto read_ply = [](const std::string& text) { return read_mesh(text, FileFormat::kPly, "two.ply"); };
  const ControlMesh by_vertex =
      read_ply(header +
               "property float s\nproperty float t\nelement face 2\nproperty list uchar int "
               "vertex_indices\nend_header\n"
               "0 0 0 0 0\n1 0 0 .5 0\n2 0 0 1 0\n0 1 0 0 1\n1 1 0 .5 1\n2 1 0 1 1\n4 0 1 4 3\n4 1 2 5 4\n");
  EXPECT_EQ(channel_of(by_vertex, "uv").corners, (std::vector<std::int32_t>{0, 1, 4, 3, 1, 2, 5, 4}));
  EXPECT_EQ(channel_of(by_vertex, "uv").at(2, 0), .5);
  const ControlMesh by_corner = read_ply(header +
                                         "element face 2\nproperty list uchar int vertex_indices\nproperty "
                                         "list uchar float texcoord\nend_header\n"
                                         "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n"
                                         "4 0 1 4 3 8 0 0 .5 0 .5 1 0 1\n4 1 2 5 4 8 .5 0 1 0 1 1 .75 1\n");
  EXPECT_EQ(channel_of(by_corner, "uv").corners, (std::vector<std::int32_t>{0, 1, 2, 3, 1, 5, 6, 7}));
}

TEST(Channels, OfUsdaArePrimvars) {
  const std::string mesh =
      "#usda 1.0\ndef Mesh \"m\" {\n  point3f[] points = [(0,0,0), (1,0,0), (1,1,0), (0,1,0), (2,0,0), "
      "(2,1,0)]\n"
      "  int[] faceVertexCounts = [4, 4]\n  int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]\n";
  const auto read_usda = [&](const std::string& more) {
    return read_mesh(mesh + more + "}\n", FileFormat::kUsda, "m.usda");
  };
  const ControlMesh indexed = read_usda(
      "texCoord2f[] primvars:st = [(0,0), (.5,0), (.5,1), (0,1), (.6,0)] (interpolation = \"faceVarying\")\n"
      "int[] primvars:st:indices = [0, 1, 2, 3, 4, 0, 0, 2]\nuniform token faceVaryingLinearInterpolation = "
      "\"cornersPlus2\"\n"
      "color3f[] primvars:displayColor = [(1, 0, 0)]\nfloat[] primvars:wet = [1, 2, 3, 4, 5, 6]\n");
  ASSERT_EQ(indexed.channels.size(), 2U);
  EXPECT_EQ(channel_of(indexed, "st").corners, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 0, 0, 2}));
  EXPECT_EQ(channel_of(indexed, "st").rule, ChannelRule::kCornersPlus2);
  EXPECT_EQ(channel_of(indexed, "wet").components, 1);
  EXPECT_EQ(channel_of(indexed, "wet").rule, ChannelRule::kNone);
  EXPECT_EQ(channel_of(indexed, "wet").corners, (std::vector<std::int32_t>{0, 1, 2, 3, 1, 4, 5, 2}));
  const ControlMesh plain =
      read_usda("float2[] primvars:st = [(0,0), (.5,0), (.5,1), (0,1), (.5,0), (1,0), (1,1), (.7,1)]\n");
  EXPECT_EQ(channel_of(plain, "st").corners, (std::vector<std::int32_t>{0, 1, 2, 3, 1, 5, 6, 7}));
  // A left-handed face is turned round, and its values with it.
  const ControlMesh left = read_usda(
      "float2[] primvars:st = [(0,0), (.5,0), (.5,1), (0,1), (.5,0), (1,0), (1,1), (.7,1)]\n"
      "uniform token orientation = \"leftHanded\"\n");
  EXPECT_EQ(left.faces[0][1], 3);
  EXPECT_EQ(channel_of(left, "st").at(1, 1), 1);
}

// Two quads of USD with more lines, and what is said of them.
io::Examination examined_usda(const std::string& more) {
  return io::examine(
      io::read_usda("#usda 1.0\ndef Mesh \"m\" {\n  point3f[] points = [(0,0,0), (1,0,0), (1,1,0), (0,1,0), "
                    "(2,0,0), (2,1,0)]\n  int[] faceVertexCounts = [4, 4]\n  int[] faceVertexIndices = "
                    "[0, 1, 2, 3, 1, 4, 5, 2]\n" +
                        more + "}\n",
                    "m.usda"),
      {});
}

TEST(Channels, OfUsdaHaveTheRuleOfTheirInterpolation) {
  const auto rule = [](const std::string& interpolation) {
    const auto found = examined_usda(
        "float[] primvars:wet = [1, 2, 3, 4, 5, 6] (\n  elementSize = 1\n  "
        "interpolation = \"" +
        interpolation + "\"\n)\n");
    return found.mesh.channels.empty() ? std::nullopt : found.mesh.channels[0].rule;
  };
  EXPECT_EQ(rule("vertex"), ChannelRule::kNone);
  EXPECT_EQ(rule("varying"), ChannelRule::kAll);
  // Six values are not those of eight corners; nor, as it happens to be, of one or two.
  for (const char* none : {"faceVarying", "uniform", "constant"}) EXPECT_EQ(rule(none), std::nullopt);
}

// What is no array of numbers at the corners or vertices of this mesh is no channel, and refuses no file.
TEST(Channels, OfUsdaThatAreNoneAreReadOver) {
  for (const char* more :
       {"float2[] primvars:st = None\n", "texCoord2f[] primvars:st (\n  interpolation = \"faceVarying\"\n)\n",
        "asset[] primvars:pictures = [@a.png@, @b.png@]\n",
        "float[] primvars:wet.timeSamples = { 0: [1, 2, 3, 4, 5, 6] }\n",
        "quatf[] primvars:turn = [(1, 0, 0, 0)]\n", "string[] primvars:names = [\"a\"]\n"})
    EXPECT_TRUE(examined_usda(more).mesh.channels.empty()) << more;
  EXPECT_EQ(examined_usda("int64[] primvars:id = [1, 2, 3, 4, 5, 6]\n").mesh.channels.at(0).components, 1);
  EXPECT_TRUE(says(refusal_of<InputError>([] {
                     examined_usda(
                         "int[] holeIndices = []\nfloat[] primvars:wet = [1, 2, 3, 4, 5, 6, 7, 8, 9]\n"
                         "def Mesh \"short\" {\n  point3f[] points = [(0,0,0), (1,0,0), (1,1,0)]\n"
                         "  int[] faceVertexCounts = [3]\n  int[] faceVertexIndices = [0, 1, 2, 0]\n"
                         "  float[] primvars:wet = [1, 2, 3, 4]\n}\n");
                   }),
                   "its faces have 3 corners, there are 4"));
}

// What a file says of a channel and cannot be is said again.
TEST(Channels, OfUsdaThatCannotBeHaveANote) {
  const auto note = [](const std::string& more) {
    const auto found = examined_usda(more);
    return found.notes.size() == 1 ? found.notes[0] : std::to_string(found.notes.size()) + " notes";
  };
  EXPECT_TRUE(says(note("float[] primvars:wet = [1, 2] (interpolation = \"faceVarying\")\n"),
                   "it has 2 values, for 6 vertices and 8 corners"));
  EXPECT_TRUE(says(note("float[] primvars:wet = [1, 2, 3, 4, 5, 6]\n"), "says no interpolation"));
  EXPECT_TRUE(
      says(note("uniform token faceVaryingLinearInterpolation = \"bilinear\"\n"), "none of its rules"));
  EXPECT_EQ(note("color3f[] primvars:displayColor = [(1, 0, 0)] (interpolation = \"constant\")\n"),
            "0 notes");
}

TEST(Channels, OfUsdaHaveOneNumberOfComponents) {
  const auto found = examined_usda(
      "float2[] primvars:st = [(0,0), (.5,0), (.5,1), (0,1), (.5,0), (1,0)] "
      "(interpolation = \"vertex\")\n"
      "def Mesh \"other\" {\n  point3f[] points = [(0,0,1), (1,0,1), (1,1,1)]\n  int[] faceVertexCounts = "
      "[3]\n"
      "  int[] faceVertexIndices = [0, 1, 2]\n  float4[] primvars:st = [(1,2,3,4), (1,2,3,4), "
      "(1,2,3,4)] (interpolation = \"vertex\")\n}\n");
  EXPECT_TRUE(found.mesh.channels.empty());
  ASSERT_FALSE(found.notes.empty());
  EXPECT_TRUE(says(found.notes[0], "another mesh of the file has it with "));
}

TEST(Channels, OfPlyAreTwoNumbersForEachCorner) {
  const auto found = io::examine(
      io::read_ply(
          "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
          "end_header\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n"
          "4 0 1 4 3 6 0 0 .5 0 .5 1\n4 1 2 5 4 10 .5 0 1 0 1 1 .75 1 .75 1\n",
          "two.ply"),
      {});
  EXPECT_TRUE(found.mesh.channels.empty());
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_TRUE(says(found.notes[0], "not two for each corner of face 0"));
}

TEST(Channels, FaultsAreNamed) {
  const ControlMesh mesh = read(kPositions + kTexture + kFaces).mesh;
  Channel channel = mesh.channels[0];
  EXPECT_EQ(fault_of(channel, mesh), "");
  channel.corners.pop_back();
  EXPECT_EQ(fault_of(channel, mesh), "it has 7 corners, the mesh has 8");
  channel = mesh.channels[0];
  channel.values.pop_back();
  EXPECT_EQ(fault_of(channel, mesh), "15 numbers are no values of 2 components");
  channel = mesh.channels[0];
  channel.components = 5;
  EXPECT_EQ(fault_of(channel, mesh), "a value has 1 to 4 components, not 5");
  channel = mesh.channels[0];
  channel.values[3] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fault_of(channel, mesh), "value 1 is not finite");
}

}  // namespace
}  // namespace limitcheck::data
