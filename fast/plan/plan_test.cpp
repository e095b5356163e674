// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>

#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/plan/depth.h"
#include "fast/plan/pairing.h"
#include "fast/plan/printed_rules.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast {
namespace {

struct Fixture {
  explicit Fixture(data::ControlMesh m, int max_depth = 5)
      : mesh(std::move(m)), adjacency(mesh), heuristics(mesh, adjacency, max_depth) {}
  data::ControlMesh mesh;
  Adjacency adjacency;
  DepthHeuristics heuristics;
};

TEST(Camera, RefusesWhatMakesNoView) {
  const auto refused = [](auto&& change) {
    Camera camera;
    change(camera);
    EXPECT_THROW(camera.validate(), data::ArgumentError);
  };
  EXPECT_NO_THROW(Camera{}.validate());
  refused([](Camera& c) { c.target = c.eye; });
  refused([](Camera& c) { c.up = {0, 0, -3}; });
  refused([](Camera& c) { c.field_of_view = 0; });
  refused([](Camera& c) { c.field_of_view = 180; });
  refused([](Camera& c) { c.field_of_view = NAN; });
  refused([](Camera& c) { c.width = 0; });
  refused([](Camera& c) { c.height = -1; });
  refused([](Camera& c) { c.near = 0; });
  refused([](Camera& c) { c.eye.x = INFINITY; });
}

TEST(Depth, UniformIsUniformAndRandomMeetsEveryDepthAboutEquallyOften) {
  const Fixture f(grid_torus(30, 40));
  DepthOptions options{.strategy = Strategy::kUniform, .depth = 2};
  EXPECT_EQ(f.heuristics.depths(options, {}), std::vector<std::int32_t>(2400, 2));

  options.strategy = Strategy::kRandom;
  options.depth = 5;
  const auto depths = f.heuristics.depths(options, {});
  for (int d = 0; d <= 5; ++d) {
    // 2400 draws, p = 1/6: 400 expected, standard deviation 18; six of them.
    EXPECT_NEAR(static_cast<double>(std::count(depths.begin(), depths.end(), d)), 400, 110);
  }
  EXPECT_EQ(std::count_if(depths.begin(), depths.end(), [](int d) { return d < 0 || d > 5; }), 0);
  EXPECT_EQ(f.heuristics.depths(options, {}), depths) << "the same seed";
  options.seed = 2;
  EXPECT_NE(f.heuristics.depths(options, {}), depths) << "another seed";
}

// A right triangle with legs 3 at distance 10: the centroid is (1,1,0), the farthest corner at sqrt 5. With
// field of view 90 and height 200, f = 100 pixels. 2 r f / (|eye - centroid| - r) = 447.21 / (10 - 2.236)
// = 57.6 pixels.
TEST(Depth, ProjectSphereHalvesThePixelsUntilTheyFit) {
  RecordProperty("claim", "C25");
  const Fixture f({{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {{0, 1, 2}}});
  Camera camera{.eye = {1, 1, 10}, .target = {1, 1, 0}, .field_of_view = 90, .height = 200};
  const auto depth_at = [&](double pixels) {
    const DepthOptions options{.strategy = Strategy::kProjectSphere, .target_pixels = pixels, .cull = false};
    return f.heuristics.depths(options, camera)[0];
  };
  EXPECT_EQ(depth_at(57.7), 0);
  EXPECT_EQ(depth_at(57.5), 1);
  EXPECT_EQ(depth_at(28.85), 1);
  EXPECT_EQ(depth_at(28.75), 2);
  EXPECT_EQ(depth_at(1e-9), 5) << "clamped";
  camera.eye = {1, 1, 1e-3};  // inside the sphere: near counts
  EXPECT_EQ(depth_at(2 * std::sqrt(5.) * 100 / camera.near / 4 * 1.001), 2);
}

TEST(Depth, APlaneNeedsNoSubdivisionAndASharperConeNeverLess) {
  const Fixture plane(wheel(7));
  DepthOptions options;
  options.strategy = Strategy::kCurvature;
  options.angle_front = options.angle_silhouette = .1;
  EXPECT_EQ(plane.heuristics.depths(options, {}), std::vector<std::int32_t>(7, 0));

  const Fixture bumpy(bipyramid(9), kDeepest);
  std::int32_t previous = 0;
  for (const double angle : {90., 60., 30., 15., 7., 3., 1.}) {
    options.angle_front = options.angle_silhouette = angle;
    const auto depths = bumpy.heuristics.depths(options, {});
    const std::int32_t deepest = *std::max_element(depths.begin(), depths.end());
    EXPECT_GE(deepest, previous) << angle;
    previous = deepest;
  }
  EXPECT_GT(previous, 3);
}

TEST(Depth, CombinedIsTheLargerAndCulledStaysCulled) {
  RecordProperty("claim", "C82");
  const Fixture f(grid_torus(9, 16));
  DepthOptions options;
  options.target_pixels = 20;
  options.angle_front = options.angle_silhouette = 20;
  Camera camera{.eye = {5, 2, 3}};
  options.strategy = Strategy::kProjectSphere;
  const auto sphere = f.heuristics.depths(options, camera);
  options.strategy = Strategy::kCurvature;
  const auto cone = f.heuristics.depths(options, camera);
  options.strategy = Strategy::kCombined;
  const auto both = f.heuristics.depths(options, camera);
  const auto facing = f.heuristics.facing(camera);
  std::set<Facing> met;
  for (std::size_t i = 0; i < both.size(); ++i) {
    met.insert(facing[i]);
    EXPECT_EQ(both[i], std::max(sphere[i], cone[i]));
    EXPECT_EQ(both[i] == kCulled, facing[i] == Facing::kBack);
    EXPECT_EQ(sphere[i] == kCulled, facing[i] == Facing::kBack);
    EXPECT_EQ(cone[i] == kCulled, facing[i] == Facing::kBack);
  }
  EXPECT_EQ(met.size(), 3u) << "front, silhouette and back all occur";
}

TEST(Depth, CullingIsAChoiceOfItsOwn) {
  const Fixture f(grid_torus(9, 16));
  const auto facing = f.heuristics.facing(Camera{});
  DepthOptions options;
  for (const Strategy s : {Strategy::kUniform, Strategy::kRandom, Strategy::kCombined}) {
    options.strategy = s;
    for (const bool cull : {false, true}) {
      options.cull = cull;
      const auto depths = f.heuristics.depths(options, {});
      for (std::size_t i = 0; i < depths.size(); ++i) {
        ASSERT_EQ(depths[i] == kCulled, cull && facing[i] == Facing::kBack) << name(s);
      }
    }
  }
}

TEST(Depth, ACustomStrategyIsCalledOncePerFaceInOrderAndClamped) {
  const Fixture f(octahedron());
  std::vector<std::int32_t> calls;
  const DepthOptions options{.strategy = Strategy::kCustom, .custom = [&](std::int32_t face) {
                               calls.push_back(face);
                               return face - 3;
                             }};
  const std::vector<std::int32_t> depths = f.heuristics.depths(options, {});
  EXPECT_EQ(calls, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(depths, (std::vector<std::int32_t>{-1, -1, -1, 0, 1, 2, 3, 4}));
}

TEST(Depth, BadArgumentsAreRefused) {
  const Fixture f(octahedron());
  EXPECT_THROW(DepthHeuristics(f.mesh, f.adjacency, 40), data::ArgumentError);
  EXPECT_THROW(DepthHeuristics(f.mesh, f.adjacency, -1), data::ArgumentError);
  const auto refused = [&](auto&& change) {
    DepthOptions options;
    Camera camera;
    change(options, camera);
    EXPECT_THROW(f.heuristics.depths(options, camera), data::ArgumentError);
  };
  refused([](DepthOptions& o, Camera&) { o.strategy = Strategy::kUniform, o.depth = 6; });
  refused([](DepthOptions& o, Camera&) { o.strategy = Strategy::kUniform, o.depth = -1; });
  refused([](DepthOptions& o, Camera&) { o.target_pixels = 0; });
  refused([](DepthOptions& o, Camera&) { o.target_pixels = NAN; });
  refused([](DepthOptions& o, Camera&) { o.angle_front = 0; });
  refused([](DepthOptions& o, Camera&) { o.angle_back = 181; });
  refused([](DepthOptions& o, Camera&) { o.strategy = Strategy::kCustom; });
  refused([](DepthOptions&, Camera& c) { c.height = 0; });
  EXPECT_THROW(check_depths(std::vector<std::int32_t>{0, 1}, 3, 5), data::ArgumentError);
  EXPECT_THROW(check_depths(std::vector<std::int32_t>{0, -2, 1}, 3, 5), data::ArgumentError);
  EXPECT_THROW(check_depths(std::vector<std::int32_t>{0, 6, 1}, 3, 5), data::ArgumentError);
  EXPECT_NO_THROW(check_depths(std::vector<std::int32_t>{0, -1, 5}, 3, 5));
}

TEST(Depth, EmptyMeshesAndVerticesWithoutFacesAreNoProblem) {
  const Fixture empty{data::ControlMesh{}};
  EXPECT_TRUE(empty.heuristics.depths({}, {}).empty());
  data::ControlMesh mesh = octahedron();
  mesh.positions.push_back({7, 7, 7});
  const Fixture f(mesh);
  EXPECT_EQ(f.heuristics.depths({}, {}).size(), 8u);
  EXPECT_EQ(f.heuristics.degenerate_normals(), 0);
  data::ControlMesh point = single_triangle();
  for (auto& p : point.positions) p = {1, 2, 3};
  EXPECT_EQ(Fixture(point).heuristics.degenerate_normals(), 3) << "vertices of one face count, too";
}

TEST(Depth, MovedPointsGiveWhatTheyGiveToANewOne) {
  for (const data::ControlMesh& mesh : {shaken(grid_torus(6, 7), .2, 1), shaken(grid_sheet(5, 4), .1, 2)}) {
    Fixture moved(mesh);
    moved.heuristics.depths({}, {});  // cones are known
    moved.mesh.positions = shaken(mesh, .3, 3).positions;
    moved.heuristics.points_moved();
    const Fixture fresh(moved.mesh);
    EXPECT_EQ(moved.heuristics.depths({}, {}), fresh.heuristics.depths({}, {}));
    EXPECT_EQ(moved.heuristics.degenerate_normals(), fresh.heuristics.degenerate_normals());
    for (std::int32_t v = 0; v < moved.adjacency.vertex_count(); ++v) {
      EXPECT_EQ(moved.heuristics.limit_position(v), fresh.heuristics.limit_position(v));
      EXPECT_EQ(moved.heuristics.limit_normal(v), fresh.heuristics.limit_normal(v));
    }
  }
}

// Cosines are computed as far as a frame needs them; the next one may need more or less.
TEST(Depth, ConesDoNotDependOnWhatWasAskedBefore) {
  const data::ControlMesh mesh = shaken(grid_torus(6, 7), .2, 1);
  const Fixture used(mesh);
  DepthOptions options{.strategy = Strategy::kCurvature};
  for (const double angle : {60., 5., 20.}) {
    options.angle_front = options.angle_silhouette = options.angle_back = angle;
    for (const bool cull : {true, false}) {
      options.cull = cull;
      EXPECT_EQ(used.heuristics.depths(options, {}), Fixture(mesh).heuristics.depths(options, {})) << angle;
    }
  }
  for (std::int32_t v = 0; v < used.adjacency.vertex_count(); ++v)
    for (const int l : {3, 0, 5})
      EXPECT_EQ(used.heuristics.cone_cosine(v, l), Fixture(mesh).heuristics.cone_cosine(v, l));
}

TEST(Depth, MayBeAskedForByManyTasksAtOnce) {
  const Fixture f(grid_torus(40, 60));
  const auto expected = Fixture(grid_torus(40, 60)).heuristics.depths({}, {});
  std::atomic<int> equal{0};
  tbb::parallel_for(0, 64, [&](int) { equal += f.heuristics.depths({}, {}) == expected; });
  EXPECT_EQ(equal, 64);
}

TEST(Depth, TheNumberOfThreadsChangesNothing) {
  DepthOptions options{.target_pixels = 5};
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return Fixture(grid_torus(40, 60)).heuristics.depths(options, {});
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_EQ(run(1), run(8));
}

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
