// SPDX-License-Identifier: MIT
// Half-edges, and meshes as the kernels read them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/test_support/assertions.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/test_support/refined_mesh.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast {
namespace {

using data::ControlMesh;

// Everything the class promises, found again from the triangle list alone.
void expect_consistent(const ControlMesh& mesh) {
  const Adjacency adjacency(mesh);
  std::map<std::pair<int, int>, int> half_edge;  // (from, to) -> h
  std::map<int, std::set<int>> neighbours;
  std::map<int, int> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
      half_edge[{a, b}] = static_cast<int>(3 * f) + k;
      neighbours[a].insert(b);
      neighbours[b].insert(a);
      ++faces[a];
    }
  }
  ASSERT_EQ(adjacency.face_count(), static_cast<int>(mesh.faces.size()));
  ASSERT_EQ(adjacency.vertex_count(), static_cast<int>(mesh.positions.size()));
  int largest = 0;
  for (const auto& [ends, h] : half_edge) {
    ASSERT_EQ(adjacency.origin(h), ends.first);
    ASSERT_EQ(adjacency.target(h), ends.second);
    const auto opposite = half_edge.find({ends.second, ends.first});
    const int twin = opposite == half_edge.end() ? -1 : opposite->second;
    ASSERT_EQ(adjacency.twin(h), twin) << "half-edge " << h;
    ASSERT_EQ(adjacency.neighbour(h / 3, h % 3), twin < 0 ? -1 : twin / 3);
  }
  for (int v = 0; v < adjacency.vertex_count(); ++v) {
    ASSERT_EQ(adjacency.valence(v), static_cast<int>(neighbours[v].size())) << "vertex " << v;
    ASSERT_EQ(adjacency.on_boundary(v), static_cast<int>(neighbours[v].size()) == faces[v] + 1)
        << "vertex " << v;
    largest = std::max(largest, adjacency.valence(v));
    std::set<int> met;
    int h = adjacency.outgoing(v), last = -1, steps = 0;
    for (; h >= 0 && steps < faces[v]; ++steps) {
      ASSERT_EQ(adjacency.origin(h), v);
      ASSERT_EQ(adjacency.fan(v)[steps], h);
      met.insert(adjacency.target(h));
      if (last >= 0) {
        ASSERT_EQ(adjacency.origin(Adjacency::prev(last)), adjacency.target(h)) << "not counter-clockwise";
      }
      last = h;
      h = adjacency.rotate(h);
    }
    if (last >= 0) met.insert(adjacency.origin(Adjacency::prev(last)));
    ASSERT_EQ(steps, faces[v]);
    ASSERT_EQ(static_cast<int>(adjacency.fan(v).size()), steps);
    ASSERT_EQ(h, adjacency.on_boundary(v) ? -1 : adjacency.outgoing(v)) << "vertex " << v;
    ASSERT_EQ(met, neighbours[v]) << "vertex " << v;
  }
  ASSERT_EQ(adjacency.max_valence(), largest);
}

TEST(Adjacency, EqualsTheEdgeMapOfClosedMeshes) {
  expect_consistent(tetrahedron());
  expect_consistent(octahedron());
  expect_consistent(bipyramid(3));
  expect_consistent(bipyramid(200));
  expect_consistent(grid_torus(5, 7));
}

TEST(Adjacency, EqualsTheEdgeMapOfMeshesWithBoundary) {
  expect_consistent(single_triangle());
  expect_consistent(wheel(3));
  expect_consistent(wheel(61));
  expect_consistent(grid_sheet(4, 6));
  expect_consistent(fan(9));
}

TEST(Adjacency, AllowsAVertexWithoutFacesAndAnEmptyMesh) {
  ControlMesh mesh = single_triangle();
  mesh.positions.push_back({9, 9, 9});
  expect_consistent(mesh);
  EXPECT_EQ(Adjacency(mesh).outgoing(3), -1);
  EXPECT_EQ(Adjacency(ControlMesh{}).face_count(), 0);
}

void expect_refused(int vertices, std::vector<std::array<std::int32_t, 3>> triangles,
                    const std::string& part) {
  ControlMesh mesh;
  mesh.positions.resize(static_cast<std::size_t>(vertices));
  mesh.faces = data::Faces(triangles);
  EXPECT_TRUE(says(refusal_of<data::ArgumentError>([&] { Adjacency{mesh}; }), part));
}

// Vertex 5 joins a fan of one face and one of two, in every order; the corners of vertex 0, which has more
// faces and comes first, must not be taken for its own.
TEST(Adjacency, RefusesTwoOpenFansWhateverTheOrderOfFaces) {
  std::array<std::array<std::int32_t, 3>, 4> hub{{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  std::sort(hub.begin(), hub.end());
  do {
    std::array<std::array<std::int32_t, 3>, 3> fans{{{5, 6, 7}, {5, 7, 8}, {5, 9, 10}}};
    do {
      std::vector<std::array<std::int32_t, 3>> triangles(hub.begin(), hub.end());
      triangles.insert(triangles.end(), fans.begin(), fans.end());
      expect_refused(11, triangles, "vertex 5 joins 2 fans");
    } while (std::next_permutation(fans.begin(), fans.end()));
  } while (std::next_permutation(hub.begin(), hub.end()));
}

TEST(Adjacency, RefusesWhatIsNotAnOrientedManifoldAndNamesTheElement) {
  expect_refused(3, {{0, 1, 3}}, "face 0 names vertex 3, the mesh has 3");
  expect_refused(3, {{0, 1, -1}}, "face 0 names vertex -1, the mesh has 3");
  expect_refused(3, {{0, 1, 1}}, "face 0 names vertex 1 twice");
  expect_refused(5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, "edge 0–1 has 3 faces (0, 1, 2)");
  expect_refused(4, {{0, 1, 2}, {0, 1, 3}}, "faces 0 and 1 both run from 0 to 1");
  expect_refused(3, {{0, 1, 2}, {0, 1, 2}}, "face 1 has the vertices of face 0");
  expect_refused(5, {{0, 1, 2}, {0, 3, 4}}, "vertex 0 joins 2 fans");
  expect_refused(3, {{0, 1, 2}, {0, 2, 1}}, "has valence 2");
  // Two tetrahedra that touch in vertex 0 only: two closed fans.
  expect_refused(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}},
                 "vertex 0 joins 2 fans");
}

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
    RefinedMesh theirs = RefinedMesh::of(mesh, data::Scheme::kCatmullClark);
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
              theirs.sharp_edges.find(RefinedMesh::edge(ours.faces[f][k], ours.faces[f][(k + 1) % 4]));
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
