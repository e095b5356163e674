// SPDX-License-Identifier: MIT
// The kernel on a GPU against the processor's own text on a number without fused multiply-add, bit by bit. OpenGL is
// Mesa's on the processor where there is no graphics card: Debian's libgl1-mesa-dri.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/shared_bits/test_support/gl_kernels.h"
#include "verify/shared_bits/test_support/unfused.h"

namespace limitcheck::fast::row_stream {
namespace {

using GlKernel = GlTest;

// Closed, of high and low valence, with boundaries, irregular, and a face without a partner.
const std::vector<std::string> kMeshes{"tetrahedron", "octahedron", "torus",    "wheel:7",
                                       "wheel:17:1",  "fan:4",      "fan:1",    "sheet",
                                       "holes",       "random:1",   "bumpy:100"};

TEST_F(GlKernel, HasTheBitsOfTheProcessorsKernelWithoutFusedMultiplyAdd) {
  for (const bool local : {false, true})
    for (const int depth : {0, 1, 2, 3, 5, 7, 8})
      for (const std::string& name : kMeshes) {
        if (local && depth == 0) continue;
        if (depth == 5 && name != "octahedron" && name != "wheel:7" && name != "fan:1") continue;
        if (depth >= 7 && name != "fan:1" && (name != "tetrahedron" || depth == 8)) continue;
        Compared mesh(gl_kernel(), name, depth, local);
        mesh.grids();
        mesh.edges();
        EXPECT_EQ(mesh.differ, 0) << name << " depth " << depth << (local ? " local" : "") << " of "
                                  << mesh.compared;
        EXPECT_GT(mesh.compared, 0);
      }
}

// Where an origin is a matter of each edge, lane by lane.
TEST_F(GlKernel, HasThemWhereSomeEdgesHaveOriginsOfTheirOwn) {
  for (const int depth : {1, 2, 3}) {
    Compared mesh(gl_kernel(), "stretched:4:bumpy:100", depth, std::nullopt);
    mesh.grids();
    mesh.edges();
    EXPECT_EQ(mesh.differ, 0) << "depth " << depth << " of " << mesh.compared;
    EXPECT_TRUE(mesh.local > 0 && mesh.local < mesh.items) << mesh.local << " of " << mesh.items;
  }
}

// So the comparison above sees a fused product: what the processor ships differs.
TEST_F(GlKernel, DiffersFromTheFusedKernel) {
  const auto mesh = data::named_mesh("bumpy:100");
  const std::vector<std::int32_t> depths(mesh.faces.size(), 3);
  IndexedMesh<float> here, there;
  StreamTessellator(mesh).frame(depths, here);
  StreamTessellator engine(mesh, {}, verify::FrameRecorder::triangles());
  verify::frame_by_gl(engine, there, depths);
  ASSERT_EQ(here.vertices.size(), there.vertices.size());
  std::size_t differ = 0;
  for (std::size_t v = 0; v < here.vertices.size(); ++v)
    differ += std::memcmp(&here.vertices[v], &there.vertices[v], sizeof(Vertex)) != 0 ? 1 : 0;
  EXPECT_GT(differ, here.vertices.size() / 10);
  EXPECT_LT(differ, here.vertices.size());
}

TEST_F(GlKernel, RefusesDepthsForWhichSharedMemoryIsTooSmall) {
  for (int depth = 0; depth <= gpu::kMaxDepth; ++depth)
    for (const auto shader : {gpu::Shader::kTriangleGrids, gpu::Shader::kTriangleEdges, gpu::Shader::kQuads,
                              gpu::Shader::kQuadSides, gpu::Shader::kQuadPatches})
      EXPECT_LE(4 * gpu::SharedMemory::of(shader, depth).size, 32768) << depth;
  EXPECT_GT(4 * gpu::SharedMemory::of(gpu::Shader::kTriangleGrids, gpu::kMaxDepth + 1).size, 32768);
  std::vector<float> input(static_cast<std::size_t>(gl_kernel().lanes * input_size(9)));
  EXPECT_THROW(gl_kernel().run(input.data(), 9, {}, nullptr, {}), data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
