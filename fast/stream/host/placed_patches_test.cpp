// SPDX-License-Identifier: MIT
// Patches that the kernel writes to their place itself.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/test_support/patch_frames.h"

namespace limitcheck::fast::row_stream {
namespace {

// Whole batches go straight to their place, past the caches where there is much; with provenance they go row by
// row. From frame to frame too, where some stay.
TEST(PlacedPatches, HaveTheSameBytesStraightFromTheKernelAsRowByRow) {
  const std::vector<Model> large{
      {"torus", shaken(grid_torus(6, 7), .2, 7), data::Scheme::kLoop},
      {"cut", data::named_mesh("creased:3:80"), data::Scheme::kLoop},
      {"quads", shaken(data::quad_torus(7, 6), .1, 8), data::Scheme::kCatmullClark},
      {"polygons", data::named_mesh("mixed:2"), data::Scheme::kCatmullClark}};
  for (const Model& model : large) {
    for (const Kernel& kernel : kernels()) {
      if (!kernel.fused && kernel.lanes > 1) continue;  // slow, and the same code
      TessellatorOptions options = options_of(model, Repair::kFan);
      options.threads = 3;
      StreamTessellator straight(model.mesh, options, kernel);
      options.provenance = true;
      StreamTessellator by_rows(model.mesh, options, kernel);
      PatchOptions kept;
      kept.incremental = true;
      PatchMesh<float> got(kept), want(kept);
      std::vector<std::int32_t> depth(model.mesh.faces.size(), 0);
      for (const int next : {2, 7, 1, 5, 0}) {
        for (std::size_t f = 0; f < depth.size(); ++f)
          if (next != 5 || f % 3 != 0) depth[f] = next;
        straight.frame(depth, got), by_rows.frame(depth, want);
        ASSERT_EQ(got.vertices().size(), want.vertices().size());
        if (next == 7) {
          EXPECT_GT(got.vertices().size_bytes(), std::size_t{4} << 20);
        }
        for (const PatchDraw& draw : got.draws()) {  // not what nobody looks at between them
          const auto first = static_cast<std::size_t>(draw.base_vertex);
          const auto size = static_cast<std::size_t>(draw.vertex_count) * sizeof(SurfaceVertex<float>);
          ASSERT_EQ(std::memcmp(&got.vertices()[first], &want.vertices()[first], size), 0)
              << model.name << " to depth " << next << " with " << kernel.name;
        }
      }
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
