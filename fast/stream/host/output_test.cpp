// SPDX-License-Identifier: MIT
// The output forms against whole grids: their bytes, wherever they lie, and no others.
#include <gtest/gtest.h>
// Those that output_targets.cpp leaves out.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "fast/frame/stores.h"
#include "fast/stream/kernel/output_targets.h"
#include "fast/stream/row_stream.h"
#include "fast/test_support/quad_meshes.h"
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

constexpr std::size_t kLine = 16;  // floats of a cache line
constexpr float kGuard = -7.25F;

TEST(FloatLanes, AreTheNumbersOfEachLaneOnEveryTarget) {
  data::SplitMix64 random(5);
  std::vector<float> numbers(16 * 80);
  for (float& x : numbers) x = static_cast<float>(random.unit());
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (const int lanes : {4, 8, 16})
      for (int count = 1; count <= 70; ++count) {
        const float* from[16];
        for (int k = 0; k < lanes; ++k) from[k] = numbers.data() + 79 * k;
        AlignedFloats out;
        out.grow(static_cast<std::size_t>(lanes * count + 1));
        out.data()[lanes * count] = kGuard;
        float_lanes(from, count, lanes, out.data());
        for (int i = 0; i < lanes * count; ++i)
          ASSERT_EQ(out.data()[i], from[i % lanes][i / lanes])
              << hwy::TargetName(target) << ": " << lanes << " lanes of " << count;
        ASSERT_EQ(out.data()[lanes * count], kGuard);
      }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// Streams `grids` of a depth to each of the sixteen places that they can have on a cache line.
template <class Stream, class Item>
void expect_whole(const std::string& name, const Stream& stream, std::span<const Item> grids, int depth) {
  const auto n = static_cast<std::size_t>(side(depth));
  const std::size_t count = 6 * grids.size() * n * n;
  Workspace workspace;
  std::vector<Vertex> whole(grids.size() * n * n);
  stream.whole(grids, depth, workspace, whole.data());
  AlignedFloats memory;
  memory.grow(count + 2 * kLine);
  for (std::size_t offset = 0; offset < kLine; ++offset) {
    std::fill_n(memory.data(), memory.size(), kGuard);
    float* const out = memory.data() + offset;
    stream.streamed(grids, depth, workspace, reinterpret_cast<Vertex*>(out));
    ASSERT_EQ(std::memcmp(out, whole.data(), 4 * count), 0) << name << " depth " << depth << " at " << offset;
    const auto is_guard = [](float x) { return x == kGuard; };
    ASSERT_TRUE(std::all_of(memory.data(), out, is_guard)) << name << " depth " << depth << " at " << offset;
    ASSERT_TRUE(std::all_of(out + count, memory.data() + memory.size(), is_guard))
        << name << " depth " << depth << " at " << offset;
  }
}

TEST(LineOutput, OfTrianglesIsWholeWhereverItLies) {
  std::vector<NamedMesh> meshes{{"torus", shaken(grid_torus(5, 7), .2, 1)},
                                {"sheet", shaken(grid_sheet(3, 5), .1, 2)},
                                {"cut", shaken(grid_torus(5, 4), .2, 3)},
                                {"tetrahedron", tetrahedron()}};
  auto& edges = meshes[2].mesh.sharpness.edges;
  edges.push_back({meshes[2].mesh.faces[3][0], meshes[2].mesh.faces[3][1], data::kInfiniteSharpness});
  for (const NamedMesh& named : meshes) {
    const TriangleMesh mesh(named.mesh);
    for (const Kernel& kernel : kernels()) {
      if (!kernel.fused && kernel.lanes > 1) continue;  // slow, and the same code
      const RowStream stream(mesh, kernel);
      for (int depth = 0; depth <= 6; ++depth) {
        const auto faces = static_cast<std::size_t>(mesh.adjacency().face_count());
        const auto grids = pair_faces(mesh.adjacency(), std::vector<std::int32_t>(faces, depth)).grids;
        expect_whole(named.name + " " + kernel.name, stream, std::span<const Grid>(grids), depth);
      }
    }
  }
}

TEST(LineOutput, OfQuadsIsWholeWhereverItLies) {
  const std::vector<NamedMesh> meshes{{"torus", shaken(data::quad_torus(6, 5), .1, 4)},
                                      {"pawn", shaken(data::pawn(5), .01, 5)},
                                      {"mixed", data::with_random_sharpness(data::mixed_mesh(3), 3)}};
  for (const NamedMesh& named : meshes) {
    const QuadMesh mesh(named.mesh);
    const int deepest = mesh.semi_sharp() ? 3 : 6;  // those go one by one, in double
    std::vector<std::int32_t> faces(static_cast<std::size_t>(mesh.adjacency.face_count()));
    std::iota(faces.begin(), faces.end(), 0);
    for (const QuadKernel& kernel : quad_kernels()) {
      if (!kernel.fused && kernel.lanes > 1) continue;
      const QuadRowStream stream(mesh, kernel);
      for (int depth = 0; depth <= deepest; ++depth)
        expect_whole(named.name + " " + kernel.name, stream, std::span<const std::int32_t>(faces), depth);
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
