// SPDX-License-Identifier: MIT
// The output forms against whole grids.
#include <gtest/gtest.h>
// Those that output_targets.cpp leaves out.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>

#include "data/error.h"
#include "fast/frame/stores.h"
#include "fast/stream/host/grid_indices.h"
#include "fast/stream/kernel/compact_vertex.h"
#include "fast/stream/kernel/memory_stream.h"
#include "fast/stream/row_stream.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {
namespace {

// Every way that a run can lie across cache lines, in pieces of all sizes.
TEST(LineStream, WritesItsBytesAndNoOthersWhateverTheAlignment) {
  data::SplitMix64 random(1);
  std::vector<std::byte> source(1024);
  for (auto& b : source) b = static_cast<std::byte>(random.next());
  alignas(64) std::array<std::byte, 1536> memory;
  for (std::size_t offset = 64; offset < 128; offset += 4) {
    for (std::size_t size = 0; size <= 640; size += 4) {
      memory.fill(std::byte{0xa5});
      LineStream lines;
      lines.start(memory.data() + offset);
      for (std::size_t done = 0; done < size;) {
        const std::size_t piece = std::min(size - done, 4 * below(random, 60));
        lines.append(source.data() + done, piece);
        done += piece;
      }
      lines.finish();
      fence(Stores::kPastCaches);
      ASSERT_EQ(std::memcmp(memory.data() + offset, source.data(), size), 0) << offset << " " << size;
      for (std::size_t k = 0; k < memory.size(); ++k) {
        if (k < offset || k >= offset + size) {
          ASSERT_EQ(memory[k], std::byte{0xa5}) << offset << " " << size << " " << k;
        }
      }
    }
  }
}

TEST(RowStreamOutput, StreamedIsWholeByteForByteAndCompactIsItsCompaction) {
  for (const auto& mesh : {shaken(grid_torus(5, 7), .2, 1), shaken(grid_sheet(3, 5), .1, 2), tetrahedron()}) {
    const Adjacency adjacency(mesh);
    for (const Kernel& kernel : kernels()) {
      if (!kernel.fused && kernel.lanes > 1) continue;  // slow, and the same code
      const RowStream stream(mesh, adjacency, kernel);
      for (int depth = 0; depth <= 6; ++depth) {
        const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
        const std::size_t count = base_vertex(grids.size(), depth);
        Workspace workspace;
        std::vector<Vertex> whole(count);
        stream.whole(grids, depth, workspace, whole.data());
        const Vertex guard{{-1, -2, -3}, {-4, -5, -6}};
        std::vector<Vertex> streamed(count + 2, guard);
        stream.streamed(grids, depth, workspace, streamed.data() + 1);
        ASSERT_EQ(std::memcmp(streamed.data() + 1, whole.data(), count * sizeof(Vertex)), 0) << depth;
        EXPECT_EQ(std::memcmp(&streamed.front(), &guard, sizeof guard), 0);
        EXPECT_EQ(std::memcmp(&streamed.back(), &guard, sizeof guard), 0);
        std::vector<CompactVertex> compact(count + 1, CompactVertex{{7, 7, 7}, 7});
        stream.streamed(grids, depth, workspace, compact.data());
        for (std::size_t v = 0; v < count; ++v)
          ASSERT_EQ(compact[v], compacted(whole[v])) << depth << " " << v;
        EXPECT_EQ(compact.back(), (CompactVertex{{7, 7, 7}, 7}));
      }
    }
  }
}

// Normals all over the sphere, on the octahedron's edges and corners too.
std::vector<Vertex> normals() {
  data::SplitMix64 random(3);
  std::vector<Vertex> all;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const float size = std::sqrt(static_cast<float>(x * x + y * y + z * z));
        if (size > 0)
          all.push_back(
              {{1, 2, 3},
               {static_cast<float>(x) / size, static_cast<float>(y) / size, static_cast<float>(z) / size}});
      }
    }
  }
  while (all.size() < 300'003) {
    const double z = 2 * random.unit() - 1, t = 2 * std::numbers::pi * random.unit(),
                 r = std::sqrt(1 - z * z);
    all.push_back(
        {{static_cast<float>(all.size()), 0, -1},
         {static_cast<float>(r * std::cos(t)), static_cast<float>(r * std::sin(t)), static_cast<float>(z)}});
  }
  return all;
}

TEST(CompactVertex, KeepsThePositionAndTheNormalToTheBoundOfItsQuantisation) {
  double worst = 0;
  for (const Vertex& v : normals()) {
    const CompactVertex c = compacted(v);
    EXPECT_EQ(std::memcmp(c.position, v.position, sizeof c.position), 0);
    const auto n = unpacked_normal(c);
    // The angle from the chord: good to 1e-7, where the cosine is not.
    const double chord = std::hypot(n[0] - v.normal[0], n[1] - v.normal[1], n[2] - v.normal[2]);
    const double angle = 2 * std::asin(chord / 2);
    worst = std::max(worst, angle);
    ASSERT_LE(angle, kCompactNormalBound) << v.normal[0] << " " << v.normal[1] << " " << v.normal[2];
  }
  RecordProperty("worst_radians", std::to_string(worst * 1e6) + "e-6");
}

TEST(CompactVertex, ComesOutOfVectorsWithTheSameBitsOnEveryTargetWhateverTheLength) {
  const auto all = normals();
  int targets = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    std::vector<CompactVertex> out(all.size());
    compact(all, out.data());
    for (std::size_t v = 0; v < all.size(); ++v)
      ASSERT_EQ(out[v], compacted(all[v])) << v << " " << hwy::TargetName(target);
    for (std::size_t length = 0; length < 70; ++length) {
      std::vector<CompactVertex> some(length + 1, CompactVertex{{9, 9, 9}, 9});
      compact(std::span(all).first(length), some.data());
      EXPECT_TRUE(std::equal(some.begin(), some.end() - 1, out.begin())) << length;
      EXPECT_EQ(some.back().normal, 9u);
    }
    ++targets;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  RecordProperty("targets", targets);
}

using Triangle = std::array<std::uint32_t, 3>;

// Each triangle of the lattice once: half a unit of area, turning left, three different corners of one unit
// square, and on the half of the grid it should be on.
void expect_cover(const std::vector<Triangle>& triangles, int depth) {
  const std::uint32_t size = 1u << depth, side = size + 1;
  ASSERT_EQ(triangles.size(), std::size_t{2} << (2 * depth));
  std::set<std::array<std::uint32_t, 3>> seen;  // square, and which half
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<int, 3> x{}, y{};
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LT(triangles[t][k], side * side);
      x[k] = static_cast<int>(triangles[t][k] % side), y[k] = static_cast<int>(triangles[t][k] / side);
    }
    EXPECT_EQ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]), 1);
    const int left = std::min({x[0], x[1], x[2]}), low = std::min({y[0], y[1], y[2]});
    int above = 0, sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(x[k], left + 1);
      EXPECT_LE(y[k], low + 1);
      EXPECT_TRUE(t < triangles.size() / 2 ? y[k] >= x[k] : x[k] >= y[k]) << "face0 first, then face1";
      above += y[k] - low;
      sum += (x[k] - left == y[k] - low);
    }
    EXPECT_EQ(sum, 2) << "cut along the grid's diagonal";
    seen.insert({static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(low),
                 static_cast<std::uint32_t>(above)});
  }
  EXPECT_EQ(seen.size(), triangles.size());
}

TEST(GridIndices, CoverTheGridOnceAndTurnOutward) {
  for (int depth = 0; depth <= 6; ++depth) {
    const auto list = grid_triangles(depth);
    std::vector<Triangle> triangles;
    for (std::size_t k = 0; k < list.size(); k += 3) triangles.push_back({list[k], list[k + 1], list[k + 2]});
    expect_cover(triangles, depth);

    const auto strips = grid_strips(depth);
    EXPECT_EQ(strips.size(), strip_indices(depth));
    std::vector<Triangle> unrolled;
    for (std::size_t start = 0; start < strips.size();) {
      std::size_t end = start;
      while (strips[end] != kRestart) ++end;
      for (std::size_t k = start; k + 2 < end; ++k)
        unrolled.push_back((k - start) % 2 == 0 ? Triangle{strips[k], strips[k + 1], strips[k + 2]}
                                                : Triangle{strips[k + 1], strips[k], strips[k + 2]});
      start = end + 1;
    }
    expect_cover(unrolled, depth);
  }
  EXPECT_THROW(grid_triangles(11), data::ArgumentError);
  EXPECT_THROW(grid_strips(-1), data::ArgumentError);
}

// With the base vertex of each grid the triangles are those of a closed surface, once points are taken as one
// where their bits are.
TEST(GridIndices, WithABaseVertexPerGridCloseTheSurface) {
  const auto mesh = shaken(grid_torus(4, 5), .2, 2);
  const Adjacency adjacency(mesh);
  const RowStream stream(mesh, adjacency);
  for (const int depth : {0, 2, 4}) {
    const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
    std::vector<Vertex> vertices(base_vertex(grids.size(), depth));
    Workspace workspace;
    stream.whole(grids, depth, workspace, vertices.data());
    const auto indices = grid_triangles(depth);
    std::map<std::array<std::array<float, 3>, 2>, int> edges;
    for (std::size_t p = 0; p < grids.size(); ++p) {
      const std::size_t used = grids[p].singleton() ? indices.size() / 2 : indices.size();
      for (std::size_t t = 0; t < used; t += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto at = [&](std::size_t i) {
            const Vertex& v = vertices[base_vertex(p, depth) + indices[t + i]];
            return std::array<float, 3>{v.position[0], v.position[1], v.position[2]};
          };
          ++edges[{at(k), at((k + 1) % 3)}];
        }
      }
    }
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      ASSERT_TRUE(edges.contains({edge[1], edge[0]}));
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
