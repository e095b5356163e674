// SPDX-License-Identifier: MIT
// Sharp edges and vertices in files.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/io/polygon_soup.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

const std::string kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

ControlMesh read_cube(const std::string& tags) {
  return read_mesh(kCube + tags, FileFormat::kObj, "cube.obj");
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
}

TEST(Tags, OfObjHaveHoles) {
  const ControlMesh mesh = read_cube("t hole 2/0/0 4 1\nt hole 1/0/0 4\n");
  EXPECT_EQ(mesh.holes, (std::vector<std::int32_t>{1, 4}));
  EXPECT_TRUE(validate(mesh).empty());
  EXPECT_EQ(read_mesh(mesh_content(mesh, FileFormat::kObj), FileFormat::kObj, "again.obj"), mesh);
  EXPECT_THROW(mesh_content(mesh, FileFormat::kPly), InputError);
  EXPECT_THROW(mesh_content(mesh, FileFormat::kOff), InputError);
  // Both triangles of a quad that is cut.
  const auto cut =
      read_mesh(kCube + "t hole 1/0/0 2\n", FileFormat::kObj, "cube.obj", {.polygons = Triangulation::kFan});
  EXPECT_EQ(cut.holes, (std::vector<std::int32_t>{4, 5}));
  ControlMesh wrong = mesh;
  wrong.holes = {4, 1, 6};
  EXPECT_EQ(validate(wrong).size(), 2U);
}

// Of what moves no point nothing is lost; what does is refused by its name.
TEST(Tags, WithoutAMeaningAreReadOverWithANoteAndEditsAreRefused) {
  for (const char* tag : {"facevaryinginterpolateboundary 1/0/0 6", "facevaryingunheardof 1/0/0 1"}) {
    const auto found =
        io::examine(io::read_obj(kCube + "t " + tag + "\nt corner 1/1/0 0 3\n", "cube.obj"), {});
    ASSERT_EQ(found.notes.size(), 1U) << tag;
    EXPECT_TRUE(found.notes[0].starts_with("line 15: tag \"facevarying")) << found.notes[0];
    EXPECT_EQ(found.mesh, read_cube("t corner 1/1/0 0 3\n"));
  }
  for (const std::string edit : {"vertexedit", "edgeedit", "faceedit"}) {
    const std::string tag = "t " + edit + " 2/1/3 4 0 1 add value sharpness\n";
    EXPECT_TRUE(says(refusal_of<InputError>([&] { read_cube(tag); }), edit + "\" is a hierarchical edit"));
  }
}

// A sheet of 4 x 4 squares, or of 32 triangles, with its corner (0, 0) at vertex 0.
std::string text_of_sheet(bool triangles) {
  std::string text;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) text += "v " + std::to_string(i) + " " + std::to_string(j) + " 0\n";
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const auto v = [&](int di, int dj) { return " " + std::to_string(5 * (j + dj) + i + di + 1); };
      text += triangles ? "f" + v(0, 0) + v(1, 0) + v(1, 1) + "\nf" + v(0, 0) + v(1, 1) + v(0, 1) + "\n"
                        : "f" + v(0, 0) + v(1, 0) + v(1, 1) + v(0, 1) + "\n";
    }
  return text;
}

// Faces at a boundary vertex are not shown, unless all its boundary edges are sharp for good: along the lower
// side all edges are, and its inner vertices hide nothing.
TEST(Tags, FacesBesideABoundaryThatIsNotInterpolatedAreHoles) {
  for (const bool triangles : {false, true}) {
    const auto read = [&](const std::string& tags) {
      return read_mesh(text_of_sheet(triangles) + tags, FileFormat::kObj, "sheet.obj");
    };
    const ControlMesh none = read("t interpolateboundary 1/0/0 0\n");
    const auto is_hole = [&](const ControlMesh& mesh, int i, int j) {
      const int face = 4 * j + i;
      const auto has = [&](int f) { return std::binary_search(mesh.holes.begin(), mesh.holes.end(), f); };
      return triangles ? has(2 * face) && has(2 * face + 1) : has(face);
    };
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        EXPECT_EQ(is_hole(none, i, j), i == 0 || i == 3 || j == 0 || j == 3) << i << " " << j;
    EXPECT_EQ(none.faces, read("").faces) << "they still shape the others";
    EXPECT_EQ(none.sharpness, read("").sharpness);
    EXPECT_EQ(read_mesh(mesh_content(none, FileFormat::kObj), FileFormat::kObj, "again.obj"), none);

    const std::string sharp = "t crease 2/1/0 0 1 10\nt crease 2/1/0 1 2 10\nt crease 2/1/0 2 3 10\n";
    const ControlMesh partly = read(sharp + "t interpolateboundary 1/0/0 0\n");
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(std::binary_search(partly.holes.begin(), partly.holes.end(), triangles ? 2 * i : i),
                i == 0 || i > 1)
          << i;
    EXPECT_EQ(read("t crease 2/1/0 0 1 9\nt crease 2/1/0 1 2 9\nt interpolateboundary 1/0/0 0\n").holes,
              none.holes);

    EXPECT_TRUE(read("t interpolateboundary 1/0/0 0\nt interpolateboundary 1/0/0 2\n").holes.empty());
    const ControlMesh both = read("t hole 1/0/0 10\nt interpolateboundary 1/0/0 0\n");
    EXPECT_EQ(both.holes.size(), none.holes.size() + 1);
  }
  EXPECT_TRUE(read_cube("t interpolateboundary 1/0/0 0\n").holes.empty()) << "it has no boundary";
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

}  // namespace
}  // namespace limitcheck::data
