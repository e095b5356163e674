// SPDX-License-Identifier: MIT
#include "fast/mesh/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "data/error.h"
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
  try {
    const Adjacency adjacency(mesh);
    FAIL() << "accepted; expected: " << part;
  } catch (const data::ArgumentError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
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
      expect_refused(11, triangles, "vertex 5 joins two fans");
    } while (std::next_permutation(fans.begin(), fans.end()));
  } while (std::next_permutation(hub.begin(), hub.end()));
}

TEST(Adjacency, RefusesWhatIsNotAnOrientedManifoldAndNamesTheElement) {
  expect_refused(3, {{0, 1, 3}}, "face 0 names vertex 3 of 3");
  expect_refused(3, {{0, 1, -1}}, "face 0 names vertex -1 of 3");
  expect_refused(3, {{0, 1, 1}}, "face 0 repeats a vertex");
  expect_refused(5, {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, "edge 0-1 has more than two faces");
  expect_refused(4, {{0, 1, 2}, {0, 1, 3}}, "edge 0-1 runs the same way in two faces (faces 0, 1)");
  expect_refused(3, {{0, 1, 2}, {0, 1, 2}}, "runs the same way");
  expect_refused(5, {{0, 1, 2}, {0, 3, 4}}, "vertex 0 joins two fans");
  expect_refused(3, {{0, 1, 2}, {0, 2, 1}}, "has valence 2");
  // Two tetrahedra that touch in vertex 0 only: two closed fans.
  expect_refused(7, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}},
                 "vertex 0 joins two fans");
}

}  // namespace
}  // namespace limitcheck::fast
