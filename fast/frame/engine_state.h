// SPDX-License-Identifier: MIT
// What an engine keeps from frame to frame, and what each kind of engine does in its own way.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/draw_writer.h"
#include "fast/frame/frame_options.h"
#include "fast/frame/index_writer.h"
#include "fast/plan/printed_rules.h"

namespace limitcheck::fast {

/// A mesh, and the plan of the frame it is at.
struct FrameState {
  /// throws   data::ArgumentError: no faces, a coordinate that is not finite, a mesh that Adjacency refuses,
  ///          a negative number of threads
  FrameState(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by);

  /// Pairs the faces, plans the cracks and makes the patches. The statistics that it returns lack the number
  /// of vertices, the zero normals, and the times of what is still to do.
  ///   throws   data::ArgumentError: not one depth per face, a depth outside -1 .. kDeepest
  FrameStats plan_frame(std::span<const std::int32_t> depth);

  data::ControlMesh mesh;
  TessellatorOptions options;
  PrintedRules rules;
  Adjacency adjacency;
  std::optional<DepthHeuristics> heuristics;
  tbb::task_arena arena;
  PairingResult pairing;
  CrackPlan plan;
  std::vector<Patch> patches;
  int max_depth = 0;  // of grids and edges
};

/// What the frames of both engines are made of. An engine overrides how points are evaluated; Engine calls it.
template <class Real>
struct EngineState : FrameState {
  using FrameState::FrameState;
  virtual ~EngineState() = default;

  /// Called when a frame has been planned.
  virtual void prepare() = 0;
  /// Evaluates patches first .. last - 1 into a draw list that has room for them, through draw_writer().
  virtual void draw(std::size_t first, std::size_t last, DrawList<Real>& out) = 0;
  /// Evaluates all patches into an indexed mesh that has room for them, through index_writer().
  virtual void index(const IndexLayout& layout, IndexedMesh<Real>& out) = 0;
  /// The limit point of a control vertex, in the caller's coordinates.
  virtual SurfaceVertex<Real> limit(std::int32_t v) const = 0;
  /// Vertices of this frame whose normal came from the rule for vanishing tangents.
  virtual std::int64_t zero_normals() const = 0;

  /// Writes patch i to its place in a draw list that begins with patch `first`.
  DrawWriter<Real> draw_writer(std::size_t first, std::size_t i, DrawList<Real>& out,
                               typename DrawWriter<Real>::Scratch& scratch) const {
    const DrawSize& at = offsets[i - first];
    return {patches[i],
            plan,
            placement,
            out.vertices.data() + at.vertices,
            options.provenance ? out.provenance.data() + at.vertices : nullptr,
            out.draws.data() + at.draws,
            at.vertices,
            scratch};
  }
  IndexWriter<Real> index_writer(std::size_t i, const IndexLayout& layout, IndexedMesh<Real>& out) const {
    return {adjacency, patches[i], plan, layout, placement, out};
  }

  Placement<Real> placement;      // from the coordinates of what the writers are given to the caller's
  std::vector<DrawSize> offsets;  // where each patch of the draw list begins, and the end
  DrawList<Real> part;            // the part of a frame that a sink is given at a time
};

}  // namespace limitcheck::fast
