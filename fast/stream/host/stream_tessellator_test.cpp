// SPDX-License-Identifier: MIT
#include "fast/stream/stream_tessellator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast::row_stream {
namespace {

TessellatorOptions options_of(data::Scheme scheme, Repair repair) {
  TessellatorOptions options;
  options.scheme = scheme;
  options.provenance = true;
  options.cracks.repair = repair;
  return options;
}
constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;

TEST(StreamFrame, DoesNotDependOnThreadsNorOnTheTarget) {
  auto pawn = data::pawn(6);
  pawn.sharpness.vertices.push_back({pawn.faces[2][0], 1.5F});
  for (const auto scheme : {kLoop, kQuads}) {
    const auto mesh = scheme == kLoop ? shaken(grid_torus(5, 6), .2, 7) : pawn;
    const auto depth = random_depths(mesh.faces.size(), -1, 5, 11);
    TessellatorOptions options = options_of(scheme, scheme == kLoop ? Repair::kFan : Repair::kStitch);
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
}

// What a thread needs does not grow with the mesh, and stays within a second-level cache: the kernel's rows,
// two rows of output, and the border points of the faces that a batch repairs.
TEST(StreamFrame, NeedsAQuarterOfAMegabytePerThreadAtDepthFive) {
  for (const auto scheme : {kLoop, kQuads}) {
    std::size_t most = 0;
    for (const int size : {5, 20}) {
      const auto mesh =
          scheme == kLoop ? shaken(grid_torus(size, size), .1, 7) : data::quad_torus(size, size);
      for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
        if (scheme == kQuads && repair == Repair::kStitch) continue;  // keeps whole faces
        StreamTessellator tessellator(mesh, options_of(scheme, repair));
        IndexedMesh<float> out;
        tessellator.frame(std::vector<std::int32_t>(mesh.faces.size(), 5), out);
        most = std::max(most, tessellator.worker_bytes());
        tessellator.frame(random_depths(mesh.faces.size(), -1, 5, 3), out);
        most = std::max(most, tessellator.worker_bytes());
      }
    }
    EXPECT_LE(most, scheme == kLoop ? 256'000u : 256u << 10);
    RecordProperty(scheme == kLoop ? "bytes" : "bytes_of_quads", std::to_string(most));
  }
}

// The sliding window's frames are judged by tests of their own: the same draws of the same places, and the
// same points but for rounding.
TEST(QuadStreamFrame, HasTheDrawsAndThePointsOfTheWindowInDouble) {
  const std::vector<data::ControlMesh> meshes{
      data::quad_cube(),       data::quad_torus(6, 5), data::pawn(5),          data::mixed_pawn(5),
      data::polygon_prism(7),  data::dart(5, false),   data::creased_cube(10), data::creased_cube(2),
      data::crease_ring(1, 5), data::quad_fan(3, 1),   data::quad_wheel(9, 2)};
  for (const auto& mesh : meshes) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      for (const FanCentre centre : {FanCentre::kLimit, FanCentre::kFlatLimit, FanCentre::kFlatControl}) {
        TessellatorOptions options = options_of(kQuads, repair);
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
            for (int c = 0; c < 3; ++c) {
              position = std::max(position, std::abs(a.position[c] - b.position[c]));
              normal = std::max(normal, std::abs(a.normal[c] - b.normal[c]));
            }
          }
          EXPECT_LE(position / data::box_diagonal(mesh), 1.2e-7) << seed;
          EXPECT_LE(normal, 1e-3) << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
