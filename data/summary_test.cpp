// SPDX-License-Identifier: MIT
#include "data/summary.h"

#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"

namespace limitcheck::data {
namespace {

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
