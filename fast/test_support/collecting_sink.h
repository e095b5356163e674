// SPDX-License-Identifier: MIT
// For the tests of this folder: what an engine hands to a draw sink against the same frame as a whole list.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/engine.h"
#include "fast/test_support/exact_weld.h"

namespace limitcheck::fast {

/// Collects what a draw sink is given.
struct CollectingSink : DrawSink<float> {
  DrawList<float> list;
  void draw(const Draw& draw, std::span<const SurfaceVertex<float>> vertices,
            std::span<const LatticePoint> provenance) override {
    EXPECT_EQ(draw.first, static_cast<std::int64_t>(list.vertices.size()));
    list.draws.push_back(draw);
    list.vertices.insert(list.vertices.end(), vertices.begin(), vertices.end());
    list.provenance.insert(list.provenance.end(), provenance.begin(), provenance.end());
  }
};

/// For an engine with provenance: a frame of more than one part delivers the same to a sink as in memory.
inline void expect_a_sink_gets_the_whole_list(Engine<float>& engine) {
  std::vector<std::int32_t> depth;
  for (std::int32_t f = 0; f < engine.face_count(); ++f) depth.push_back(f % 5);
  DrawList<float> list;
  CollectingSink sink;
  const FrameStats a = engine.frame(depth, list);
  const FrameStats b = engine.frame(depth, static_cast<DrawSink<float>&>(sink));
  EXPECT_GT(list.vertices.size(), std::size_t{1} << 18) << "more than one part, or nothing is tested";
  EXPECT_EQ(sink.list.vertices, list.vertices);
  EXPECT_EQ(sink.list.provenance, list.provenance);
  EXPECT_EQ(triangles_of(sink.list), triangles_of(list));
  EXPECT_EQ(a.vertices, b.vertices);
}

}  // namespace limitcheck::fast
