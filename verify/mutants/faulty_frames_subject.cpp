// SPDX-License-Identifier: MIT
// The subject `faulty-frames`: row streaming's patches after a walk of frames, with a fault of what is kept
// from one frame to the next: what a graphics library shows that is told too little, or the wrong thing.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/peers/deliver_frame.h"
#include "verify/peers/frame_walk.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using fast::PatchDraw;
using Vertex = fast::SurfaceVertex<float>;

// A frame that stays as it is while the engine goes on.
struct Shown {
  std::vector<PatchDraw> draws;
  std::vector<Vertex> vertices;
  std::vector<fast::LatticePoint> provenance;

  static Shown of(const fast::PatchMesh<float>& mesh) {
    return {{mesh.draws().begin(), mesh.draws().end()},
            {mesh.vertices().begin(), mesh.vertices().end()},
            {mesh.provenance().begin(), mesh.provenance().end()}};
  }
};

[[noreturn]] void nowhere(const char* what) {
  throw SubjectError(LC_NOT_SUPPORTED, std::string("there is no ") + what + " to plant this fault in");
}

bool same_faces(const PatchDraw& a, const PatchDraw& b) {
  return a.face == b.face && a.face_after == b.face_after && a.kind == b.kind && a.depth == b.depth;
}

// The points have moved, but those of one patch were not written again.
void stale_patch(const Shown& before, Shown& now) {
  for (const PatchDraw& draw : now.draws)
    for (const PatchDraw& old : before.draws)
      if (same_faces(draw, old) && draw.first_index == old.first_index) {
        std::copy_n(before.vertices.begin() + old.base_vertex, draw.vertex_count,
                    now.vertices.begin() + draw.base_vertex);
        return;
      }
  nowhere("patch that stays");
}

// Two patches of one size were given the same place; who came last has written there.
void place_twice(const Shown&, Shown& now) {
  for (PatchDraw& draw : now.draws)
    for (const PatchDraw& other : now.draws)
      if (draw.base_vertex != other.base_vertex && draw.first_index == other.first_index) {
        draw.base_vertex = other.base_vertex;
        return;
      }
  nowhere("two patches of one size");
}

// A face in repair was left as it was although a neighbour has become deeper.
void old_edge_depth(const Shown& before, Shown& now) {
  for (PatchDraw& draw : now.draws)
    for (const PatchDraw& old : before.draws) {
      const bool repaired = draw.kind == fast::Kind::kFan || draw.kind == fast::Kind::kStitched;
      if (!repaired || !same_faces(draw, old) || draw.vertex_count <= old.vertex_count) continue;
      draw = old;
      draw.base_vertex += static_cast<std::int64_t>(now.vertices.size());
      now.vertices.insert(now.vertices.end(), before.vertices.begin(), before.vertices.end());
      now.provenance.insert(now.provenance.end(), before.provenance.begin(), before.provenance.end());
      return;
    }
  nowhere("face in repair whose edges have become deeper");
}

struct Entry {
  FrameFault fault;
  void (*plant)(const Shown& before, Shown& now);
  bool moved;  // in the frame before the points were elsewhere, else the depths were others
};
constexpr std::array<Entry, 4> kFaults{{
    {{"none", "nothing: row streaming's patches as they are", ""}, [](const Shown&, Shown&) {}, false},
    {{"stale_patch", "a patch is not written again after the points have moved", "positions"},
     stale_patch,
     true},
    {{"place_twice", "two patches have one place in the buffer", "coverage"}, place_twice, false},
    {{"old_edge_depth", "a face in repair keeps its border when a neighbour becomes deeper", "t-vertices"},
     old_edge_depth,
     false},
}};

class FaultyFramesSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    Settings settings(options);
    return {LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, fast::kDeepest, 1, 1, 1};
  }

  FaultyFramesSubject(const lc_mesh& mesh, Options& options)
      : settings_(options), mesh_(control_mesh(mesh)), engine_(engine_for(mesh_)) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const std::span<const std::int32_t> depth(request.face_depth, mesh_.faces.size());
    refuse_too_many_vertices(depth);
    fast::PatchMesh<float> patches{fast::PatchOptions{.incremental = true}};
    const Entry& entry = kFaults[settings_.fault];
    walk(engine_, mesh_, depth, settings_.frames, patches);
    data::SplitMix64 random(1);
    if (entry.moved) {
      engine_.move_points(halved_points(mesh_));
      engine_.frame(depth, patches);
    } else {
      engine_.frame(other_depths(depth, random), patches);
    }
    const Shown before = Shown::of(patches);
    if (entry.moved) engine_.move_points(mesh_.positions);
    engine_.frame(depth, patches);
    Shown now = Shown::of(patches);
    entry.plant(before, now);
    deliver_patches<float>({now.draws, patches.indices(), now.vertices, now.provenance}, request, out, false);
  }

 private:
  struct Settings {
    explicit Settings(Options& options)
        : frames(options.integer("frames", 3, 0, 1000)),
          fault(static_cast<std::size_t>(options.choice("fault", names()))) {}
    static std::vector<std::string_view> names() {
      std::vector<std::string_view> names;
      for (const Entry& entry : kFaults) names.push_back(entry.fault.name);
      return names;
    }
    int frames;
    std::size_t fault;
  };

  static fast::row_stream::StreamTessellator engine_for(const data::ControlMesh& mesh) {
    fast::TessellatorOptions options;
    options.provenance = true;
    options.threads = 1;
    options.cracks.repair = fast::Repair::kStitch;
    try {
      return fast::row_stream::StreamTessellator(mesh, options);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
  }

  Settings settings_;
  data::ControlMesh mesh_;
  fast::row_stream::StreamTessellator engine_;
};

}  // namespace

std::span<const FrameFault> frame_faults() {
  static const std::vector<FrameFault> list = [] {
    std::vector<FrameFault> result;
    for (const Entry& entry : kFaults) result.push_back(entry.fault);
    return result;
  }();
  return list;
}

}  // namespace limitcheck::verify

extern "C" const lc_subject* lc_subject_faulty_frames() {
  using limitcheck::verify::FaultyFramesSubject;
  static const lc_subject subject = limitcheck::verify::make_subject<FaultyFramesSubject>(
      "faulty-frames", "row streaming's patches after a walk of frames, with a fault planted in what is kept",
      "fault=NAME (default none), frames=N (default 3)");
  return &subject;
}
