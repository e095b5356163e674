// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/frame/crack_centre.h"
#include "fast/frame/patch.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

struct Shape {
  const char* name;
  data::ControlMesh mesh;
  int boundary_loops;
};

std::vector<Shape> shapes() {
  return {{"tetrahedron", tetrahedron(), 0},
          {"octahedron", octahedron(), 0},
          {"shaken tetrahedron", shaken(tetrahedron(), .15, 1), 0},
          {"shaken bipyramid 3", shaken(bipyramid(3), .15, 2), 0},
          {"shaken bipyramid 9", shaken(bipyramid(9), .15, 3), 0},
          {"torus", grid_torus(3, 5), 0},
          {"shaken torus", shaken(grid_torus(4, 4), .15, 4), 0},
          {"sheet", grid_sheet(2, 3), 1},
          {"shaken sheet", shaken(grid_sheet(3, 3), .15, 5), 1},
          {"wheel 3", shaken(wheel(3), .15, 6), 1},
          {"wheel 8", shaken(wheel(8), .15, 7), 1},
          {"fan 2", shaken(fan(2), .15, 8), 1},
          {"fan 5", shaken(fan(5), .15, 9), 1},
          {"single triangle", shaken(single_triangle(), .15, 10), 1}};
}

TEST(Sec5_Frame, EveryPointLiesWhereItsProvenanceSays) {
  for (const auto& [name, mesh, loops] : shapes()) {
    data::SplitMix64 random(11);
    const RefinedLevels exact = RefinedLevels::loop(mesh, 3);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      TessellatorOptions options{.provenance = true};
      options.cracks.repair = repair;
      Tessellator<double> tessellator(mesh, options);
      for (int round = 0; round < 6; ++round) {
        const auto depth = random_depths(mesh.faces.size(), round % 2 == 0 ? 0 : -1, 3, random);
        DrawList<double> list;
        const FrameStats stats = tessellator.frame(depth, list);
        expect_on_the_limit(exact, list, 1e-14, name, 1e-12);
        IndexedMesh<double> indexed;
        const FrameStats again = tessellator.frame(depth, indexed);
        expect_on_the_limit(exact, indexed, 1e-14, name, 1e-12);
        EXPECT_EQ(stats.triangles, again.triangles);
        EXPECT_EQ(static_cast<std::size_t>(stats.triangles), indexed.triangles.size());
        EXPECT_EQ(static_cast<std::size_t>(stats.triangles), triangles_of(list).size());
      }
    }
  }
}

template <class Real>
void expect_watertight(int rounds, int deepest) {
  for (const auto& [name, mesh, loops] : shapes()) {
    data::SplitMix64 random(12);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      TessellatorOptions options;
      options.cracks.repair = repair;
      options.threads = 1;
      Tessellator<Real> tessellator(mesh, options);
      DrawList<Real> list;
      IndexedMesh<Real> indexed;
      for (int round = 0; round < rounds; ++round) {
        const auto depth = random_depths(mesh.faces.size(), 0, deepest, random);
        tessellator.frame(depth, list);
        tessellator.frame(depth, indexed);
        for (const auto& report : {weld(triangles_of(list), true), weld(triangles_of(indexed), true)}) {
          EXPECT_EQ(report.repeated, 0) << name;
          EXPECT_EQ(report.degenerate, 0) << name;
          EXPECT_EQ(report.boundary_loops, loops) << name;
          EXPECT_EQ(report.open == 0, loops == 0) << name;
        }
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(Sec5_Frame, IsWatertightBitByBitWithNormalsInFloat) {
  expect_watertight<float>(40, 3);
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

TEST(Sec4_Frame, KeepsItsNormalsAtAnyScaleAndFarFromTheOrigin) {
  const data::ControlMesh mesh = shaken(grid_torus(4, 5), .15, 13);
  const std::vector<std::int32_t> depth(mesh.faces.size(), 3);
  DrawList<float> plain, other;
  Tessellator<float>(mesh).frame(depth, plain);
  for (const int exponent : {-60, -20, 20, 60}) {
    data::ControlMesh scaled = mesh;
    for (auto& p : scaled.positions)
      for (double& x : p) x = std::ldexp(x, exponent);
    Tessellator<float>(scaled).frame(depth, other);
    for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
      ASSERT_EQ(plain.vertices[i].normal, other.vertices[i].normal) << exponent;
      ASSERT_EQ(std::ldexp(plain.vertices[i].position.x, exponent), other.vertices[i].position.x) << exponent;
    }
  }
  // moved by 1024, the control points lose digits when they are rounded; nothing more is lost afterwards
  data::ControlMesh moved = mesh, rounded = mesh;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      moved.positions[i][k] = static_cast<float>(mesh.positions[i][k] + 1024);
      rounded.positions[i][k] = moved.positions[i][k] - 1024;
    }
  }
  Tessellator<float>(moved).frame(depth, other);
  Tessellator<float>(rounded).frame(depth, plain);
  for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
    const auto d = plain.vertices[i].normal - other.vertices[i].normal;
    ASSERT_LE(dot(d, d), 1e-9f);
    ASSERT_NEAR(plain.vertices[i].position.x + 1024, other.vertices[i].position.x, 1e-4);
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

TEST(Sec5_Frame, IsWatertightBitByBitWithNormalsInDouble) {
  expect_watertight<double>(10, 4);
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
  const CrackPlan plan = plan_cracks(adjacency, depth);
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
  EXPECT_THROW(plan_cracks(adjacency, std::vector<std::int32_t>(3)), data::ArgumentError);
}

TEST(Sec5_Plan, AFaceIsStitchedFromDepthTwoOn) {
  const Adjacency adjacency(grid_torus(4, 4));
  CrackOptions options{.repair = Repair::kStitch};
  for (const std::int32_t own : {0, 1, 2, 3}) {
    std::vector<std::int32_t> depth(32, own);
    depth[5] = own + 2;
    const CrackPlan plan = plan_cracks(adjacency, depth, options);
    EXPECT_EQ(plan.stitched, own >= 2 ? 3 : 0) << own;
    EXPECT_EQ(plan.fans, own >= 2 ? 0 : 3) << own;
  }
}

TEST(Sec5_Stitch, MakesTheRingOfTrianglesItAnnounces) {
  for (int depth = 2; depth <= 6; ++depth) {
    for (int edge = depth; edge <= 8; ++edge) {
      const int k = 1 << depth;
      std::int64_t triangles = 0, outer = 0, inner = 0;
      stitch_rows(k, edge, 3, [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
        ++triangles;
        EXPECT_FALSE(ai);
        EXPECT_TRUE(ci);
        EXPECT_EQ(a, outer);
        EXPECT_EQ(c, inner);
        EXPECT_EQ(b, bi ? ++inner : ++outer);
      });
      EXPECT_EQ(outer, 1 << edge);
      EXPECT_EQ(inner, k - 3);
      EXPECT_EQ(triangles, (std::int64_t{1} << edge) + k - 3);
    }
  }
}

TEST(Sec5_Frame, DoesNotDependOnTheNumberOfThreads) {
  data::ControlMesh mesh = grid_torus(20, 30);
  for (auto& p : mesh.positions) p[2] += .05 * std::sin(9 * p[0]);
  std::vector<std::int32_t> depth;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    depth.push_back(static_cast<std::int32_t>(f * f % 6) - 1);
  std::vector<DrawList<float>> lists;
  std::vector<IndexedMesh<float>> meshes;
  for (const int threads : {1, 2, 8}) {
    TessellatorOptions options{.threads = threads, .provenance = true};
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

TEST(Sec4_Sinks, OnTheFlyDeliversTheSameAsTheWholeList) {
  TessellatorOptions options{.provenance = true};
  Tessellator<float> tessellator(grid_torus(32, 40), options);
  expect_a_sink_gets_the_whole_list(tessellator);
}

TEST(Sec4_Frame, RefusesWhatItCannotDo) {
  Tessellator<float> tessellator(octahedron());
  DrawList<float> out;
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(7, 1), out), data::ArgumentError);
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(8, 40), out), data::ArgumentError);
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(8, -2), out), data::ArgumentError);
  EXPECT_THROW(Tessellator<float>(data::ControlMesh{}), data::ArgumentError);
  const FrameStats nothing = tessellator.frame(std::vector<std::int32_t>(8, -1), out);
  EXPECT_EQ(nothing.culled, 8);
  EXPECT_TRUE(out.vertices.empty());
  EXPECT_TRUE(out.draws.empty());
}

}  // namespace
}  // namespace limitcheck::fast
