// SPDX-License-Identifier: MIT
// What a topology takes and what it refuses, at the borders of both.
#include "reference/mesh/topology.h"

#include <gtest/gtest.h>

#include <vector>

#include "data/error.h"
#include "data/test_support/assertions.h"

namespace limitcheck::reference {
namespace {

const std::vector<Triangle> kTetrahedron{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};

TEST(Topology, TakesVerticesThatNoFaceUses) {
  const Topology topology(6, kTetrahedron);
  EXPECT_EQ(topology.vertex_count(), 6U);
  EXPECT_EQ(topology.ring(3).size(), 3U);
  for (const std::int32_t unused : {4, 5}) {
    EXPECT_TRUE(topology.ring(unused).empty());
    EXPECT_FALSE(topology.on_boundary(unused));
  }
}

TEST(Topology, RefusesIndicesFromTheVertexCountOn) {
  EXPECT_NO_THROW(Topology(4, kTetrahedron));
  EXPECT_THROW(Topology(3, kTetrahedron), data::ArgumentError);
  EXPECT_THROW(Topology(4, std::vector<Triangle>{{0, 1, -1}}), data::ArgumentError);
}

TEST(Topology, RefusesWhatIsNoManifold) {
  const auto refused = [](const std::vector<Triangle>& triangles) {
    EXPECT_THROW(Topology(9, triangles), data::ArgumentError);
  };
  refused({{0, 1, 1}});
  refused({{0, 1, 2}, {0, 1, 3}});             // clash
  refused({{0, 1, 2}, {1, 0, 3}, {1, 0, 4}});  // three faces at an edge
  refused({{0, 1, 2}, {0, 3, 4}});             // a bow tie
  refused({{0, 1, 2}, {0, 2, 1}});             // interior vertices of two faces
}

// Faces of 3, 4 and 5 corners: a prism is closed, a strip is not.
data::Faces polygons(std::initializer_list<std::vector<std::int32_t>> list) {
  data::Faces faces;
  for (const auto& face : list) faces.push_back(face);
  return faces;
}
Topology prism() {
  return {6, polygons({{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}})};
}
Topology strip() {
  return {8, polygons({{0, 1, 2}, {0, 2, 3, 4}, {3, 2, 5, 6, 7}})};
}

TEST(Topology, OfPolygonsPutsEveryFaceBetweenTheNeighboursThatItsCornerHas) {
  for (const Topology& topology : {prism(), strip(), Topology(4, kTetrahedron)}) {
    for (std::size_t f = 0; f < topology.faces().size(); ++f) {
      const auto face = topology.faces()[f];
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Sector sector = topology.sector(face[k]);
        const std::size_t i = topology.ring_index(f, k), next = (i + 1) % sector.neighbours.size();
        const std::size_t before = (k + face.size() - 1) % face.size();
        EXPECT_EQ(sector.faces[i], static_cast<std::int32_t>(f));
        EXPECT_EQ(sector.neighbours[i], face[(k + 1) % face.size()]);
        EXPECT_EQ(sector.neighbours[next], face[before]);
        EXPECT_EQ(sector.edges[i], topology.edge(f, k));
        EXPECT_EQ(sector.edges[next], topology.edge(f, before));
        const Edge& edge = topology.edges()[topology.edge(f, k)];
        EXPECT_EQ(edge.left_face == sector.faces[i] ? edge.a : edge.b, face[k]);
        EXPECT_TRUE(edge.left_face == sector.faces[i] || edge.right_face == sector.faces[i]);
      }
    }
  }
}

TEST(Topology, OfPolygonsHasClosedSectorsInsideAndOpenOnesOnTheBoundary) {
  const Topology closed = prism(), open = strip();
  EXPECT_EQ(closed.edges().size(), 9U);
  EXPECT_EQ(open.edges().size(), 10U);
  for (std::int32_t v = 0; v < 6; ++v) {
    EXPECT_TRUE(closed.sector(v).closed);
    EXPECT_EQ(closed.sector(v).faces.size(), 3U);
    EXPECT_EQ(closed.ring(v).size(), 3U);
  }
  for (std::int32_t v = 0; v < 8; ++v) {
    EXPECT_FALSE(open.sector(v).closed);
    EXPECT_TRUE(open.on_boundary(v));
    EXPECT_EQ(open.ring(v).size(), open.sector(v).faces.size() + 1);
  }
  const auto list = [](std::span<const std::int32_t> s) { return std::vector(s.begin(), s.end()); };
  EXPECT_EQ(list(open.sector(2).neighbours), (std::vector{5, 3, 0, 1}));
  EXPECT_EQ(list(open.sector(2).faces), (std::vector{2, 1, 0}));
  EXPECT_EQ(list(open.sector(4).neighbours), (std::vector{0, 3}));
}

TEST(Topology, NamesTheFaceThatRepeatsAVertex) {
  EXPECT_EQ(refusal_of<data::ArgumentError>([] {
              Topology(9, polygons({{0, 1, 2}, {3, 4, 5, 4}}));
            }),
            "control mesh: face 1 repeats a vertex");
}

TEST(Topology, OfPolygonsRefusesFacesThatAreNone) {
  const auto refused = [](data::Faces faces) {
    EXPECT_THROW(Topology(9, std::move(faces)), data::ArgumentError);
  };
  refused(polygons({{0, 1}}));
  refused(polygons({{}}));
  refused(polygons({{0, 1, 9}}));                        // no such vertex
  refused(polygons({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));  // three faces at an edge
  refused(polygons({{0, 1, 2, 1}}));                     // a vertex twice, not at neighbouring corners
  refused(polygons({{0, 1, 2, 3}, {0, 3, 2, 4}}));       // an interior vertex of two faces
  refused(polygons({{0, 1, 2, 3}, {0, 4, 5, 6}}));       // a bow tie
  refused(polygons({{0, 1, 2, 3}, {0, 1, 4, 5}}));       // clash
}

}  // namespace
}  // namespace limitcheck::reference
