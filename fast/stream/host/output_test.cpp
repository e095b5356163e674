// SPDX-License-Identifier: MIT
// The output forms against whole grids.
#include <gtest/gtest.h>
// Those that output_targets.cpp leaves out.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <hwy/targets.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "data/error.h"
#include "fast/frame/stores.h"
#include "fast/stream/kernel/output_targets.h"
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

TEST(RowStreamOutput, StreamedIsWholeByteForByte) {
  for (const auto& mesh : {shaken(grid_torus(5, 7), .2, 1), shaken(grid_sheet(3, 5), .1, 2), tetrahedron()}) {
    const Adjacency adjacency(mesh);
    for (const Kernel& kernel : kernels()) {
      if (!kernel.fused && kernel.lanes > 1) continue;  // slow, and the same code
      const RowStream stream(mesh, adjacency, kernel);
      for (int depth = 0; depth <= 6; ++depth) {
        const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
        const std::size_t count = grids.size() * static_cast<std::size_t>(side(depth) * side(depth));
        Workspace workspace;
        std::vector<Vertex> whole(count);
        stream.whole(grids, depth, workspace, whole.data());
        const Vertex guard{{-1, -2, -3}, {-4, -5, -6}};
        std::vector<Vertex> streamed(count + 2, guard);
        stream.streamed(grids, depth, workspace, streamed.data() + 1);
        ASSERT_EQ(std::memcmp(streamed.data() + 1, whole.data(), count * sizeof(Vertex)), 0) << depth;
        EXPECT_EQ(std::memcmp(&streamed.front(), &guard, sizeof guard), 0);
        EXPECT_EQ(std::memcmp(&streamed.back(), &guard, sizeof guard), 0);
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
    EXPECT_EQ(std::memcmp(c.position, &v.position, sizeof c.position), 0);
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
    compact(all.data(), all.size(), out.data());
    for (std::size_t v = 0; v < all.size(); ++v)
      ASSERT_EQ(out[v], compacted(all[v])) << v << " " << hwy::TargetName(target);
    for (std::size_t length = 0; length < 70; ++length) {
      std::vector<CompactVertex> some(length + 1, CompactVertex{{9, 9, 9}, 9});
      compact(all.data(), length, some.data());
      EXPECT_TRUE(std::equal(some.begin(), some.end() - 1, out.begin())) << length;
      EXPECT_EQ(some.back().normal, 9u);
    }
    ++targets;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  RecordProperty("targets", targets);
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
