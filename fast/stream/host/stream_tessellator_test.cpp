// SPDX-License-Identifier: MIT
#include "fast/stream/stream_tessellator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "data/error.h"
#include "fast/test_support/collecting_sink.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {
namespace {

std::vector<std::int32_t> random_depths(std::size_t faces, int most, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  std::vector<std::int32_t> depth;
  for (std::size_t f = 0; f < faces; ++f)
    depth.push_back(static_cast<std::int32_t>(below(random, static_cast<std::size_t>(most) + 2)) - 1);
  return depth;
}

std::vector<data::ControlMesh> meshes() {
  return {shaken(tetrahedron(), .2, 1),    shaken(grid_torus(4, 5), .2, 2), shaken(bipyramid(9), .2, 3),
          shaken(grid_sheet(3, 4), .1, 4), shaken(fan(5), .05, 5),          single_triangle()};
}

// The points of a frame as sets of bits per place on a control edge or vertex: all faces must agree, also
// where their depths differ, and with the other sink.
TEST(StreamFrame, SharesItsBorderPointsBitForBitAtRandomDepths) {
  std::int64_t compared = 0;
  for (const auto& mesh : meshes()) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
        TessellatorOptions options;
        options.provenance = true;
        options.cracks.repair = repair;
        StreamTessellator tessellator(mesh, options);
        DrawList<float> list;
        tessellator.frame(random_depths(mesh.faces.size(), 4, seed), list);
        // One table for all depths would be wrong: a point at two depths may differ in bits. Edges have one
        // depth.
        std::map<std::uint32_t, SharedPoints> shared;
        for (std::size_t v = 0; v < list.vertices.size(); ++v) {
          const LatticePoint& at = list.provenance[v];
          if (at.denominator == 3) continue;
          Vertex vertex;
          std::memcpy(static_cast<void*>(&vertex), &list.vertices[v], sizeof vertex);
          shared[at.denominator].add(mesh, at, vertex, {});
        }
        for (const auto& [denominator, points] : shared) {
          EXPECT_EQ(points.different(), 0) << "seed " << seed << " 1/" << denominator;
          compared += points.compared();
        }
      }
    }
  }
  RecordProperty("compared", std::to_string(compared));
}

// Every directed edge of the indexed mesh's triangles has its opposite, or lies on the mesh's border or
// beside a culled face: no crack and no T-vertex, for shared vertices have one index.
TEST(StreamFrame, ClosesEveryEdgeOfAClosedMeshAtRandomDepths) {
  for (const auto& mesh : {shaken(tetrahedron(), .2, 1), shaken(grid_torus(4, 5), .2, 2)}) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      auto depth = random_depths(mesh.faces.size(), 4, seed);
      for (auto& d : depth) d = std::max(d, 0);
      StreamTessellator tessellator(mesh);
      IndexedMesh<float> out;
      tessellator.frame(depth, out);
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
      for (const auto& t : out.triangles) {
        for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
      }
      for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_TRUE(edges.count({edge.second, edge.first}))
            << edge.first << " " << edge.second << " seed " << seed;
      }
    }
  }
}

TEST(StreamFrame, DoesNotDependOnThreadsNorOnTheTarget) {
  const auto mesh = shaken(grid_torus(5, 6), .2, 7);
  const auto depth = random_depths(mesh.faces.size(), 5, 11);
  DrawList<float> expected;
  TessellatorOptions options;
  options.threads = 1;
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

// What a thread needs does not grow with the mesh, and stays within a second-level cache: the kernel's rows,
// two rows of output, and the border points of the faces that a batch repairs.
TEST(StreamFrame, NeedsAQuarterOfAMegabytePerThreadAtDepthFive) {
  std::size_t most = 0;
  for (const int size : {5, 20}) {
    const auto mesh = shaken(grid_torus(size, size), .1, 7);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      TessellatorOptions options;
      options.cracks.repair = repair;
      StreamTessellator tessellator(mesh, options);
      IndexedMesh<float> out;
      tessellator.frame(std::vector<std::int32_t>(mesh.faces.size(), 5), out);
      most = std::max(most, tessellator.worker_bytes());
      auto depth = random_depths(mesh.faces.size(), 5, 3);
      tessellator.frame(depth, out);
      most = std::max(most, tessellator.worker_bytes());
    }
  }
  EXPECT_LE(most, 256'000u);
  RecordProperty("bytes", std::to_string(most));
}

// A mesh times 2^k, k even far out: the same surface times 2^k, the same normals, to the last bit.
TEST(StreamFrame, ScalesByPowersOfTwoExactly) {
  const auto mesh = shaken(bipyramid(7), .2, 9);
  const std::vector<std::int32_t> depth(mesh.faces.size(), 4);
  DrawList<float> expected;
  StreamTessellator(mesh).frame(depth, expected);
  for (const int exponent : {-60, -20, 20, 60}) {
    auto scaled = mesh;
    for (auto& p : scaled.positions)
      for (double& x : p) x = std::ldexp(x, exponent);
    DrawList<float> out;
    StreamTessellator(scaled).frame(depth, out);
    for (std::size_t v = 0; v < out.vertices.size(); ++v) {
      const auto &a = out.vertices[v], &b = expected.vertices[v];
      ASSERT_EQ(a.position.x, std::ldexp(b.position.x, exponent));
      ASSERT_EQ(a.position.y, std::ldexp(b.position.y, exponent));
      ASSERT_EQ(a.position.z, std::ldexp(b.position.z, exponent));
      ASSERT_EQ(a.normal, b.normal);
    }
  }
}

// Shifted by a thousand times its size (exactly: the coordinates are rounded to 2^-12 first), the mesh loses
// what its own float coordinates lose, and no more: half an ulp of the shift in position, the normals not at
// all.
TEST(StreamFrame, StandsAShiftOfAThousandTimesItsSize) {
  auto mesh = shaken(bipyramid(7), .2, 9);
  for (auto& p : mesh.positions)
    for (double& x : p) x = std::round(x * 4096) / 4096;
  auto shifted = mesh;
  for (auto& p : shifted.positions) p = {p[0] + 2000, p[1] - 2000, p[2] + 1000};
  const std::vector<std::int32_t> depth(mesh.faces.size(), 4);
  DrawList<float> expected, out;
  StreamTessellator(mesh).frame(depth, expected);
  StreamTessellator(shifted).frame(depth, out);
  double position = 0, normal = 0;
  for (std::size_t v = 0; v < out.vertices.size(); ++v) {
    const auto &a = out.vertices[v], &b = expected.vertices[v];
    position = std::max({position, std::abs(a.position.x - 2000. - b.position.x),
                         std::abs(a.position.y + 2000. - b.position.y),
                         std::abs(a.position.z - 1000. - b.position.z)});
    normal = std::max<double>({normal, std::abs(a.normal.x - b.normal.x), std::abs(a.normal.y - b.normal.y),
                               std::abs(a.normal.z - b.normal.z)});
  }
  EXPECT_LE(position, 0x1p-14 + 1e-6);  // ulp(2000) / 2, and the rounding of both computations
  EXPECT_LE(normal, 2e-5);              // both within the bound of row_stream_test.cpp
  RecordProperty("worst_position", std::to_string(position));
  RecordProperty("worst_normal", std::to_string(normal));
}

TEST(StreamFrame, OnTheFlyDeliversTheSameAsTheWholeList) {
  TessellatorOptions options;
  options.provenance = true;
  for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
    options.cracks.repair = repair;
    StreamTessellator tessellator(grid_torus(32, 40), options);
    expect_a_sink_gets_the_whole_list(tessellator);
  }
}

TEST(StreamFrame, RefusesWhatItCannotDo) {
  EXPECT_THROW(StreamTessellator(data::ControlMesh{}), data::ArgumentError);
  auto mesh = tetrahedron();
  StreamTessellator tessellator(mesh);
  DrawList<float> out;
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(3, 1), out), data::ArgumentError);
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(4, 11), out), data::ArgumentError);
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(4, -2), out), data::ArgumentError);
  mesh.positions[0][0] = std::nan("");
  EXPECT_THROW(StreamTessellator{mesh}, data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
