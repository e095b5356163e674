// SPDX-License-Identifier: MIT
// Section 7: "the present design makes no use of any information that is stored for more than a single frame,
// and can thus not exploit temporal coherence." What could be kept from one frame to the next. [C86]
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "data/generators/bumpy_sphere.h"
#include "fast/stream/stream_tessellator.h"

namespace limitcheck::verify {
namespace {

using fast::row_stream::StreamTessellator;

fast::Camera turned(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  fast::Camera camera;
  camera.eye = {4 * std::sin(angle), 0, 4 * std::cos(angle)};
  return camera;
}

struct Turn {
  double vertices = 0, written = 0, triangles = 0;
  double kept() const { return 100 * (1 - written / vertices); }
};

// A turn of a view in steps of a degree: how much of what is shown was there in the frame before. Every shown
// vertex must be what a frame by itself has for the same patches, to the bit.
Turn turn(StreamTessellator& engine, const fast::DepthOptions& strategy, bool sticky) {
  fast::PatchMesh<float> kept({.incremental = true, .sticky = sticky}), alone({.sticky = sticky});
  Turn total;
  for (int degree = 0; degree < 60; ++degree) {
    const fast::FrameStats stats = engine.frame(strategy, turned(degree), kept);
    engine.frame(strategy, turned(degree), alone);
    EXPECT_EQ(kept.draws().size(), alone.draws().size());
    for (std::size_t i = 0; i < kept.draws().size(); ++i) {
      const fast::PatchDraw &a = kept.draws()[i], &b = alone.draws()[i];
      EXPECT_EQ(a.face, b.face);
      EXPECT_EQ(a.vertex_count, b.vertex_count);
      EXPECT_EQ(std::memcmp(&kept.vertices()[static_cast<std::size_t>(a.base_vertex)],
                            &alone.vertices()[static_cast<std::size_t>(b.base_vertex)],
                            sizeof(fast::SurfaceVertex<float>) * static_cast<std::size_t>(a.vertex_count)),
                0);
    }
    if (degree == 0) continue;
    total.vertices += static_cast<double>(stats.vertices);
    total.triangles += static_cast<double>(stats.triangles);
    for (const fast::VertexRange& range : kept.changed()) total.written += static_cast<double>(range.count);
  }
  return total;
}

TEST(Sec7_TemporalCoherence, LeavesMostOfAFrameAsItWas) {
  RecordProperty("claim", "C86");
  StreamTessellator engine(data::bumpy_sphere(800, 1));
  fast::DepthOptions strategy;
  strategy.strategy = fast::Strategy::kCombined;
  const Turn pairs = turn(engine, strategy, false), sticky = turn(engine, strategy, true);
  EXPECT_GT(pairs.kept(), 50);
  EXPECT_GT(sticky.kept(), pairs.kept());
  EXPECT_LT(sticky.kept(), 100) << "a turn changes something";
  RecordProperty("percent_kept", fmt::format("{:.0f}", pairs.kept()));
  RecordProperty("percent_kept_sticky", fmt::format("{:.1f}", sticky.kept()));
  RecordProperty("percent_more_triangles",
                 fmt::format("{:.1f}", 100 * (sticky.triangles / pairs.triangles - 1)));
}

}  // namespace
}  // namespace limitcheck::verify
