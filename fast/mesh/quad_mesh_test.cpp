// SPDX-License-Identifier: MIT
#include "fast/mesh/cut_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/mixed_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/test_support/quad_refinement.h"

namespace limitcheck::fast {
namespace {

std::vector<data::ControlMesh> assorted() {
  std::vector<data::ControlMesh> meshes{
      data::quad_cube(),      data::quad_wheel(3, 1), data::quad_wheel(7, 2), data::quad_fan(1, 3),
      data::quad_fan(4, 4),   data::polygon_prism(5), data::mixed_pawn(6),    data::creased_cube(2),
      data::creased_cube(10), data::dart(5, false),   data::dart(3, true),    data::corner(2, false),
      data::corner(3, false), data::crease_ring(3)};
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    meshes.push_back(data::mixed_mesh(seed));
    meshes.push_back(data::with_random_sharpness(data::mixed_mesh(seed), seed));
    meshes.back().sharpness.creasing = seed % 2 == 0 ? data::Creasing::kUniform : data::Creasing::kChaikin;
    meshes.back().sharpness.boundary = seed % 3 == 0 ? data::Boundary::kEdgeAndCorner : data::Boundary::kEdge;
    meshes.back().sharpness.triangles =
        seed % 5 == 0 ? data::TriangleRule::kSmooth : data::TriangleRule::kCatmark;
  }
  return meshes;
}

long double distance(const std::array<double, 3>& p, const Point& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Both number the new vertices as: old ones, edges in the order of their ends, faces.
TEST(SharpPolygons, StepAsTheWholeMeshInLongDouble) {
  for (const auto& mesh : assorted()) {
    SharpPolygons ours = SharpPolygons::of(mesh);
    RefinedPolygons theirs = RefinedPolygons::of(mesh);
    for (int step = 0; step < 4 && ours.faces.size() < 20000; ++step) {
      ours = ours.step();
      theirs = theirs.step();
      ASSERT_EQ(ours.faces.size(), theirs.faces.size());
      for (std::size_t v = 0; v < ours.positions.size(); ++v)
        ASSERT_LE(distance(ours.positions[v], theirs.points[v]), 2e-15 * 8)
            << "vertex " << v << " step " << step;
      for (std::size_t f = 0; f < ours.faces.size(); ++f) {
        for (std::size_t k = 0; k < 4; ++k) {
          ASSERT_EQ(ours.faces[f][k], theirs.faces[f][k]);
          const auto at =
              theirs.sharp_edges.find(RefinedPolygons::edge(ours.faces[f][k], ours.faces[f][(k + 1) % 4]));
          const double s = ours.side[4 * f + k];
          if (at == theirs.sharp_edges.end())
            ASSERT_LE(s, 1e-15);
          else if (std::isinf(at->second))
            ASSERT_TRUE(std::isinf(s));
          else
            ASSERT_NEAR(s, static_cast<double>(at->second), 1e-14);
        }
      }
    }
  }
}

TEST(QuadMesh, OfPlainQuadsIsTheMeshItself) {
  const auto mesh = data::quad_torus(4, 5);
  const QuadMesh quads(mesh);
  EXPECT_EQ(quads.steps, 0);
  EXPECT_EQ(quads.positions, mesh.positions);
  EXPECT_EQ(quads.adjacency.face_count(), 20);
  EXPECT_TRUE(quads.kinds.empty() && quads.cut_twin.empty() && !quads.semi_sharp());
  for (std::int32_t v = 0; v < 20; ++v) EXPECT_EQ(quads.adjacency.valence(v), 4);
}

TEST(QuadMesh, OfOtherFacesIsOneStepOfIt) {
  const auto mesh = data::polygon_prism(5);
  const QuadMesh quads(mesh);
  EXPECT_EQ(quads.steps, 1);
  ASSERT_EQ(static_cast<std::size_t>(quads.adjacency.face_count()), mesh.faces.corners().size());
  for (std::int32_t q = 0; q < quads.adjacency.face_count(); ++q)
    EXPECT_EQ(quads.adjacency.corner(q, 0), mesh.faces.corners()[q]);
}

TEST(QuadMesh, ACutHasACopyOfItsPointsForEachSide) {
  const QuadMesh quads(data::creased_cube(10));
  EXPECT_EQ(quads.adjacency.vertex_count(), 24) << "six squares, nothing shared";
  EXPECT_EQ(quads.positions.size(), 24u);
  for (std::int32_t h = 0; h < 24; ++h) {
    EXPECT_LT(quads.adjacency.twin(h), 0);
    const std::int32_t t = quads.cut_twin[h];
    EXPECT_EQ(quads.cut_twin[t], h);
    EXPECT_EQ(quads.across(h), t / 4);
    EXPECT_EQ(quads.positions[quads.adjacency.origin(h)], quads.positions[quads.adjacency.target(t)]);
    EXPECT_EQ(quads.kind(quads.adjacency.origin(h)), VertexKind::kHeld) << "three sharp edges";
  }

  const QuadMesh ring(data::crease_ring(10));
  EXPECT_EQ(ring.adjacency.vertex_count(), 72 + 12);
  for (std::int32_t v = 0; v < 84; ++v) EXPECT_EQ(ring.kind(v), VertexKind::kPlain);
  EXPECT_FALSE(ring.semi_sharp());
}

TEST(QuadMesh, ADartIsASlitWithBothSidesAtOnePoint) {
  for (const int n : {3, 4, 5, 9}) {
    const auto mesh = data::dart(n, false);
    const QuadMesh quads(mesh);
    int darts = 0;
    for (std::int32_t v = 0; v < quads.adjacency.vertex_count(); ++v) {
      if (quads.kind(v) != VertexKind::kDart) continue;
      ++darts;
      ASSERT_TRUE(quads.adjacency.on_boundary(v));
      const auto fan = quads.adjacency.fan(v);
      EXPECT_EQ(quads.positions[quads.adjacency.target(fan.front())],
                quads.positions[quads.adjacency.origin(QuadAdjacency::prev(fan.back()))]);
      EXPECT_EQ(quads.cut_twin[fan.front()], QuadAdjacency::prev(fan.back()));
    }
    EXPECT_EQ(darts, 2) << "both ends of the edge";
    EXPECT_EQ(quads.adjacency.vertex_count(), static_cast<int>(mesh.positions.size()))
        << "nothing is doubled";
  }
}

TEST(QuadMesh, ACornerHasASectorForEachPairOfSharpEdges) {
  const auto mesh = data::corner(3, false);
  const QuadMesh quads(mesh);
  int held = 0;
  for (std::int32_t v = 0; v < quads.adjacency.vertex_count(); ++v) {
    if (quads.kind(v) != VertexKind::kHeld) continue;
    ++held;
    EXPECT_EQ(quads.adjacency.fan(v).size(), 2u);
  }
  EXPECT_EQ(held, 3);
}

TEST(QuadMesh, KeepsWhatIsSemiSharp) {
  const QuadMesh quads(data::creased_cube(3));
  ASSERT_TRUE(quads.semi_sharp());
  for (const double s : quads.side_sharpness) EXPECT_EQ(s, 3);
  for (std::int32_t h = 0; h < 24; ++h) EXPECT_GE(quads.adjacency.twin(h), 0);
  EXPECT_EQ(quads.kind(0), VertexKind::kPlain) << "in the end";
}

TEST(QuadMesh, RefusesWhatIsNoSurface) {
  auto mesh = data::quad_cube();
  mesh.faces[0][2] = 99;
  EXPECT_THROW(QuadMesh{mesh}, data::ArgumentError);
  mesh = data::quad_cube();
  mesh.faces[3][1] = mesh.faces[3][3];
  EXPECT_THROW(QuadMesh{mesh}, data::ArgumentError);
  mesh = data::quad_cube();
  mesh.sharpness.edges.push_back({0, 6, 1});
  EXPECT_THROW(QuadMesh{mesh}, data::ArgumentError) << "a diagonal is no edge";
  data::ControlMesh pillow{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}}};
  EXPECT_THROW(QuadMesh{pillow}, data::ArgumentError) << "interior valence 2";
}

}  // namespace
}  // namespace limitcheck::fast
