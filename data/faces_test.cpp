// SPDX-License-Identifier: MIT
// Faces cut out of a mesh, and cut into triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "data/cut_out.h"
#include "data/faces.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "data/summary.h"
#include "data/test_meshes.h"
#include "data/triangulate.h"

namespace limitcheck::data {
namespace {

// What is cut out of a valid mesh is valid, whatever the faces; and nothing else is changed.
TEST(CutOut, AnyFacesOfAValidMeshAreAValidMeshWithTheSameCorners) {
  SplitMix64 random(7);
  for (const ControlMesh& whole : {tetrahedron(), octahedron(), torus(3, 3), bipyramid(3), bipyramid(5),
                                   holes(), wheel(7), two_components()})
    for (int attempt = 0; attempt < 100; ++attempt) {
      std::vector<std::int32_t> faces;
      for (std::size_t f = 0; f < whole.faces.size(); ++f)
        if (random.next() % 3 == 0) faces.push_back(static_cast<std::int32_t>(f));
      if (faces.empty()) continue;
      std::reverse(faces.begin(), faces.end());
      const CutOut part = cut_out(whole.faces, faces);
      ASSERT_EQ(part.faces.size(), faces.size());
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_EQ(part.vertices[part.faces[f][k]], whole.faces[faces[f]][k]);
      expect_valid({part.of(whole.positions), part.faces}, std::to_string(whole.faces.size()));
    }
}

TEST(CutOut, AllFacesAreTheMeshItself) {
  const ControlMesh whole = torus(3, 3);
  std::vector<std::int32_t> faces;
  for (std::size_t f = 0; f < whole.faces.size(); ++f) faces.push_back(static_cast<std::int32_t>(f));
  const CutOut part = cut_out(whole.faces, faces);
  EXPECT_EQ(part.vertices.size(), whole.positions.size());
  EXPECT_EQ(std::set(part.vertices.begin(), part.vertices.end()).size(), whole.positions.size());
}

TEST(CutOut, FansThatNoEdgeHoldsTogetherGetAVertexEach) {
  // Vertex 0 joins three fans, of three faces, one and one: the first holds together over edges 2-0 and 0-3.
  Faces faces{{0, 1, 2}, {0, 3, 4}, {2, 3, 0}, {5, 0, 6}, {7, 8, 0}};
  const std::vector<std::int32_t> copies = split_fans(faces, 9);
  EXPECT_EQ(copies, (std::vector<std::int32_t>{0, 0}));
  EXPECT_EQ(faces, (Faces{{0, 1, 2}, {0, 3, 4}, {2, 3, 0}, {5, 9, 6}, {7, 8, 10}}));
}

TEST(CutOut, TakesFacesOfAnyNumberOfCorners) {
  // Two quads and a pentagon around vertex 0, and a triangle that touches it: the fans become two vertices.
  const Faces whole{{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 7, 8}, {9, 10, 0}};
  const CutOut part = cut_out(whole, std::vector<std::int32_t>{2, 0, 3});
  EXPECT_EQ(part.faces, (Faces{{0, 1, 2, 3, 4}, {10, 5, 6, 7}, {8, 9, 11}}));
  EXPECT_EQ(part.vertices, (std::vector<std::int32_t>{0, 5, 6, 7, 8, 1, 2, 3, 9, 10, 0, 0}));
}

TEST(Triangulate, EveryTriangleNamesTheFaceThatItWasCutFrom) {
  const ControlMesh prism = polygon_prism(5);  // two pentagons, five quads
  const Triangulated cut = triangulate(prism, Triangulation::kFan);
  EXPECT_EQ(cut.cut, 7);
  EXPECT_EQ(cut.face, (std::vector<std::int64_t>{0, 0, 0, 1, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6}));
  EXPECT_TRUE(validate({prism.positions, cut.faces}, Scheme::kLoop).empty());
  for (std::size_t t = 0; t < 3; ++t)
    EXPECT_EQ(cut.faces[t][0], prism.faces[0][0]) << "a fan starts at the first corner";
}

TEST(Triangulate, TakesQuadsThatNameVerticesWhichDoNotExist) {
  const ControlMesh mesh{quad_cube().positions, {{0, 1, 99, 3}, {0, -1, 2, 3}}};
  EXPECT_EQ(triangulate(mesh, Triangulation::kShortestDiagonal).faces,
            (Faces{{0, 1, 99}, {0, 99, 3}, {0, -1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, TrianglesAndWhatIsToBeKeptStayWhatTheyAre) {
  for (const Triangulation rule : {Triangulation::kFan, Triangulation::kShortestDiagonal}) {
    const Triangulated same = triangulate(octahedron(), rule);
    EXPECT_EQ(same.faces, octahedron().faces);
    EXPECT_EQ(same.cut, 0);
  }
  EXPECT_EQ(triangulate(quad_cube(), Triangulation::kKeep).faces, quad_cube().faces);
}

// The build must round where the source says so: g++ 12 with its basic-block vectoriser does not.
[[gnu::noinline]] void round_to_float(std::vector<std::array<double, 3>>& points) {
  for (auto& point : points) {
    for (double& x : point) x = static_cast<float>(x);
  }
}

TEST(Build, RoundsEveryCoordinateToFloat) {
  std::vector<std::array<double, 3>> points(10, {0.1, 0.1, 0.1});
  round_to_float(points);
  for (const auto& point : points) {
    for (const double x : point) EXPECT_EQ(x, 0x1.99999ap-4);
  }
}

TEST(MeshSummary, OfATetrahedronIsCountedByHand) {
  const MeshSummary s = summarise(tetrahedron());
  EXPECT_EQ(s.vertices, 4);
  EXPECT_EQ(s.faces, 4);
  EXPECT_EQ(s.edges, 6);
  EXPECT_EQ(s.components, 1);
  EXPECT_EQ(s.boundary_edges, 0);
  EXPECT_EQ(s.boundary_loops, 0);
  EXPECT_EQ(s.euler, 2);
  EXPECT_EQ(s.valence, (std::map<int, std::int64_t>{{3, 4}}));
  EXPECT_TRUE(s.boundary_faces.empty());
  EXPECT_EQ(s.zero_area_faces, 0);
  EXPECT_EQ(s.unused_vertices, 0);
}

// A square of two triangles, cut apart along its diagonal: each half has vertices of its own there.
TEST(MeshSummary, TellsASeamFromABoundary) {
  const ControlMesh cut{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                        {{0, 1, 2}, {3, 4, 5}}};
  const MeshSummary s = summarise(cut);
  EXPECT_EQ(s.components, 2);
  EXPECT_EQ(s.boundary_edges, 6);
  EXPECT_EQ(s.boundary_loops, 2);
  EXPECT_EQ(s.coincident_boundary_edges, 2);
  EXPECT_EQ(s.coincident_vertices, 2);
  EXPECT_EQ(s.boundary_faces, (std::map<int, std::int64_t>{{1, 6}}));

  const ControlMesh whole{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(summarise(whole).coincident_boundary_edges, 0);
  EXPECT_EQ(summarise(whole).coincident_vertices, 0);
}

TEST(MeshSummary, FindsFacesWithoutAreaAtAnySize) {
  for (const double size : {1e-200, 1e-30, 1.0, 1e30}) {
    const ControlMesh mesh{{{0, 0, 0}, {size, 0, 0}, {2 * size, 0, 0}, {0, size, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    EXPECT_EQ(summarise(mesh).zero_area_faces, 1) << size;
  }
}

// At 1000 float numbers lie 2^-14 = 6.1e-5 apart: an edge of 1e-4 keeps two steps.
TEST(MeshSummary, SaysWhatRoundingToFloatCosts) {
  const ControlMesh far{{{1000, 0, 0}, {1000.0001, 0, 0}, {1000, 1, 0}}, {{0, 1, 2}}};
  const MeshSummary s = summarise(far);
  EXPECT_EQ(s.float_step, std::ldexp(1.0, -14));
  EXPECT_EQ(s.edges_lost_in_float, 1);
  EXPECT_NEAR(s.shortest_edge, 1e-4, 1e-12);
}

TEST(MeshSummary, CountsVerticesThatNoFaceNames) {
  ControlMesh mesh = tetrahedron();
  mesh.positions.push_back({5, 5, 5});
  EXPECT_EQ(summarise(mesh).unused_vertices, 1);
  EXPECT_EQ(summarise(mesh).euler, 2);
}

}  // namespace
}  // namespace limitcheck::data
