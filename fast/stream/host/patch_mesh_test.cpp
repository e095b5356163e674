// SPDX-License-Identifier: MIT
// Patches from frame to frame, and patches that the kernel writes to their place itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "fast/frame/patch_mesh.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/patch_frames.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast::row_stream {
namespace {

template <class Engine>
void expect_the_triangles_of_a_draw_list(Engine& engine, std::size_t faces, const PatchOptions& with) {
  data::SplitMix64 random(7);
  for (int i = 0; i < 6; ++i) {
    const auto depth = i < 4 ? std::vector<std::int32_t>(faces, i) : random_depths(faces, -1, 4, random);
    DrawList<float> list;
    PatchMesh<float> patches(with);
    const FrameStats a = engine.frame(depth, list), b = engine.frame(depth, patches);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_LE(b.vertices, a.vertices + static_cast<std::int64_t>(faces));
    ASSERT_EQ(soup_of(patches), soup_of(list));
  }
}

TEST(PatchMesh, HasTheTrianglesOfADrawListToTheBit) {
  for (const Model& model : models()) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch, Repair::kNone}) {
      for (const IndexForm form : {IndexForm::kTriangles, IndexForm::kStrips}) {
        SCOPED_TRACE(model.name);
        const PatchOptions with{form, form == IndexForm::kStrips};
        StreamTessellator stream(model.mesh, options_of(model, repair));
        expect_the_triangles_of_a_draw_list(stream, model.mesh.faces.size(), with);
        Tessellator<float> window(model.mesh, options_of(model, repair));
        expect_the_triangles_of_a_draw_list(window, model.mesh.faces.size(), with);
      }
    }
  }
}

// A walk through frames: the triangles are those of a fresh frame to the bit, and a copy of the buffer to
// which only the changed ranges went has them as well.
template <class Engine>
void expect_fresh_frames_on_a_walk() {
  std::int64_t kept = 0, all = 0;
  for (const Model& model : models()) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      SCOPED_TRACE(model.name);
      Engine engine(model.mesh, options_of(model, repair));
      const PatchOptions with{.incremental = true};
      PatchMesh<float> patches(with);
      data::SplitMix64 random(11);
      auto depth = random_depths(model.mesh.faces.size(), 0, 3, random);
      std::vector<SurfaceVertex<float>> copy;
      for (int frame = 0; frame < 60; ++frame, step(depth, random)) {
        DrawList<float> list;
        engine.frame(depth, list);
        const FrameStats stats = engine.frame(depth, patches);
        copy.resize(patches.vertices().size());
        all += stats.vertices;
        kept += stats.vertices;
        for (const VertexRange& range : patches.changed()) {
          const auto some = patches.vertices().subspan(static_cast<std::size_t>(range.first),
                                                       static_cast<std::size_t>(range.count));
          std::copy(some.begin(), some.end(), copy.begin() + range.first);
          kept -= range.count;
        }
        ASSERT_EQ(soup_of(patches, copy), soup_of(list)) << "frame " << frame;
      }
    }
  }
  EXPECT_GT(static_cast<double>(kept), .4 * static_cast<double>(all)) << "or nothing is tested";
}

TEST(PatchMesh, StaysAFreshFrameOnAnyWalk) {
  expect_fresh_frames_on_a_walk<StreamTessellator>();
  expect_fresh_frames_on_a_walk<Tessellator<float>>();
}

// Sticky pairs depend on the frames before, incremental or not: both outputs have taken the same walk. They
// leave no crack.
TEST(PatchMesh, KeepsPairsAndClosesCracksIfSticky) {
  const Model model = models()[0];
  StreamTessellator engine(model.mesh, options_of(model, Repair::kFan));
  PatchOptions with{.sticky = true};
  PatchMesh<float> fresh(with);
  with.incremental = true;
  PatchMesh<float> patches(with);
  data::SplitMix64 random(3);
  auto depth = random_depths(model.mesh.faces.size(), 0, 3, random);
  std::int64_t differs = 0;
  for (int frame = 0; frame < 100; ++frame, step(depth, random)) {
    for (auto& d : depth) d = std::max(d, 0);
    engine.frame(depth, patches);
    const std::vector<Grid> pairs = engine.last_pairing().grids;
    engine.frame(depth, fresh);
    ASSERT_EQ(pairs, engine.last_pairing().grids);
    ASSERT_EQ(soup_of(patches), soup_of(fresh)) << "frame " << frame;
    std::vector<std::array<SurfaceVertex<float>, 3>> triangles;
    for (const PatchDraw& draw : patches.draws())
      for (std::uint32_t i = 0; i < draw.index_count; i += 3) {
        const auto at = [&](std::uint32_t k) {
          return patches.vertices()[static_cast<std::size_t>(draw.base_vertex) +
                                    patches.indices()[draw.first_index + i + k]];
        };
        triangles.push_back({at(0), at(1), at(2)});
      }
    ASSERT_TRUE(weld(triangles, true).closed());
    DrawList<float> list;
    engine.frame(depth, list);
    differs += engine.last_pairing().grids != pairs ? 1 : 0;
  }
  EXPECT_GT(differs, 10) << "or nothing is tested";
}

// The bound of the header, whatever comes: a turn around, then other depths, then few faces.
TEST(PatchMesh, StaysInItsMemory) {
  const data::ControlMesh mesh = shaken(grid_torus(24, 30), .02, 2);
  StreamTessellator engine(mesh);
  const PatchOptions with{.incremental = true};
  PatchMesh<float> patches(with);
  const std::size_t faces = mesh.faces.size();
  std::int64_t most = 0;
  for (int frame = 0; frame < 120; ++frame) {
    std::vector<std::int32_t> depth(faces, -1);
    const int level = frame < 60 ? 3 : frame < 90 ? 4 - frame % 4 : 2;
    for (std::size_t f = 0; f < faces / 2; ++f)
      depth[(f + static_cast<std::size_t>(frame) * faces / 24) % faces] = level;
    const FrameStats stats = engine.frame(depth, patches);
    most = std::max(most, static_cast<std::int64_t>(patches.vertices().size()));
    ASSERT_LE(static_cast<std::int64_t>(patches.vertices().size()),
              3 * stats.vertices + PatchMesh<float>::kSlack)
        << frame;
  }
  EXPECT_GT(most, PatchMesh<float>::kSlack);
}

// Whoever wrote last is the one whose patches stay; another engine, or clear(), begins anew.
TEST(PatchMesh, BeginsAnewForAnotherEngine) {
  const auto one = shaken(grid_torus(4, 5), .2, 2), two = shaken(grid_torus(4, 5), .2, 3);
  const auto quads = data::named_mesh("mixed:1");
  TessellatorOptions catmull_clark{.scheme = data::Scheme::kCatmullClark};
  StreamTessellator first(one), second(two), third(quads, catmull_clark);
  const PatchOptions with{.incremental = true};
  PatchMesh<float> patches(with);
  const auto check = [&](StreamTessellator& engine) {
    const std::vector<std::int32_t> depth(static_cast<std::size_t>(engine.face_count()), 2);
    DrawList<float> list;
    engine.frame(depth, list);
    engine.frame(depth, patches);
    ASSERT_EQ(soup_of(patches), soup_of(list));
  };
  for (StreamTessellator* engine : {&first, &second, &third, &first, &first}) check(*engine);
  EXPECT_TRUE(patches.changed().empty()) << "the same frame again";
  patches.clear();
  check(first);
  EXPECT_FALSE(patches.changed().empty());
}

// Cleared patches forget the pairs of the last frame as well, which sticky ones would keep.
TEST(PatchMesh, ForgetsPairsWhenCleared) {
  const auto mesh = shaken(grid_torus(4, 5), .2, 2);
  StreamTessellator engine(mesh);
  const PatchOptions with{.incremental = true, .sticky = true};
  PatchMesh<float> patches(with), fresh(with);
  data::SplitMix64 random(3);
  engine.frame(random_depths(mesh.faces.size(), 1, 2, random), patches);
  const auto depth = random_depths(mesh.faces.size(), 1, 2, random);
  engine.frame(depth, fresh);
  patches.clear();
  EXPECT_TRUE(patches.draws().empty() && patches.indices().empty() && patches.vertices().empty());
  engine.frame(depth, patches);
  EXPECT_EQ(patches.draws().size(), fresh.draws().size());
  EXPECT_EQ(soup_of(patches), soup_of(fresh));
}

// After points have moved every output is that of a new engine; a refusal changes nothing.
TEST(PatchMesh, FollowsPointsThatMove) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    const PatchOptions with{.incremental = true};
    const auto options = options_of(model, Repair::kFan);
    StreamTessellator stream(model.mesh, options);
    Tessellator<float> window(model.mesh, options);
    PatchMesh<float> patches(with), other(with);
    data::SplitMix64 random(9);
    for (int frame = 0; frame < 8; ++frame) {
      const auto mesh =
          frame % 2 == 0 ? model.mesh : shaken(model.mesh, .1, static_cast<std::uint64_t>(frame));
      stream.move_points(mesh.positions), window.move_points(mesh.positions);
      auto broken = mesh.positions;
      broken[0][1] = std::nan("");
      EXPECT_THROW(stream.move_points(broken), data::ArgumentError);
      broken.pop_back();
      EXPECT_THROW(window.move_points(broken), data::ArgumentError);
      const auto depth = random_depths(mesh.faces.size(), 0, 3, random);
      DrawList<float> expected;
      StreamTessellator(mesh, options).frame(depth, expected);
      stream.frame(depth, patches);
      ASSERT_EQ(soup_of(patches), soup_of(expected)) << frame;
      Tessellator<float>(mesh, options).frame(depth, expected);
      window.frame(depth, other);
      ASSERT_EQ(soup_of(other), soup_of(expected)) << frame;
      // The same depths again: what was planned for them stays, the points do not.
      stream.move_points(model.mesh.positions), window.move_points(model.mesh.positions);
      DrawList<float> again;
      StreamTessellator(model.mesh, options).frame(depth, expected);
      stream.frame(depth, again), stream.frame(depth, patches);
      ASSERT_EQ(soup_of(again), soup_of(expected)) << frame;
      ASSERT_EQ(soup_of(patches), soup_of(expected)) << frame;
      stream.move_points(mesh.positions), window.move_points(mesh.positions);
      Camera camera;
      DepthOptions strategy{.strategy = Strategy::kCombined};
      stream.frame(strategy, camera, patches);
      StreamTessellator(mesh, options).frame(strategy, camera, expected);
      ASSERT_EQ(soup_of(patches), soup_of(expected)) << frame;
    }
  }
}

// Memory that fails once: the frame is lost, the next one is whole.
struct FailingMemory final : VertexMemory {
  std::vector<SurfaceVertex<float>> memory;
  bool fails = false;
  std::byte* reserve(std::size_t bytes, std::size_t keep) override {
    if (fails) throw std::bad_alloc();
    std::vector<SurfaceVertex<float>> other(bytes / sizeof(SurfaceVertex<float>) + 1);
    if (keep > 0) std::memcpy(static_cast<void*>(other.data()), memory.data(), keep);
    memory = std::move(other);
    return reinterpret_cast<std::byte*>(memory.data());
  }
};

TEST(PatchMesh, GoesIntoTheCallersMemory) {
  const auto mesh = shaken(grid_torus(4, 5), .2, 2);
  StreamTessellator engine(mesh);
  FailingMemory memory;
  const PatchOptions with{.incremental = true};
  PatchMesh<float> patches(with, &memory);
  data::SplitMix64 random(2);
  auto depth = random_depths(mesh.faces.size(), 0, 3, random);
  for (int frame = 0; frame < 20; ++frame, step(depth, random)) {
    memory.fails = frame % 5 == 4;
    if (memory.fails) {
      EXPECT_THROW(engine.frame(depth, patches), std::bad_alloc);
      continue;
    }
    DrawList<float> list;
    engine.frame(depth, list);
    engine.frame(depth, patches);
    ASSERT_EQ(static_cast<const void*>(patches.vertices().data()), memory.memory.data());
    ASSERT_EQ(soup_of(patches), soup_of(list)) << frame;
  }
}

// The same vertices at the same places, each as compacted() packs it: in whole frames and on walks.
template <class Engine>
void expect_compacted_vertices() {
  for (const Model& model : models()) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      for (const bool incremental : {false, true}) {
        SCOPED_TRACE(model.name);
        TessellatorOptions options = options_of(model, repair);
        options.provenance = incremental;
        Engine engine(model.mesh, options);
        PatchOptions with{.incremental = incremental};
        PatchMesh<float> patches(with);
        with.compact = true;
        PatchMesh<float> packed(with);
        data::SplitMix64 random(13);
        auto depth = random_depths(model.mesh.faces.size(), 0, 4, random);
        for (int frame = 0; frame < 12; ++frame, step(depth, random)) {
          engine.frame(depth, patches), engine.frame(depth, packed);
          ASSERT_TRUE(packed.vertices().empty() && patches.compact_vertices().empty());
          ASSERT_EQ(packed.compact_vertices().size(), patches.vertices().size());
          ASSERT_EQ(packed.provenance().size(), patches.provenance().size());
          ASSERT_EQ(packed.draws().size(), patches.draws().size());
          for (const PatchDraw& draw : packed.draws())
            for (std::int64_t v = draw.base_vertex; v < draw.base_vertex + draw.vertex_count; ++v)
              ASSERT_EQ(packed.compact_vertices()[static_cast<std::size_t>(v)],
                        fast::compacted(patches.vertices()[static_cast<std::size_t>(v)]));
        }
      }
    }
  }
}

TEST(PatchMesh, PacksVerticesIntoSixteenBytes) {
  expect_compacted_vertices<StreamTessellator>();
  expect_compacted_vertices<Tessellator<float>>();
  const PatchOptions with{.compact = true};
  Tessellator<double> doubles(tetrahedron());
  PatchMesh<double> patches(with);
  EXPECT_THROW(doubles.frame(std::vector<std::int32_t>(4, 1), patches), data::ArgumentError);
}

TEST(PatchMesh, RefusesPatchesThatNarrowIndicesDoNotReach) {
  StreamTessellator engine(tetrahedron());
  const PatchOptions with{.narrow = true};
  PatchMesh<float> patches(with);
  EXPECT_NO_THROW(engine.frame(std::vector<std::int32_t>(4, 7), patches));
  EXPECT_THROW(engine.frame(std::vector<std::int32_t>(4, 8), patches), data::ArgumentError);
}

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
      const PatchOptions kept{.incremental = true};
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
