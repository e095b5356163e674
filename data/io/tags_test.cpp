// SPDX-License-Identifier: MIT
// Sharp edges and vertices in files.
#include <gtest/gtest.h>

#include <string>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/shapes.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

const std::string kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

ControlMesh read_cube(const std::string& tags) {
  return read_mesh(kCube + tags, FileFormat::kObj, "cube.obj");
}

// "CODE:line" of the error, or "read".
std::string error_of(const std::string& tags) {
  try {
    read_cube(tags);
  } catch (const InputError& error) {
    return error.code() + ":" + std::to_string(error.line());
  }
  return "read";
}

TEST(Tags, OfObjCountVerticesFromZero) {
  const ControlMesh mesh = read_cube(
      "t crease 2/1/0 4 5 2.5\nt crease 4/1/0 5 6 7 6 10\nt crease 4/2/0 4 7 0 4 1 0.25\nt corner 1/1/0 0 3\n"
      "t interpolateboundary 1/0/0 1\nt creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n");
  const Sharpness& s = mesh.sharpness;
  const std::vector<SharpEdge> edges{{4, 5, 2.5F}, {5, 6, 10}, {7, 6, 10}, {4, 7, 1}, {0, 4, 0.25F}};
  EXPECT_EQ(s.edges, edges);
  ASSERT_EQ(s.vertices.size(), 1U);
  EXPECT_EQ(s.vertices[0], (SharpVertex{0, 3}));
  EXPECT_EQ(s.boundary, Boundary::kEdgeAndCorner);
  EXPECT_EQ(s.creasing, Creasing::kChaikin);
  EXPECT_EQ(s.triangles, TriangleRule::kSmooth);
  EXPECT_FALSE(s.empty());
  EXPECT_TRUE(read_cube("t interpolateboundary 1/0/0 2\nt creasemethod 0/0/1 normal\n").sharpness.empty());
}

TEST(Tags, OfObjHaveFractions) {
  const ControlMesh mesh = read_cube("t crease 2/1/0 4 5 23/10\nt corner 1/1/0 0 1/3\n");
  EXPECT_EQ(mesh.sharpness.edges.at(0).sharpness, 2.3F);
  EXPECT_EQ(mesh.sharpness.vertices.at(0).sharpness, 1.F / 3);
  for (const char* wrong : {"1/0", "1/", "/2", "1/-2", "1/2/3", "x"})
    EXPECT_EQ(error_of(std::string("t corner 1/1/0 0 ") + wrong + "\n"), "FILE_SYNTAX:15") << wrong;
}

TEST(Tags, OfObjHaveHoles) {
  const ControlMesh mesh = read_cube("t hole 2/0/0 4 1\nt hole 1/0/0 4\n");
  EXPECT_EQ(mesh.holes, (std::vector<std::int32_t>{1, 4}));
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_EQ(read_mesh(mesh_content(mesh, FileFormat::kObj), FileFormat::kObj, "again.obj"), mesh);
  EXPECT_THROW(mesh_content(mesh, FileFormat::kPly), InputError);
  EXPECT_THROW(mesh_content(mesh, FileFormat::kOff), InputError);
  EXPECT_EQ(error_of("t hole 1/0/0 6\n"), "MESH_HOLE:15");
  EXPECT_EQ(error_of("t hole 1/0/0 -1\n"), "MESH_HOLE:15");
  // Both triangles of a quad that is cut.
  const auto cut =
      read_mesh(kCube + "t hole 1/0/0 2\n", FileFormat::kObj, "cube.obj", {.polygons = Triangulation::kFan});
  EXPECT_EQ(cut.holes, (std::vector<std::int32_t>{4, 5}));
  ControlMesh wrong = mesh;
  wrong.holes = {4, 1, 6};
  EXPECT_EQ(validate(wrong).size(), 2U);
}

TEST(Tags, ThatAreWrongAreNamedWithTheirLine) {
  EXPECT_EQ(error_of("t crease 2/1/0 4 6 2\n"), "MESH_SHARPNESS:15");  // a diagonal
  EXPECT_EQ(error_of("t crease 2/1/0 4 8 2\n"), "MESH_SHARPNESS:15");  // no vertex
  EXPECT_EQ(error_of("t crease 2/1/0 4 5 2\nt crease 2/1/0 5 4 3\n"), "MESH_SHARPNESS:16");
  EXPECT_EQ(error_of("t crease 2/1/0 4 5 2\nt crease 2/1/0 5 4 2\n"), "read");
  EXPECT_EQ(error_of("t crease 2/1/0 4 5 -1\n"), "MESH_SHARPNESS:15");
  EXPECT_EQ(error_of("t crease 2/1/0 4 5 nan\n"), "MESH_SHARPNESS:15");
  EXPECT_EQ(error_of("t corner 1/1/0 8 1\n"), "MESH_SHARPNESS:15");
  EXPECT_EQ(error_of("t corner 1/1/0 4 1\nt corner 1/1/0 4 2\n"), "MESH_SHARPNESS:16");
  EXPECT_EQ(error_of("t crease 2/1/0 4 5\n"), "FILE_SYNTAX:15");
  EXPECT_EQ(error_of("t crease 2/1 4 5 1\n"), "FILE_SYNTAX:15");
  EXPECT_EQ(error_of("t crease 3/1/0 4 5 6 1\n"), "FILE_SYNTAX:15");
  EXPECT_EQ(error_of("t crease 2/1/0 -1 5 1\n"), "FILE_SYNTAX:15");
  EXPECT_EQ(error_of("t interpolateboundary 1/0/0 0\n"), "FILE_UNSUPPORTED:15");
  EXPECT_EQ(error_of("t creasemethod 0/0/1 soft\n"), "FILE_UNSUPPORTED:15");
}

TEST(Tags, AreReadBackAsTheyWereWritten) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const ControlMesh mesh = with_random_sharpness(quad_torus(12, 7), seed);
    ASSERT_FALSE(mesh.sharpness.edges.empty());
    EXPECT_EQ(read_mesh(mesh_content(mesh, FileFormat::kObj), FileFormat::kObj, "mesh.obj"), mesh);
    ControlMesh edges = mesh;
    edges.sharpness = {.edges = mesh.sharpness.edges, .vertices = {}};
    for (const bool ascii : {false, true})
      EXPECT_EQ(read_mesh(mesh_content(edges, FileFormat::kPly, {ascii}), FileFormat::kPly, "mesh.ply"),
                edges);
  }
}

TEST(Tags, AreNotLostInAFormatWithoutPlace) {
  ControlMesh mesh = quad_cube();
  mesh.sharpness.vertices = {{0, 1}};
  EXPECT_THROW((void)mesh_content(mesh, FileFormat::kPly), InputError);
  EXPECT_THROW((void)mesh_content(mesh, FileFormat::kOff), InputError);
  EXPECT_THROW((void)mesh_content(creased_cube(2), FileFormat::kOff), InputError);
  EXPECT_NO_THROW((void)mesh_content(creased_cube(2), FileFormat::kPly));
}

TEST(Tags, OfGeneratedMeshesAreValid) {
  for (const std::uint64_t s : {0, 1, 9, 10, 50}) {
    EXPECT_TRUE(validate(creased_cube(s)).empty());
    EXPECT_EQ(creased_cube(s).sharpness.edges.size(), 12U);
    EXPECT_TRUE(validate(crease_ring(s)).empty());
    EXPECT_EQ(crease_ring(s).sharpness.edges.size(), 12U);
  }
  for (const bool triangles : {false, true})
    for (int n = 3; n < 12; ++n) {
      EXPECT_TRUE(validate(dart(n, triangles)).empty());
      EXPECT_EQ(dart(n, triangles).sharpness.edges.size(), 1U);
      EXPECT_TRUE(validate(corner(n, triangles)).empty());
      EXPECT_EQ(corner(n, triangles).sharpness.edges.size(), static_cast<std::size_t>(n));
    }
  EXPECT_THROW(dart(2, false), InputError);
  EXPECT_THROW(corner(1, true), InputError);
}

}  // namespace
}  // namespace limitcheck::data
