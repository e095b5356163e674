// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/read.h"
#include "data/test_support/assertions.h"

namespace limitcheck::data {
namespace {

const std::string kSquares =
    "  point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)]\n"
    "  int[] faceVertexCounts = [4, 4]\n  int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]\n";
std::string mesh_of(const std::string& more, const std::string& body = kSquares) {
  return "def Mesh \"m\" {\n" + body + more + "\n}\n";
}
ControlMesh read_usda(const std::string& text) {
  return read_mesh("#usda 1.0\n" + text, FileFormat::kUsda, "m.usda");
}
std::string error_of_usda(const std::string& text) {
  const auto error = thrown<InputError>([&] { (void)read_usda(text); });
  return error ? error->code() + ":" + std::to_string(error->line()) : "read";
}

TEST(Usda, IsTheMeshOfTheSameFileInObj) {
  const std::string folder = LIMITCHECK_SOURCE_DIR "/data/wellformed/";
  const ControlMesh usd = read_mesh(folder + "creased_cube.v8.f6.usda");
  EXPECT_EQ(usd.faces,
            (Faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}));
  EXPECT_EQ(usd.positions[6], (std::array<double, 3>{1, 1, 1}));
  const std::vector<SharpEdge> edges{{4, 5, 2.5F}, {5, 6, 2.5F}, {6, 7, 2.5F}, {7, 4, 2.5F}};
  EXPECT_EQ(usd.sharpness.edges, edges);
  EXPECT_EQ(usd.sharpness.boundary, Boundary::kEdge);
}

TEST(Usda, MeansWhatUsdMeansWhereItSaysNothing) {
  EXPECT_EQ(read_usda(mesh_of("")).sharpness.boundary, Boundary::kEdgeAndCorner);
  const std::string triangle =
      "  point3f[] points = [(0,0,0), (1,0,0), (0,1,0)]\n  int[] faceVertexCounts = [3]\n  int[] "
      "faceVertexIndices = [0,1,2]\n";
  const auto scheme_of = [&](const std::string& more) {
    return io::read_usda("#usda 1.0\n" + mesh_of(more, triangle), "m.usda").scheme;
  };
  EXPECT_EQ(scheme_of(""), Scheme::kCatmullClark);
  EXPECT_EQ(scheme_of("uniform token subdivisionScheme = \"loop\""), Scheme::kLoop);
  EXPECT_EQ(scheme_of("uniform token subdivisionScheme = \"none\""), std::nullopt);
  const auto soup = io::read_usda("#usda 1.0\n" + mesh_of("", triangle), "m.usda");
  EXPECT_EQ(io::examine(soup, {}).scheme, Scheme::kCatmullClark);
  EXPECT_EQ(io::examine(soup, {.scheme = Scheme::kLoop}).scheme, Scheme::kLoop);
}

TEST(Usda, HasCornersHolesSharpnessByEdgeAndLeftHandedFaces) {
  const ControlMesh mesh = read_usda(mesh_of(
      "int[] creaseIndices = [0, 1, 4, 1, 2]\nint[] creaseLengths = [3, 2]\nfloat[] creaseSharpnesses = [1, "
      "2, 3]\n"
      "int[] cornerIndices = [2]\nfloat[] cornerSharpnesses = [10]\nint[] holeIndices = [1]\n"
      "uniform token orientation = \"leftHanded\"\nuniform token triangleSubdivisionRule = \"smooth\""));
  const std::vector<SharpEdge> edges{{0, 1, 1}, {1, 4, 2}, {1, 2, 3}};
  EXPECT_EQ(mesh.sharpness.edges, edges);
  EXPECT_EQ(mesh.sharpness.vertices, (std::vector<SharpVertex>{{2, 10}}));
  EXPECT_EQ(mesh.holes, (std::vector<std::int32_t>{1}));
  EXPECT_EQ(mesh.faces, (Faces{{0, 3, 2, 1}, {1, 2, 5, 4}}));
  EXPECT_EQ(mesh.sharpness.triangles, TriangleRule::kSmooth);
}

TEST(Usda, MeshesOfAFileAreOne) {
  const ControlMesh two = read_usda(mesh_of("") + mesh_of("int[] holeIndices = [0]"));
  EXPECT_EQ(two.positions.size(), 12U);
  EXPECT_EQ(two.faces, (Faces{{0, 1, 2, 3}, {1, 4, 5, 2}, {6, 7, 8, 9}, {7, 10, 11, 8}}));
  EXPECT_EQ(two.holes, (std::vector<std::int32_t>{2}));
}

TEST(Usda, WhatIsNotUnderstoodIsNamed) {
  const auto notes = io::read_usda("#usda 1.0\n" + mesh_of("double3 xformOp:translate = (1, 2, 3)\n"
                                                           "custom int strange = 3\ntoken outputs:surface\n"
                                                           "normal3f[] normals = [(0, 0, 1)]"),
                                   "m.usda")
                         .notes;
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_TRUE(says(notes[0], "line 6: \"xformOp:translate\" is not applied")) << notes[0];
  EXPECT_TRUE(says(notes[1], "line 7: \"strange\" is read over")) << notes[1];
  EXPECT_TRUE(says(notes[2], "line 8: \"outputs:surface\" is read over")) << notes[2];
}

TEST(Usda, NestingIsLimited) {
  std::string deep;
  for (int k = 0; k < 100000; ++k) deep += "def Xform \"x\" { ";
  EXPECT_EQ(error_of_usda(deep), "FILE_UNSUPPORTED:2");
  EXPECT_EQ(error_of_usda("def Xform \"x\" { int a = " + std::string(100000, '[')), "FILE_UNSUPPORTED:2");
}

}  // namespace
}  // namespace limitcheck::data
