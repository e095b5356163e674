// SPDX-License-Identifier: MIT
// Frames whose vertices are made on a GPU and stay there against those of the processor's engine with the same shaders as
// kernels, bit by bit: unequal depths, faces that are culled, repaired or left to the processor, one frame after another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/scheme.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/gl/resident_frame.h"
#include "verify/shared_bits/test_support/gl_kernels.h"

namespace limitcheck::fast::row_stream {
namespace {

using Depths = std::vector<std::int32_t>;

class GlFrame : public GlTest {
 protected:
  // All frames of a mesh, by both. Counts the vertices of draws, and the draws that are whole grids, are none, and are new.
  struct Seen {
    std::int64_t vertices = 0, differ = 0, grids = 0, repaired = 0, kept = 0;
  };
  static Seen compared(const std::string& name, const std::vector<Depths>& frames, const PatchOptions& form,
                       CrackOptions cracks = {}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const TessellatorOptions options{.cracks = cracks, .scheme = data::natural_scheme(mesh)};
    StreamTessellator engine(mesh, options, verify::FrameRecorder::triangles(),
                             &verify::FrameRecorder::quads());
    PatchOptions whole = form;
    whole.compact = false;
    PatchMesh<float> expected(whole);
    verify::ResidentFrame frame(mesh, options, form);
    Seen seen;
    for (const Depths& depths : frames) {
      verify::frame_by_gl(engine, expected, depths);
      frame.plan(depths);
      frame.run();
      const std::vector<std::byte> bytes = frame.read();
      EXPECT_EQ(frame.patches().indices().size(), expected.indices().size()) << name;
      EXPECT_TRUE(std::equal(expected.indices().begin(), expected.indices().end(),
                             frame.patches().indices().begin()));
      EXPECT_EQ(frame.patches().draws().size(), expected.draws().size());
      std::vector<CompactVertex> packed;
      for (const Vertex& v : expected.vertices()) packed.push_back(compacted(v));
      const std::size_t size = form.compact ? sizeof(CompactVertex) : sizeof(Vertex);
      const auto* right = form.compact ? reinterpret_cast<const std::byte*>(packed.data())
                                       : reinterpret_cast<const std::byte*>(expected.vertices().data());
      for (std::size_t d = 0; d < expected.draws().size(); ++d) {
        const PatchDraw &here = frame.patches().draws()[d], &there = expected.draws()[d];
        EXPECT_TRUE(here.base_vertex == there.base_vertex && here.vertex_count == there.vertex_count &&
                    here.first_index == there.first_index && here.face == there.face);
        (there.kind == Kind::kPair ? seen.grids : seen.repaired) += 1;
        for (std::int64_t v = there.base_vertex; v < there.base_vertex + there.vertex_count; ++v) {
          const std::size_t at = static_cast<std::size_t>(v) * size;
          seen.differ += std::memcmp(bytes.data() + at, right + at, size) != 0 ? 1 : 0;
          ++seen.vertices;
        }
      }
      std::int64_t changed = 0;
      for (const VertexRange& range : frame.patches().changed()) changed += range.count;
      seen.kept += static_cast<std::int64_t>(frame.patches().vertices().size()) - changed;
    }
    return seen;
  }

  // Runs of faces at depths -1 (culled) to `deepest`, in turn.
  static Depths unequal(const std::string& name, int deepest, std::size_t run = 0, int turn = 0) {
    Depths depths;
    const std::size_t faces = data::named_mesh(name).faces.size();
    if (run == 0) run = 1 + faces / 40;
    for (std::size_t f = 0; f < faces; ++f)
      depths.push_back((static_cast<int>(f / run) + turn) % (deepest + 2) - 1);
    return depths;
  }
  static Depths equal(const std::string& name, int depth) {
    return Depths(data::named_mesh(name).faces.size(), depth);
  }
};

TEST_F(GlFrame, HasTheVerticesOfTheProcessorsEngineInBothSizes) {
  Seen all;
  for (const bool compact : {false, true})
    for (const char* name : {"bumpy:200", "stretched:4:bumpy:200", "dart:5", "fan:4", "quad-torus:9:9",
                             "mixed:1:60", "stretched:4:pawn", "creased-cube"})
      for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
        const Seen seen = compared(name, {unequal(name, 3)}, {.compact = compact}, {.repair = repair});
        EXPECT_EQ(seen.differ, 0) << name << (compact ? " of 16 bytes" : "") << " of " << seen.vertices;
        EXPECT_GT(seen.grids + seen.repaired, 1) << name;
        all.grids += seen.grids, all.repaired += seen.repaired;
      }
  EXPECT_TRUE(all.grids > 400 && all.repaired > 400) << all.grids << ' ' << all.repaired;
}

// Where fans have centres that no kernel makes, with the normals of one.
TEST_F(GlFrame, HasThemWhereTheMiddleOfAFanIsTheProcessors) {
  for (const FanCentre centre : {FanCentre::kFlatLimit, FanCentre::kFlatControl})
    for (const char* name : {"torus", "quad-torus:9:9", "mixed:1"})
      EXPECT_EQ(compared(name, {unequal(name, 2)}, {}, {Repair::kFan, centre}).differ, 0) << name;
}

// Many batches of each kind, those with origins of their own among them.
TEST_F(GlFrame, HasThemWhereAllFacesAreWholeGrids) {
  for (const char* name : {"bumpy:200", "stretched:4:bumpy:200", "dual:bumpy:60"})
    for (const int depth : {2, 4})
      EXPECT_EQ(compared(name, {equal(name, depth)}, {}).differ, 0) << name << depth;
}

// In parts, as where a frame is more than a buffer holds: several of each kind, in runs of batches that are alike.
TEST_F(GlFrame, HasTheSamePointsFromSmallBuffers) {
  for (const char* name : {"stretched:4:bumpy:200", "mixed:1:60"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    StreamTessellator engine(mesh, {.scheme = data::natural_scheme(mesh)}, verify::FrameRecorder::triangles(),
                             &verify::FrameRecorder::quads());
    verify::FrameRecorder recorder;
    DrawList<float> list;
    engine.frame(unequal(name, 3), list);
    const std::vector<verify::FrameRecorder::Batch> batches = recorder.batches;  // in their own order
    const std::vector<float> whole = verify::points_by_gl(recorder);
    for (const std::size_t bytes : {std::size_t{8192}, std::size_t{20000}}) {
      recorder.batches = batches;
      const std::vector<float> parts = verify::points_by_gl(recorder, bytes);
      ASSERT_GT(4 * parts.size(), 2 * bytes) << name;
      EXPECT_EQ(std::memcmp(parts.data(), whole.data(), 4 * whole.size()), 0) << name << bytes;
    }
  }
}

// Vertices stay where they are, also when the buffer grows.
TEST_F(GlFrame, KeepsPatchesFromFrameToFrame) {
  for (const char* name : {"bumpy:200", "quad-torus:9:9"}) {
    const Seen seen =
        compared(name, {equal(name, 1), unequal(name, 2, 40), unequal(name, 2, 40, 1), equal(name, 3)},
                 {.compact = true, .incremental = true, .sticky = true});
    EXPECT_EQ(seen.differ, 0) << name << " of " << seen.vertices;
    EXPECT_GT(seen.kept, 0);
  }
}

TEST_F(GlFrame, FollowsPointsThatMove) {
  for (const char* name : {"torus", "pawn"}) {
    data::ControlMesh mesh = data::named_mesh(name);
    const TessellatorOptions options{.scheme = data::natural_scheme(mesh)};
    verify::ResidentFrame frame(mesh, options);
    const Depths depths(mesh.faces.size(), 2);
    frame.plan(depths);
    for (auto& p : mesh.positions) p[0] += .25 * p[1];
    frame.move_points(mesh.positions);
    frame.plan(depths);
    frame.run();
    verify::ResidentFrame anew(mesh, options);
    anew.plan(depths);
    anew.run();
    EXPECT_EQ(frame.read(), anew.read()) << name;
  }
}

TEST_F(GlFrame, SaysWhatItCannotDo) {
  const data::ControlMesh mesh = data::named_mesh("tetrahedron");
  EXPECT_THROW(verify::ResidentFrame(mesh, {.provenance = true}), data::ArgumentError);
  verify::ResidentFrame frame(mesh, {}, {.incremental = true});
  for (const Depths& depths : {Depths(4, 9), Depths(3, 1)}) {
    frame.plan(Depths(4, 2));
    EXPECT_THROW(frame.plan(depths), data::ArgumentError);
    EXPECT_TRUE(frame.read().empty());
  }
  frame.plan(Depths(4, -1));
  frame.run();
  EXPECT_TRUE(frame.read().empty());
  StreamTessellator engine(mesh, {}, verify::FrameRecorder::triangles());
  PatchMesh<float> compact({.compact = true});
  EXPECT_THROW(verify::frame_by_gl(engine, compact, Depths(4, 1)), data::ArgumentError);
  DrawList<float> list;
  EXPECT_THROW(engine.frame(Depths(4, 1), list), std::logic_error) << "and no recorder";
}

// What is kept of earlier frames goes where it would be too much: a buffer of Mesa's holds 128 MiB.
TEST_F(GlFrame, HasRoomForEveryFrameThatFits) {
  const data::ControlMesh mesh = data::named_mesh("bumpy:400");
  verify::ResidentFrame frame(mesh, {}, {.incremental = true});
  const std::size_t most = verify::most_bytes_of_a_buffer();
  if (most > std::size_t{1} << 28) GTEST_SKIP() << "a buffer of " << most << " bytes";
  const auto deep = [&](std::size_t first, std::size_t last) {
    Depths depths(mesh.faces.size(), -1);
    std::fill(depths.begin() + static_cast<std::ptrdiff_t>(first),
              depths.begin() + static_cast<std::ptrdiff_t>(last), 8);
    return depths;
  };
  frame.plan(deep(0, 90));
  const std::size_t bytes = frame.read().size();
  EXPECT_GT(3 * bytes, most);
  frame.plan(deep(90, 190));
  EXPECT_LE(frame.read().size(), most);
  EXPECT_THROW(frame.plan(deep(0, 200)), std::runtime_error);
  frame.plan(deep(0, 90));
  EXPECT_EQ(frame.read().size(), bytes);
}

TEST_F(GlFrame, HasNoContextInAProcessThatWasForked) {
  const data::ControlMesh mesh = data::named_mesh("tetrahedron");
  EXPECT_EXIT(
      {
        int code = 1;
        try {
          verify::ResidentFrame(mesh, {}).plan(Depths(4, 1));
        } catch (const std::runtime_error&) {
          code = 0;
        }
        std::exit(code);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
