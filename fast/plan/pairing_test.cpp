// SPDX-License-Identifier: MIT
#include "fast/plan/pairing.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "data/error.h"
#include "fast/plan/printed_rules.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast {
namespace {

// What any result must be, whatever the choices: a partition of the visible faces into neighbours and
// leftovers.
void expect_partition(const data::ControlMesh& mesh, const std::vector<std::int32_t>& depth,
                      const PrintedRules& rules) {
  const Adjacency adjacency(mesh);
  const PairingResult result = pair_faces(adjacency, depth, rules);
  ASSERT_EQ(result.depth.size(), depth.size());
  std::vector<int> used(depth.size(), 0);
  std::int64_t singletons = 0;
  for (const Grid& grid : result.grids) {
    ++used[grid.face0];
    if (grid.singleton()) {
      ++singletons;
      ASSERT_EQ(grid.depth, depth[grid.face0]);
      bool lonely = true;
      for (int k = 0; k < 3; ++k) lonely = lonely && adjacency.neighbour(grid.face0, k) < 0;
      ASSERT_EQ(grid.edge0 < 0, lonely) << "a dummy exists if any neighbour does";
    } else {
      ++used[grid.face1];
      ASSERT_EQ(grid.depth, std::max(depth[grid.face0], depth[grid.face1]));
      ASSERT_EQ(result.depth[grid.face1], grid.depth);
      ASSERT_EQ(adjacency.neighbour(grid.face0, grid.edge0), grid.face1);
    }
    ASSERT_EQ(result.depth[grid.face0], grid.depth);
    if (grid.edge0 >= 0) {
      const std::int32_t h = adjacency.twin(3 * grid.face0 + grid.edge0);
      ASSERT_GE(h, 0);
      ASSERT_EQ(h % 3, grid.edge1);
    } else {
      ASSERT_EQ(grid.edge1, -1);
    }
  }
  for (std::size_t f = 0; f < depth.size(); ++f) ASSERT_EQ(used[f], depth[f] < 0 ? 0 : 1) << "face " << f;
  ASSERT_EQ(result.singletons, singletons);
  ASSERT_EQ(result.pair_count + result.singletons, static_cast<std::int64_t>(result.grids.size()));
  ASSERT_EQ(result.culled, std::count(depth.begin(), depth.end(), -1));
  // No two singletons are neighbours.
  for (const Grid& grid : result.grids) {
    for (int k = 0; grid.singleton() && k < 3; ++k) {
      const std::int32_t g = adjacency.neighbour(grid.face0, k);
      for (const Grid& other : result.grids) ASSERT_FALSE(g >= 0 && other.singleton() && other.face0 == g);
    }
  }
}

TEST(Pairing, PartitionsTheVisibleFacesForAnyMeshDepthAndRule) {
  for (const auto& mesh :
       {tetrahedron(), octahedron(), bipyramid(3), bipyramid(50), grid_torus(5, 7), single_triangle(),
        wheel(3), wheel(9), fan(8), grid_sheet(5, 6), data::ControlMesh{}}) {
    for (const PairingRule rule : {PairingRule::kCorrected, PairingRule::kPrinted}) {
      for (const bool prefer : {true, false}) {
        for (int variant = 0; variant < 4; ++variant) {
          std::vector<std::int32_t> depth(mesh.faces.size(), 2);
          for (std::size_t f = 0; variant > 0 && f < depth.size(); ++f) {
            depth[f] =
                static_cast<std::int32_t>((f * 7919 + 31 * static_cast<std::size_t>(variant)) % 97 % 4) - 1;
          }
          expect_partition(mesh, depth, {rule, prefer});
        }
      }
    }
  }
}

TEST(Pairing, ATriangleWithoutNeighboursIsASingletonWithoutDummy) {
  const Adjacency adjacency(single_triangle());
  const PairingResult result = pair_faces(adjacency, std::vector<std::int32_t>{3});
  ASSERT_EQ(result.grids.size(), 1u);
  EXPECT_EQ(result.grids[0], (Grid{0, -1, -1, -1, 3}));
}

TEST(Pairing, ASingletonMayUseACulledNeighbourAsDummy) {
  const data::ControlMesh mesh = octahedron();
  const Adjacency adjacency(mesh);
  std::vector<std::int32_t> depth(8, -1);
  depth[5] = 2;
  const PairingResult result = pair_faces(adjacency, depth);
  ASSERT_EQ(result.grids.size(), 1u);
  EXPECT_EQ(result.grids[0].face0, 5);
  EXPECT_TRUE(result.grids[0].singleton());
  EXPECT_EQ(result.grids[0].edge0, 0);
  EXPECT_EQ(result.culled, 7);
  EXPECT_EQ(result.depth, depth) << "nothing culled comes back";
}

// A strip of four triangles: only pairing from the ends leaves none over. S0 first does that.
TEST(Pairing, StartsWhereThereIsTheLeastChoice) {
  const Adjacency adjacency(fan(4));
  const PairingResult result = pair_faces(adjacency, std::vector<std::int32_t>(4, 1));
  EXPECT_EQ(result.singletons, 0);
  ASSERT_EQ(result.grids.size(), 2u);
  EXPECT_EQ(result.grids[0].face0, 0);
  EXPECT_EQ(result.grids[0].face1, 1);
}

TEST(Pairing, PrefersAnEqualDepthAndGivesBothTheLarger) {
  RecordProperty("claim", "C42");
  // A closed fan of six: every face has two free neighbours, no set decides, so the depth does.
  const Adjacency adjacency(wheel(6));
  const std::vector<std::int32_t> depth{1, 4, 4, 2, 2, 1};
  const PairingResult with = pair_faces(adjacency, depth);
  EXPECT_EQ(with.depth, depth) << "1-1, 4-4, 2-2";
  EXPECT_EQ(with.singletons, 0);
  const PairingResult without = pair_faces(adjacency, depth, PrintedRules{PairingRule::kCorrected, false});
  EXPECT_EQ(without.singletons, 0);
  EXPECT_EQ(without.depth, (std::vector<std::int32_t>{4, 4, 4, 4, 2, 2}));
}

TEST(Pairing, RefusesDepthsThatDoNotFit) {
  const Adjacency adjacency(octahedron());
  EXPECT_THROW(pair_faces(adjacency, std::vector<std::int32_t>(7, 1)), data::ArgumentError);
  EXPECT_THROW(pair_faces(adjacency, std::vector<std::int32_t>(8, -2)), data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::fast
