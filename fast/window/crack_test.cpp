// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>

#include "data/error.h"
#include "fast/frame/crack_centre.h"
#include "fast/frame/patch.h"
#include "fast/test_support/collecting_sink.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

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
  CrackOptions options;
  options.repair = Repair::kStitch;
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
    TessellatorOptions options;
    options.threads = threads;
    options.provenance = true;
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
  TessellatorOptions options;
  options.provenance = true;
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
