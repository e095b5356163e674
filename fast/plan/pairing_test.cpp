// SPDX-License-Identifier: MIT
#include "fast/plan/pairing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast {
namespace {

// What any result must be, whatever the choices: a partition
// of the visible faces into neighbours and leftovers.
void expect_partition(const data::ControlMesh& mesh, const std::vector<std::int32_t>& depth,
                      PairingOptions options) {
  const Adjacency adjacency(mesh);
  const PairingResult result = pair_faces(adjacency, depth, options);
  ASSERT_EQ(result.depth.size(), depth.size());
  std::vector<int> used(depth.size(), 0);
  std::int64_t singletons = 0;
  for (const Pair& pair : result.pairs) {
    ++used[pair.face0];
    if (pair.singleton()) {
      ++singletons;
      ASSERT_EQ(pair.depth, depth[pair.face0]);
      bool lonely = true;
      for (int k = 0; k < 3; ++k) lonely = lonely && adjacency.neighbour(pair.face0, k) < 0;
      ASSERT_EQ(pair.edge0 < 0, lonely) << "a dummy exists if any neighbour does";
    } else {
      ++used[pair.face1];
      ASSERT_EQ(pair.depth, std::max(depth[pair.face0], depth[pair.face1]));
      ASSERT_EQ(result.depth[pair.face1], pair.depth);
      ASSERT_EQ(adjacency.neighbour(pair.face0, pair.edge0), pair.face1);
    }
    ASSERT_EQ(result.depth[pair.face0], pair.depth);
    if (pair.edge0 >= 0) {
      const std::int32_t h = adjacency.twin(3 * pair.face0 + pair.edge0);
      ASSERT_GE(h, 0);
      ASSERT_EQ(h % 3, pair.edge1);
    } else {
      ASSERT_EQ(pair.edge1, -1);
    }
  }
  for (std::size_t f = 0; f < depth.size(); ++f) ASSERT_EQ(used[f], depth[f] < 0 ? 0 : 1) << "face " << f;
  ASSERT_EQ(result.singletons, singletons);
  ASSERT_EQ(result.pair_count + result.singletons, static_cast<std::int64_t>(result.pairs.size()));
  ASSERT_EQ(result.culled, std::count(depth.begin(), depth.end(), -1));
  // No two singletons are neighbours.
  for (const Pair& pair : result.pairs) {
    for (int k = 0; pair.singleton() && k < 3; ++k) {
      const std::int32_t g = adjacency.neighbour(pair.face0, k);
      for (const Pair& other : result.pairs) ASSERT_FALSE(g >= 0 && other.singleton() && other.face0 == g);
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
          std::vector<std::int32_t> depth(mesh.triangles.size(), 2);
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
  ASSERT_EQ(result.pairs.size(), 1u);
  EXPECT_EQ(result.pairs[0], (Pair{0, -1, -1, -1, 3}));
}

TEST(Pairing, ASingletonMayUseACulledNeighbourAsDummy) {
  const data::ControlMesh mesh = octahedron();
  const Adjacency adjacency(mesh);
  std::vector<std::int32_t> depth(8, -1);
  depth[5] = 2;
  const PairingResult result = pair_faces(adjacency, depth);
  ASSERT_EQ(result.pairs.size(), 1u);
  EXPECT_EQ(result.pairs[0].face0, 5);
  EXPECT_TRUE(result.pairs[0].singleton());
  EXPECT_EQ(result.pairs[0].edge0, 0);
  EXPECT_EQ(result.culled, 7);
  EXPECT_EQ(result.depth, depth) << "nothing culled comes back";
}

// A strip of four triangles: only pairing from the ends leaves none over. S0 first does that.
TEST(Pairing, StartsWhereThereIsTheLeastChoice) {
  const Adjacency adjacency(fan(4));
  const PairingResult result = pair_faces(adjacency, std::vector<std::int32_t>(4, 1));
  EXPECT_EQ(result.singletons, 0);
  ASSERT_EQ(result.pairs.size(), 2u);
  EXPECT_EQ(result.pairs[0].face0, 0);
  EXPECT_EQ(result.pairs[0].face1, 1);
}

TEST(Pairing, PrefersAnEqualDepthAndGivesBothTheLarger) {
  RecordProperty("claim", "C42");
  // A closed fan of six: every face has two free neighbours, no set decides, so the depth does.
  const Adjacency adjacency(wheel(6));
  const std::vector<std::int32_t> depth{1, 4, 4, 2, 2, 1};
  const PairingResult with = pair_faces(adjacency, depth);
  EXPECT_EQ(with.depth, depth) << "1-1, 4-4, 2-2";
  EXPECT_EQ(with.singletons, 0);
  const PairingResult without = pair_faces(adjacency, depth, {PairingRule::kCorrected, false});
  EXPECT_EQ(without.singletons, 0);
  EXPECT_EQ(without.depth, (std::vector<std::int32_t>{4, 4, 4, 4, 2, 2}));
}

TEST(Pairing, RefusesDepthsThatDoNotFit) {
  const Adjacency adjacency(octahedron());
  EXPECT_THROW(pair_faces(adjacency, std::vector<std::int32_t>(7, 1)), std::invalid_argument);
  EXPECT_THROW(pair_faces(adjacency, std::vector<std::int32_t>(8, -2)), std::invalid_argument);
}

}  // namespace
}  // namespace limitcheck::fast
