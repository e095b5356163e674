// SPDX-License-Identifier: MIT
// What a topology takes and what it refuses, at the borders of both.
#include "reference/mesh/topology.h"

#include <gtest/gtest.h>

#include <stdexcept>

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
  EXPECT_THROW(Topology(3, kTetrahedron), std::invalid_argument);
  EXPECT_THROW(Topology(4, std::vector<Triangle>{{0, 1, -1}}), std::invalid_argument);
}

TEST(Topology, RefusesWhatIsNoManifold) {
  const auto refused = [](const std::vector<Triangle>& triangles) {
    EXPECT_THROW(Topology(9, triangles), std::invalid_argument);
  };
  refused({{0, 1, 1}});
  refused({{0, 1, 2}, {0, 1, 3}});             // clash
  refused({{0, 1, 2}, {1, 0, 3}, {1, 0, 4}});  // three faces at an edge
  refused({{0, 1, 2}, {0, 3, 4}});             // a bow tie
  refused({{0, 1, 2}, {0, 2, 1}});             // interior vertices of two faces
}

}  // namespace
}  // namespace limitcheck::reference
