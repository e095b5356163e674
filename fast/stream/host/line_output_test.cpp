// SPDX-License-Identifier: MIT
// Output past the caches: the bytes of whole grids, wherever they lie, and no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "data/generators/mixed_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/quad_row_stream.h"
#include "fast/stream/row_stream.h"
#include "fast/test_support/quad_meshes.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {
namespace {

constexpr std::size_t kLine = 16;  // floats of a cache line
constexpr float kGuard = -7.25F;

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
