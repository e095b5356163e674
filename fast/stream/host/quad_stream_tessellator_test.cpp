// SPDX-License-Identifier: MIT
// Frames of Catmull-Clark's scheme by row streaming.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/test_support/collecting_sink.h"
#include "fast/test_support/shared_points.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast::row_stream {
namespace {

std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  std::vector<std::int32_t> depth;
  for (std::size_t f = 0; f < faces; ++f)
    depth.push_back(static_cast<std::int32_t>(below(random, static_cast<std::size_t>(most - least) + 1)) +
                    least);
  return depth;
}

TessellatorOptions quad_options(Repair repair) {
  TessellatorOptions options;
  options.scheme = data::Scheme::kCatmullClark;
  options.provenance = true;
  options.cracks.repair = repair;
  return options;
}

std::vector<data::ControlMesh> closed_meshes() {
  return {data::quad_cube(),      data::quad_torus(6, 5), data::pawn(5),
          data::mixed_pawn(5),    data::polygon_prism(7), data::dart(5, false),
          data::creased_cube(10), data::creased_cube(2),  data::crease_ring(1, 5)};
}

// The sliding window's frames are judged by tests of their own: the same draws of the same places, and the
// same points but for rounding.
TEST(QuadStreamFrame, HasTheDrawsAndThePointsOfTheWindowInDouble) {
  auto meshes = closed_meshes();
  meshes.push_back(data::quad_fan(3, 1));
  meshes.push_back(data::quad_wheel(9, 2));
  for (const auto& mesh : meshes) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      for (const FanCentre centre : {FanCentre::kLimit, FanCentre::kFlatLimit, FanCentre::kFlatControl}) {
        TessellatorOptions options = quad_options(repair);
        options.cracks.centre = centre;
        StreamTessellator ours(mesh, options);
        Tessellator<double> window(mesh, options);
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
          const auto depth = random_depths(mesh.faces.size(), -1, seed == 0 ? 6 : 4, seed);
          DrawList<float> got;
          DrawList<double> want;
          ours.frame(depth, got);
          window.frame(depth, want);
          ASSERT_EQ(got.vertices.size(), want.vertices.size());
          ASSERT_EQ(got.draws.size(), want.draws.size());
          ASSERT_EQ(got.provenance, want.provenance);
          double position = 0, normal = 0;
          for (std::size_t v = 0; v < got.vertices.size(); ++v) {
            const auto& a = got.vertices[v];
            const auto& b = want.vertices[v];
            position =
                std::max({position, std::abs(a.position.x - b.position.x),
                          std::abs(a.position.y - b.position.y), std::abs(a.position.z - b.position.z)});
            normal = std::max({normal, std::abs(a.normal.x - b.normal.x), std::abs(a.normal.y - b.normal.y),
                               std::abs(a.normal.z - b.normal.z)});
          }
          EXPECT_LE(position / data::box_diagonal(mesh), 1.2e-7) << seed;
          EXPECT_LE(normal, 1e-3) << seed;
        }
      }
    }
  }
}

// No crack and no T-vertex: every directed edge of the triangles has its opposite, for shared vertices have
// one index; and no point at a border differs in bits by the face that it comes from.
TEST(QuadStreamFrame, ClosesEveryEdgeOfAClosedMeshAtRandomDepths) {
  for (const auto& mesh : {data::quad_cube(), data::quad_torus(6, 5), data::pawn(5), data::mixed_pawn(5),
                           data::creased_cube(2), data::crease_ring(1, 5)}) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        StreamTessellator tessellator(mesh, quad_options(repair));
        const auto depth = random_depths(mesh.faces.size(), 0, 4, seed);
        IndexedMesh<float> out;
        tessellator.frame(depth, out);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const auto& t : out.triangles)
          for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
        for (const auto& [edge, count] : edges) {
          ASSERT_EQ(count, 1);
          ASSERT_TRUE(edges.count({edge.second, edge.first})) << edge.first << " " << edge.second;
        }
        std::map<std::array<float, 3>, std::array<float, 3>> known;
        for (const auto& v : out.vertices)
          known[{v.position.x, v.position.y, v.position.z}] = {v.normal.x, v.normal.y, v.normal.z};
        DrawList<float> list;
        tessellator.frame(depth, list);
        for (std::size_t v = 0; v < list.vertices.size(); ++v) {
          const auto& [p, n] = list.vertices[v];
          const auto found = known.find({p.x, p.y, p.z});
          ASSERT_NE(found, known.end()) << seed << " " << v;
          ASSERT_EQ(found->second, (std::array{n.x, n.y, n.z})) << seed << " " << v;
        }
      }
    }
  }
}

TEST(QuadStreamFrame, DoesNotDependOnThreadsNorOnTheTarget) {
  auto mesh = data::pawn(6);
  mesh.sharpness.vertices.push_back({mesh.faces[2][0], 1.5F});
  const auto depth = random_depths(mesh.faces.size(), -1, 5, 11);
  TessellatorOptions options = quad_options(Repair::kStitch);
  options.threads = 1;
  DrawList<float> expected;
  StreamTessellator(mesh, options).frame(depth, expected);
  for (const Kernel& kernel : kernels()) {
    for (const int threads : {1, 2, 8}) {
      if (!kernel.fused && threads > 1) continue;
      options.threads = threads;
      DrawList<float> out;
      StreamTessellator(mesh, options, kernel).frame(depth, out);
      ASSERT_EQ(out.vertices.size(), expected.vertices.size());
      EXPECT_EQ(std::memcmp(out.vertices.data(), expected.vertices.data(), 24 * out.vertices.size()), 0)
          << kernel.name << " " << threads;
    }
  }
}

TEST(QuadStreamFrame, NeedsAQuarterOfAMegabytePerThreadAtDepthFive) {
  for (const int size : {5, 20}) {
    const auto mesh = data::quad_torus(size, size);
    StreamTessellator tessellator(mesh, quad_options(Repair::kFan));
    IndexedMesh<float> out;
    tessellator.frame(std::vector<std::int32_t>(mesh.faces.size(), 5), out);
    EXPECT_LE(tessellator.worker_bytes(), 256u << 10);
    RecordProperty("bytes", std::to_string(tessellator.worker_bytes()));
  }
}

TEST(QuadStreamFrame, OnTheFlyDeliversTheSameAsTheWholeList) {
  for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
    StreamTessellator tessellator(data::quad_torus(50, 50), quad_options(repair));
    expect_a_sink_gets_the_whole_list(tessellator);
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
