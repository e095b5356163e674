// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/surgery.h"
#include "fast/frame/crack_centre.h"
#include "fast/plan/faces.h"
#include "fast/plan/printed_rules.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

TessellatorOptions quads(Repair repair) {
  TessellatorOptions options{.scheme = data::Scheme::kCatmullClark};
  options.cracks.repair = repair;
  options.provenance = true;
  return options;
}

TEST(Sec4_Frame, OpensOnlyWhereCulledFacesBegin) {
  data::ControlMesh mesh = shaken(grid_torus(12, 16), .15, 14);
  Camera camera{.eye = {1, 5, 3}};
  for (const Strategy strategy : {Strategy::kUniform, Strategy::kRandom, Strategy::kProjectSphere,
                                  Strategy::kCurvature, Strategy::kCombined}) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      DepthOptions depth{.strategy = strategy, .cull = true};
      TessellatorOptions options;
      options.cracks.repair = repair;
      Tessellator<float> tessellator(mesh, options);
      DrawList<float> list;
      const FrameStats stats = tessellator.frame(depth, camera, list);
      EXPECT_GT(stats.culled, 0);
      EXPECT_EQ(2 * stats.pairs + stats.singletons + stats.culled, stats.faces);
      const Adjacency& adjacency = tessellator.adjacency();
      const auto& final_depth = tessellator.last_pairing().depth;
      std::int64_t expected = 0;
      for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h)
        if (final_depth[h / 3] >= 0 && final_depth[adjacency.twin(h) / 3] < 0)
          expected += 1 << tessellator.last_plan().edge_depth[h];
      const WeldReport report = weld(triangles_of(list), true);
      EXPECT_EQ(report.open, expected) << name(strategy);
      EXPECT_EQ(report.repeated, 0);
      EXPECT_EQ(report.degenerate, 0);
    }
  }
}

// Coordinates of few bits, so that the mesh can be moved without loss: however far, its normals keep their
// bits.
TEST(Sec4_Frame, KeepsTheBitsOfItsNormalsWhereverTheMeshLies) {
  data::ControlMesh mesh = shaken(grid_torus(4, 5), .15, 13);
  for (auto& p : mesh.positions)
    for (double& x : p) x = std::round(64 * x) / 64;
  const std::vector<std::int32_t> depth(mesh.faces.size(), 3);
  DrawList<float> plain, other;
  const std::array<double, 3> middle = [&] {  // of the box: then the centre of the plain mesh is 0
    std::array<double, 3> low = mesh.positions[0], high = low;
    for (const auto& p : mesh.positions)
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    return std::array{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  }();
  for (auto& p : mesh.positions)
    for (std::size_t i = 0; i < 3; ++i) p[i] -= middle[i];
  Tessellator<float>(mesh).frame(depth, plain);
  for (const double offset : {20., -20., 0x1p30, -0x1p40}) {
    data::ControlMesh moved = mesh;
    for (auto& p : moved.positions)
      for (double& x : p) x += offset;
    Tessellator<float>(moved).frame(depth, other);
    ASSERT_EQ(plain.vertices.size(), other.vertices.size());
    for (std::size_t i = 0; i < plain.vertices.size(); ++i)
      ASSERT_EQ(plain.vertices[i].normal, other.vertices[i].normal) << offset;
  }
}

// A sheet in the plane x = 2^25 + 3, which is no float and no centre: its points are the nearest float.
TEST(Sec4_Frame, RoundsACoordinateOnceThatIsNoFloat) {
  data::ControlMesh mesh = grid_sheet(3, 3);
  for (auto& p : mesh.positions) p = {0x1p25 + 3, p[1], p[0]};
  DrawList<float> list;
  Tessellator<float>(mesh).frame(std::vector<std::int32_t>(mesh.faces.size(), 2), list);
  for (const auto& v : list.vertices) EXPECT_EQ(v.position.x, 0x1p25f + 4);
}

template <class N>
bool same_bits(const SurfaceVertex<N>& a, const SurfaceVertex<N>& b) {
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

/// An edge alone, from both ends, and as top row, left column, diagonal ... of every pair it can be part of.
template <class N>
void expect_one_set_of_bits(const data::ControlMesh& mesh, int depth) {
  const Adjacency adjacency(mesh);
  const PreparedMesh<N> prepared(adjacency, positions_of<N>(mesh));
  EdgeStrip<N> strip(depth, adjacency.max_valence());
  SlidingWindow<N> window(depth, adjacency.max_valence());
  const int k = 1 << depth;
  const auto count = static_cast<std::size_t>(k) + 1;
  std::vector<std::vector<SurfaceVertex<N>>> edge(static_cast<std::size_t>(3 * adjacency.face_count()),
                                                  std::vector<SurfaceVertex<N>>(count));
  for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h)
    strip.evaluate(prepared, h, depth, edge[h].data());
  std::int64_t different = 0;
  const auto expect = [&](std::int32_t h, int t, const SurfaceVertex<N>& got) {
    different += same_bits(edge[h][t], got) ? 0 : 1;
  };
  for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h) {
    const std::int32_t twin = adjacency.twin(h);
    if (twin < 0) continue;
    for (int t = 0; t <= k; ++t) expect(twin, k - t, edge[h][t]);
    window.run(prepared, h, depth, [&](int row, const SurfaceVertex<N>* s) {
      for (int r = row; r <= row + 1; ++r) {
        const auto at = [&](int c) -> const SurfaceVertex<N>& { return s[2 * c + r - row]; };
        expect(Adjacency::prev(h), r, at(0));
        expect(Adjacency::prev(twin), k - r, at(k));
        expect(h, k - r, at(k - r));
        for (int c = 0; c <= k; ++c) {
          if (r == 0) expect(Adjacency::next(h), k - c, at(c));
          if (r == k) expect(Adjacency::next(twin), c, at(c));
        }
      }
    });
  }
  EXPECT_EQ(different, 0);
}

TEST(D14_SharedPoints, HaveTheSameBitsInEveryRole) {
  RecordProperty("claim", "C60 D14");
  for (const auto& mesh : {tetrahedron(), octahedron(), bipyramid(3), bipyramid(7), grid_torus(3, 4),
                           grid_sheet(3, 3), wheel(4, .3), fan(2), fan(6)}) {
    for (int depth = 0; depth <= 4; ++depth) {
      expect_one_set_of_bits<float>(mesh, depth);
      expect_one_set_of_bits<double>(mesh, depth);
    }
  }
}

TEST(Sec5_Plan, AFaceIsAFanIfAnEdgeIsDeeperThanItself) {
  const Adjacency adjacency(grid_torus(4, 4));
  std::vector<std::int32_t> depth(32, 2);
  depth[5] = 4;
  depth[6] = -1;
  const CrackPlan plan = plan_cracks(LoopFaces{&adjacency}, depth, {});
  EXPECT_EQ(plan.fans, 3 - (adjacency.neighbour(5, 0) == 6 || adjacency.neighbour(5, 1) == 6 ||
                                    adjacency.neighbour(5, 2) == 6
                                ? 1
                                : 0));
  for (std::int32_t f = 0; f < 32; ++f) {
    for (int k = 0; k < 3; ++k) {
      const int got = plan.edge_depth[3 * f + k];
      const std::int32_t g = adjacency.neighbour(f, k);
      const int other = depth[g] < 0 ? -1 : depth[g];
      const int own = depth[f];
      EXPECT_EQ(got, own < 0 ? -1 : std::max(own, other));
    }
  }
  EXPECT_THROW(plan_cracks(LoopFaces{&adjacency}, std::vector<std::int32_t>(3), {}), data::ArgumentError);
}

TEST(Sec5_Plan, AFaceIsStitchedFromDepthTwoOn) {
  const Adjacency adjacency(grid_torus(4, 4));
  CrackOptions options{.repair = Repair::kStitch};
  for (const std::int32_t own : {0, 1, 2, 3}) {
    std::vector<std::int32_t> depth(32, own);
    depth[5] = own + 2;
    const CrackPlan plan = plan_cracks(LoopFaces{&adjacency}, depth, options);
    EXPECT_EQ(plan.stitched, own >= 2 ? 3 : 0) << own;
    EXPECT_EQ(plan.fans, own >= 2 ? 0 : 3) << own;
  }
}

void expect_the_same_by_threads(const data::ControlMesh& mesh, TessellatorOptions options) {
  const auto depth = random_depths(mesh.faces.size(), -1, 4, 1);
  std::vector<DrawList<float>> lists;
  std::vector<IndexedMesh<float>> meshes;
  options.provenance = true;
  for (const int threads : {1, 2, 8}) {
    options.threads = threads;
    Tessellator<float> tessellator(mesh, options);
    for (int again = 0; again < 2; ++again) {
      tessellator.frame(depth, lists.emplace_back());
      tessellator.frame(depth, meshes.emplace_back());
    }
  }
  for (std::size_t i = 1; i < lists.size(); ++i) {
    EXPECT_EQ(lists[i].vertices, lists[0].vertices);
    EXPECT_EQ(lists[i].provenance, lists[0].provenance);
    EXPECT_EQ(std::memcmp(lists[i].draws.data(), lists[0].draws.data(), lists[0].draws.size() * sizeof(Draw)),
              0);
    EXPECT_EQ(meshes[i].vertices, meshes[0].vertices);
    EXPECT_EQ(meshes[i].triangles, meshes[0].triangles);
    EXPECT_EQ(meshes[i].provenance, meshes[0].provenance);
  }
}

TEST(Sec5_Frame, DoesNotDependOnTheNumberOfThreads) {
  expect_the_same_by_threads(shaken(grid_torus(20, 30), .05, 3), {});
  expect_the_same_by_threads(data::mixed_mesh(3), quads(Repair::kStitch));
}

TEST(QuadFrame, CullsAndCountsFaces) {
  const auto mesh = data::quad_torus(6, 8);
  Tessellator<float> tessellator(mesh, quads(Repair::kFan));
  EXPECT_EQ(tessellator.face_count(), 48);
  std::vector<std::int32_t> depth(48, 2);
  depth[5] = -1;
  IndexedMesh<float> out;
  const FrameStats stats = tessellator.frame(depth, out);
  EXPECT_EQ(stats.culled, 1);
  EXPECT_EQ(stats.pairs, 47) << "a quad is a pair of itself";
  EXPECT_EQ(stats.singletons, 0);
  EXPECT_EQ(stats.strips, 47 * 4);
  EXPECT_EQ(stats.limit_points, 47 * 25);
  EXPECT_EQ(stats.triangles, 47 * 32);
  EXPECT_EQ(weld(triangles_of(out), true).boundary_loops, 1) << "a hole where the face was";
  EXPECT_THROW(tessellator.adjacency(), data::ArgumentError);
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(47, 1), out), data::ArgumentError);
}

TEST(QuadFrame, DepthsFollowTheView) {
  for (const auto& mesh : {data::pawn(12), data::mixed_pawn(12)}) {
    Tessellator<float> tessellator(mesh, quads(Repair::kFan));
    DepthOptions options;
    Camera camera{.eye = {9, 2, 3}};
    IndexedMesh<float> out;
    std::int64_t coarse = 0;
    for (const double angle : {60., 20., 5.}) {
      options.angle_front = options.angle_silhouette = options.angle_back = angle;
      const FrameStats stats = tessellator.frame(options, camera, out);
      EXPECT_GT(stats.culled, stats.faces / 4) << "about half look away";
      EXPECT_LT(stats.culled, 3 * stats.faces / 4);
      EXPECT_GT(stats.triangles, coarse) << "a smaller angle asks for more";
      coarse = stats.triangles;
    }
    options.strategy = Strategy::kProjectSphere;
    options.target_pixels = 20;
    const auto near = tessellator.frame(options, camera, out).triangles;
    camera.eye = {90, 20, 30};
    EXPECT_LT(tessellator.frame(options, camera, out).triangles, near) << "from afar";
  }
  // A flat sheet needs no depth, whatever its faces.
  auto flat = data::quad_wheel(5, 1);
  for (auto& p : flat.positions) p[2] = 0;
  Tessellator<float> tessellator(flat, quads(Repair::kFan));
  DepthOptions options{.strategy = Strategy::kCurvature, .cull = false};
  IndexedMesh<float> out;
  tessellator.frame(options, Camera{}, out);
  for (const std::int32_t d : tessellator.last_pairing().depth) EXPECT_EQ(d, 0);
}

// Collapsed meshes get finite unit normals, and are counted. [D12]
TEST(QuadFrame, DegenerateMeshesHaveUnitNormals) {
  for (const int flat : {0, 1, 2, 3}) {
    auto mesh = data::quad_wheel(5, 1);
    for (auto& p : mesh.positions)
      for (int axis = 0; axis < flat; ++axis) p[2 - axis] = 0;
    Tessellator<float> tessellator(mesh, quads(Repair::kFan));
    DrawList<float> out;
    const FrameStats stats = tessellator.frame(std::vector<std::int32_t>(mesh.faces.size(), 3), out);
    EXPECT_EQ(stats.zero_normals > 0, flat >= 2) << "of " << flat << " flat axes";
    for (const auto& v : out.vertices) ASSERT_NEAR(dot(v.normal, v.normal), 1, 1e-6);
  }
}

}  // namespace
}  // namespace limitcheck::fast
