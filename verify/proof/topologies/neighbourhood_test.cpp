// SPDX-License-Identifier: MIT
// The situations that proofs range over are the ones they say they are.
#include "verify/proof/topologies/neighbourhood.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "data/shapes.h"
#include "fast/mesh/adjacency.h"

namespace limitcheck::verify {
namespace {

TEST(Proof_Neighbourhoods, HaveTheInteriorValencesAskedForOrDoNotExist) {
  int missing = 0;
  for (int a = 3; a <= 12; ++a) {
    for (int b = 3; b <= 12; ++b) {
      for (int c = 3; c <= 12; ++c) {
        for (int d = 3; d <= 12; ++d) {
          const auto pair = interior_pair({a, b, c, d});
          if (!pair) {
            // Two neighbours of valence 3 share all three neighbours: the rest of the mesh is decided.
            EXPECT_TRUE(a == 3 || b == 3 || c == 3 || d == 3 || (a == 4 && c == 4))
                << fmt::format("{} {} {} {}", a, b, c, d);
            ++missing;
            continue;
          }
          EXPECT_EQ(pair->name, fmt::format("{} {} {} {}", a, b, c, d));
        }
      }
    }
  }
  RecordProperty("missing", missing);
  fmt::print("{} of 10000 have no mesh\n", missing);
}

TEST(Proof_Neighbourhoods, AtBoundariesHaveOneToFourBoundaryEdgesAndVerticesOfOneToFiveFaces) {
  std::set<int> edges, diagonal_faces, other_faces;
  for (const Neighbourhood& pair : boundary_pairs({6, 6, 6, 6})) {
    const fast::Adjacency adjacency(pair.mesh);
    int boundary = 0;
    for (const int h : {1, 2, 3, 4}) boundary += adjacency.twin(h) < 0 ? 1 : 0;
    edges.insert(boundary);
    for (const int corner : {0, 1, 2, 3})
      if (adjacency.on_boundary(corner))
        (corner % 2 == 0 ? diagonal_faces : other_faces).insert(adjacency.valence(corner) - 1);
    EXPECT_EQ(signature(pair.mesh, 0), pair.name);
  }
  EXPECT_EQ(edges, (std::set{0, 1, 2, 3, 4}));
  EXPECT_EQ(diagonal_faces, (std::set{2, 3, 4, 5}));
  EXPECT_EQ(other_faces, (std::set{1, 2, 3, 4, 5}));
}

TEST(Proof_Neighbourhoods, OfAMeshAreAllItsPairs) {
  EXPECT_EQ(pairs_of(data::icosahedron()).size(), 1U);
  EXPECT_EQ(pairs_of(data::icosahedron()).front().name, "5 5 5 5");
  const auto pairs = pairs_of(data::bipyramid(7));
  ASSERT_EQ(pairs.size(), 3U);  // across the equator, and down a side in two directions
  std::set<std::string> names;
  for (const Neighbourhood& pair : pairs) names.insert(pair.name);
  EXPECT_EQ(names, (std::set<std::string>{"4 7 4 7", "4 4 7 4", "7 4 4 4"}));
}

}  // namespace
}  // namespace limitcheck::verify
