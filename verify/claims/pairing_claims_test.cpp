// SPDX-License-Identifier: MIT
// Section 4.2: the greedy pairing, as corrected and as printed. [C35-C42]
// Sections 4 and 4.3: what pairs gain, and what faces without a partner cost. [C88, C89]
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "fast/plan/pairing.h"
#include "fast/plan/printed_rules.h"
#include "fast/window/tessellator.h"
#include "verify/claims/test_support/figures.h"
#include "verify/claims/test_support/pairing_oracle.h"
#include "verify/claims/test_support/scene.h"

namespace limitcheck::verify {
namespace {

using fast::PairingRule;
using fast::Strategy;

struct PairingScene : Scene {
  using Scene::Scene;

  std::vector<std::int32_t> depths(Strategy strategy, bool cull = false, std::uint64_t seed = 1) const {
    fast::DepthOptions options{
        .strategy = strategy, .depth = strategy == Strategy::kRandom ? 5 : 3, .seed = seed, .cull = cull};
    return heuristics.depths(options, {});
  }
  fast::PairingResult pair(const std::vector<std::int32_t>& depth, PairingRule rule,
                           bool prefer = true) const {
    return fast::pair_faces(adjacency, depth, fast::PrintedRules{rule, prefer});
  }
};

constexpr int kSeeds = 10;
constexpr int kSizes[] = {200, 800, 2000, 4000};

TEST(Sec42_Pairing, AClosedMeshAlwaysHasAPairingWithoutSingletons) {
  for (const int faces : {200, 800, 2000}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const PairingScene scene(faces, seed);
      EXPECT_EQ(fewest_singletons(scene.adjacency, scene.depths(Strategy::kUniform)), 0)
          << faces << " seed " << seed;
    }
  }
}

// Random sets of free faces of every density: each of them is a state that some history could leave.
TEST(Sec42_PrioritySets, PartitionTheFreeFacesOnlyAsAGreatestFixpoint) {
  const PairingScene scene(400, 1);
  std::int64_t two_free = 0, without_set = 0, beside_s2 = 0;
  for (int percent = 50; percent <= 100; percent += 5) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      data::SplitMix64 random(1000 * seed + static_cast<std::uint64_t>(percent));
      std::vector<bool> free(400);
      for (std::size_t f = 0; f < free.size(); ++f)
        free[f] = random.next() % 100 < static_cast<std::uint64_t>(percent);
      const auto greatest = sets_by_definition(scene.adjacency, free);
      const auto least = sets_by_least_fixpoint(scene.adjacency, free);
      for (std::int32_t f = 0; f < 400; ++f) {
        ASSERT_NE(greatest[f], -2) << "face " << f << " is in no set";
        without_set += least[f] == -2;
        if (greatest[f] != 1 && greatest[f] != 2) continue;
        ++two_free;
        // The closed form: at least one free neighbour with fewer than three.
        bool fewer = false;
        for (int k = 0; k < 3; ++k) {
          const std::int32_t g = scene.adjacency.neighbour(f, k);
          fewer = fewer || (free[g] && greatest[g] != 3);
          beside_s2 += free[g] && greatest[g] == 2;
        }
        ASSERT_EQ(greatest[f] == 1, fewer) << "face " << f;
      }
    }
  }
  EXPECT_GT(two_free, 1000);
  EXPECT_GT(without_set, 0) << "as a least fixpoint the definitions leave faces without a set";
  EXPECT_EQ(beside_s2, 0) << "a face with two free neighbours is never beside one of S2";
  record("{}", without_set, "faces_without_set_as_least_fixpoint");
}

TEST(Sec42_Boundaries, TrianglesMayHaveOneOrTwoNeighboursButVerticesNeverHaveFewerThanTwo) {
  const PairingScene scene(data::wheel(6, 3));
  std::vector<int> with(4, 0);
  for (std::int32_t f = 0; f < scene.adjacency.face_count(); ++f) {
    int neighbours = 0;
    for (int k = 0; k < 3; ++k) neighbours += scene.adjacency.neighbour(f, k) >= 0;
    ++with[neighbours];
  }
  EXPECT_GT(with[2], 0);
  EXPECT_GT(with[3], 0);
  for (std::int32_t v = 0; v < scene.adjacency.vertex_count(); ++v) EXPECT_GE(scene.adjacency.valence(v), 2);
}

// "While S0 .. S3 are not empty", taken at its word, would stop at once: in a closed mesh three of them are.
TEST(Sec42_Loop, RunsWhileNotAllSetsAreEmptyAndEndsWithinAsManyRoundsAsFaces) {
  const PairingScene scene(800, 1);
  const auto set = sets_by_definition(scene.adjacency, std::vector<bool>(800, true));
  EXPECT_EQ(std::count(set.begin(), set.end(), 3), 800) << "S0, S1 and S2 are empty in the beginning";
  for (const PairingRule rule : {PairingRule::kCorrected, PairingRule::kPrinted}) {
    const auto result = scene.pair(scene.depths(Strategy::kRandom), rule);
    EXPECT_LE(result.grids.size(), 800u);
    EXPECT_EQ(2 * result.pair_count + result.singletons, 800) << "each face is taken exactly once";
  }
}

// The judge knows no queues: it computes all sets anew before every round.
TEST(Sec42_Step3, InTheCorrectedOrderTheSetsAreAlwaysThoseOfTheirDefinitions) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PairingScene scene(400, seed);
    for (const auto& depth : {scene.depths(Strategy::kUniform), scene.depths(Strategy::kRandom),
                              scene.depths(Strategy::kCombined), scene.depths(Strategy::kCombined, true)}) {
      EXPECT_EQ(first_violation(scene.adjacency, depth, scene.pair(depth, PairingRule::kCorrected)), "");
    }
  }
}

TEST(Sec42_Step3, InThePrintedOrderTheyAreNot) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PairingScene scene(400, seed);
    const auto depth = scene.depths(Strategy::kUniform);
    EXPECT_NE(first_violation(scene.adjacency, depth, scene.pair(depth, PairingRule::kPrinted)), "");
  }
}

// And the printed order is kept where it is asked for: the judge goes over all faces after each pair. Open
// meshes and culled faces, because in a closed mesh S2 is empty in the beginning and stays so.
TEST(Sec42_Step3, IsCarriedOutAsPrintedWhereThatIsAskedFor) {
  for (const PairingScene& scene :
       {PairingScene(400, 1), PairingScene(400, 2), PairingScene(data::wheel(6, 3)),
        PairingScene(data::holes()), PairingScene(data::wheel(7, 6))})
    for (const auto& depth : {scene.depths(Strategy::kUniform), scene.depths(Strategy::kRandom),
                              scene.depths(Strategy::kCombined), scene.depths(Strategy::kCombined, true)})
      EXPECT_EQ(first_violation(scene.adjacency, depth, scene.pair(depth, PairingRule::kPrinted),
                                PairingRule::kPrinted),
                "");
}

// A face beside both members of a pair, as at a vertex of valence three, falls from S3 to S0 at once.
TEST(Sec42_Step3, AFaceBesideBothMembersGoesFromS3ToS0) {
  std::int64_t cases = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const PairingScene scene(800, seed);
    const auto depth = scene.depths(Strategy::kUniform);
    const auto result = scene.pair(depth, PairingRule::kCorrected);
    std::vector<bool> free(800, true);
    for (const fast::Grid& pair : result.grids) {
      const auto before = sets_by_definition(scene.adjacency, free);
      free[pair.face0] = false;
      if (!pair.singleton()) free[pair.face1] = false;
      const auto after = sets_by_definition(scene.adjacency, free);
      for (std::int32_t f = 0; f < 800 && !pair.singleton(); ++f) {
        bool beside0 = false, beside1 = false;
        for (int k = 0; k < 3; ++k) {
          beside0 = beside0 || scene.adjacency.neighbour(f, k) == pair.face0;
          beside1 = beside1 || scene.adjacency.neighbour(f, k) == pair.face1;
        }
        if (!free[f] || !beside0 || !beside1 || before[f] != 3) continue;
        ++cases;
        EXPECT_EQ(after[f], 0);
      }
    }
  }
  EXPECT_GT(cases, 0);
}

// Shares over ten seeds per size. What is asserted is far from what is seen:
// the standard error of a mean is about a tenth of it at 4000 faces; at 200 one pair of singletons more or
// less is a whole percent of one mesh.
TEST(Sec42_Singletons, AreUnderOnePercentWithTheCorrectedRuleAndTwiceAsManyAndMoreWithThePrintedOne) {
  for (const int faces : kSizes) {
    for (const auto& [name, strategy] :
         {std::pair{"uniform", Strategy::kUniform}, std::pair{"random", Strategy::kRandom},
          std::pair{"view", Strategy::kCombined}}) {
      double corrected = 0, printed = 0;
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const PairingScene scene(faces, seed);
        const auto depth = scene.depths(strategy, false, seed);
        corrected += static_cast<double>(scene.pair(depth, PairingRule::kCorrected).singletons);
        printed += static_cast<double>(scene.pair(depth, PairingRule::kPrinted).singletons);
      }
      const double percent = 100. / (faces * kSeeds);
      const std::string key = fmt::format("{}_{}", name, faces);
      record("{:.2f}", percent * corrected, "percent_corrected_{}", key);
      record("{:.2f}", percent * printed, "percent_printed_{}", key);
      EXPECT_LE(percent * corrected, faces == 200 ? 1.2 : .7) << key;
      EXPECT_GE(percent * printed, 1.0) << key;
      EXPECT_LE(percent * printed, 3.0) << key;
      EXPECT_GE(printed, 2 * corrected) << key;
      if (strategy == Strategy::kCombined) {  // "about one percent" is taken for what rounds to one or two
        EXPECT_LT(percent * printed, 2.5) << key;
      }
    }
  }
}

// Culled faces left out, the rest has holes and an optimum
// above zero. Shares of all faces and of the visible ones.
TEST(Sec42_Singletons, WithoutTheCulledFacesStayNearTheOptimumOfAMaximumMatching) {
  for (const int faces : kSizes) {
    double corrected = 0, printed = 0, optimum = 0, visible = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const PairingScene scene(faces, seed);
      const auto depth = scene.depths(Strategy::kCombined, true);
      const auto result = scene.pair(depth, PairingRule::kCorrected);
      const auto best = fewest_singletons(scene.adjacency, depth);
      ASSERT_GE(best, 0);
      ASSERT_GE(result.singletons, best) << "fewer than the optimum";
      corrected += static_cast<double>(result.singletons);
      printed += static_cast<double>(scene.pair(depth, PairingRule::kPrinted).singletons);
      optimum += static_cast<double>(best);
      visible += static_cast<double>(faces - result.culled);
    }
    const std::string key = std::to_string(faces);
    record("{:.2f}", 100 * corrected / visible, "percent_of_visible_corrected_{}", key);
    record("{:.2f}", 100 * printed / visible, "percent_of_visible_printed_{}", key);
    record("{:.2f}", 100 * optimum / visible, "percent_of_visible_optimum_{}", key);
    record("{:.2f}", 100 * corrected / (faces * kSeeds), "percent_of_all_corrected_{}", key);
    EXPECT_LE(100 * (corrected - optimum) / visible, 1.6) << key << ": more than the optimum";
    EXPECT_GT(printed, corrected) << key;
  }
}

double triangles(const std::vector<std::int32_t>& depth) {
  double sum = 0;
  for (const std::int32_t d : depth) sum += d < 0 ? 0 : std::pow(4., d);
  return sum;
}

TEST(Sec42_Depths, BothMembersGetTheLargerAndEqualOnesArePreferred) {
  for (const int faces : {200, 800, 4000}) {
    const PairingScene scene(faces, 1);
    const std::string key = fmt::format("_{}", faces);
    for (const auto& depth : {scene.depths(Strategy::kRandom), scene.depths(Strategy::kCombined, true)}) {
      const auto result = scene.pair(depth, PairingRule::kCorrected);
      std::vector<std::int32_t> expected(depth.begin(), depth.end());
      for (const fast::Grid& pair : result.grids) {
        if (!pair.singleton())
          expected[pair.face0] = expected[pair.face1] = std::max(depth[pair.face0], depth[pair.face1]);
      }
      EXPECT_EQ(result.depth, expected);
    }
    const auto random = scene.depths(Strategy::kRandom);
    const double with = triangles(scene.pair(random, PairingRule::kCorrected).depth) / triangles(random);
    const double without =
        triangles(scene.pair(random, PairingRule::kCorrected, false).depth) / triangles(random);
    record("{:.2f}", with, "triangles_random{}", key);
    record("{:.2f}", without, "triangles_random_without_preference{}", key);
    EXPECT_LT(with, without) << faces;
    const auto view = scene.depths(Strategy::kCombined, true);
    const double view_cost = triangles(scene.pair(view, PairingRule::kCorrected).depth) / triangles(view);
    record("{:.2f}", view_cost, "triangles_view{}", key);
    EXPECT_LT(view_cost, with) << "neighbours have similar depths in a view";
    EXPECT_GE(view_cost, 1);
  }
}

// Were culled faces to take part with depth -1 they would be drawn with their partners. They do not.
TEST(Sec42_Depths, CulledFacesTakingPartWouldBeRevived) {
  for (const int faces : {200, 800, 4000}) {
    const PairingScene scene(faces, 1);
    auto depth = scene.depths(Strategy::kCombined, true);
    const auto ours = scene.pair(depth, PairingRule::kCorrected);
    const auto culled = std::count(depth.begin(), depth.end(), fast::kCulled);
    EXPECT_EQ(std::count(ours.depth.begin(), ours.depth.end(), fast::kCulled), culled) << "none revived";
    for (std::int32_t& d : depth) ++d;  // now every face takes part, the culled ones as the shallowest
    const auto all = scene.pair(depth, PairingRule::kCorrected);
    const auto revived = culled - std::count(all.depth.begin(), all.depth.end(), 0);
    record("{:.2f}", 100. * static_cast<double>(revived) / static_cast<double>(culled), "percent_revived_{}",
           faces);
    EXPECT_GT(revived, 0);
  }
}

/// Of a mesh at one depth: what its frame takes for each triangle that it draws.
struct PerTriangle {
  double points, vertices, strips;
};
PerTriangle per_triangle(const data::ControlMesh& mesh, int depth) {
  fast::Tessellator<float> engine(mesh);
  fast::DrawList<float> out;
  const auto stats = engine.frame(std::vector<std::int32_t>(mesh.faces.size(), depth), out);
  const auto all = static_cast<double>(stats.triangles);
  return {static_cast<double>(stats.limit_points) / all, static_cast<double>(stats.vertices) / all,
          static_cast<double>(stats.strips) / all};
}

// "Subdividing a pair of adjacent triangles at a time is more efficient": the same faces in pairs, and cut apart so
// that each is alone.
TEST(Sec4_Pairs, TakeFewerPointsVerticesAndStripsThanTrianglesAlone) {
  const auto mesh = data::bumpy_sphere(200, 1);
  data::ControlMesh apart;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto at = static_cast<std::int32_t>(apart.positions.size());
    for (const std::int32_t v : mesh.faces[f]) apart.positions.push_back(mesh.positions[v]);
    apart.faces.push_back({at, at + 1, at + 2});
  }
  for (const int depth : {3, 5}) {
    const PerTriangle pairs = per_triangle(mesh, depth), alone = per_triangle(apart, depth);
    const auto note = [&](const char* what, double ratio) {
      record("{:.2f}", ratio, "{}_of_pairs_over_alone_at_depth_{}", what, depth);
      EXPECT_LT(ratio, 1) << what << " " << depth;
    };
    note("points", pairs.points / alone.points);
    note("vertices", pairs.vertices / alone.vertices);
    note("strips", pairs.strips / alone.strips);
  }
}

// "As typically only few of them exist, this doesn't introduce a performance problem": points beyond the diagonal of
// faces without partner, which are evaluated and not shown, of all points. A problem would be what shows in times, from
// some per cent on.
TEST(Sec43_DummyPartners, AreAboutOneInAHundredPoints) {
  for (const int faces : {200, 800, 2000, 4000}) {
    const auto mesh = data::bumpy_sphere(faces, 1);
    fast::Tessellator<float> engine(mesh);
    for (const fast::Strategy strategy : {fast::Strategy::kUniform, fast::Strategy::kCombined}) {
      fast::DrawList<float> out;
      engine.frame(fast::DepthOptions{.strategy = strategy}, fast::Camera{}, out);
      double wasted = 0, all = 0;
      for (const fast::Grid& grid : engine.last_pairing().grids) {
        const double steps = std::ldexp(1., grid.depth), points = (steps + 1) * (steps + 1);
        all += points;
        if (grid.face1 < 0) wasted += steps * (steps + 1) / 2;
      }
      const double percent = 100 * wasted / all;
      record("{:.2f}", percent, "percent_of_points_of_dummies_{}_{}",
             strategy == fast::Strategy::kUniform ? "uniform" : "combined", faces);
      EXPECT_LT(percent, 2) << faces;
    }
  }
}

}  // namespace
}  // namespace limitcheck::verify
