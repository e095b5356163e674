// SPDX-License-Identifier: MIT
// Frames of Loop's scheme, and what each kind of engine does in its own way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "data/error.h"
#include "fast/frame/draw_writer.h"
#include "fast/frame/frame_engine.h"
#include "fast/frame/index_writer.h"
#include "fast/frame/patch_writer.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/plan/printed_rules.h"

namespace limitcheck::fast {

/// Of pairs of triangles. An engine overrides how points are evaluated; Engine calls it.
template <class Real>
struct EngineState : FrameEngine<Real> {
  /// throws   data::ArgumentError: what FrameState and TriangleMesh refuse
  EngineState(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by)
      : FrameEngine<Real>(given, with), rules(by), triangles(mesh) {}
  using FrameEngine<Real>::max_depth, FrameEngine<Real>::mesh, FrameEngine<Real>::offsets,
      FrameEngine<Real>::options, FrameEngine<Real>::pairing, FrameEngine<Real>::placement,
      FrameEngine<Real>::plan, FrameEngine<Real>::stores;

  int face_count() const final { return adjacency.face_count(); }
  std::vector<std::int32_t> depths(const DepthOptions& strategy, const Camera& camera) final {
    if (!heuristics)
      heuristics.emplace(triangles.points(), adjacency, options.max_depth, triangles.kinds());
    else if (heuristics_are_old)
      heuristics->points_moved();
    heuristics_are_old = false;
    return heuristics->depths(strategy, camera);
  }
  void points_moved() override {
    triangles.points_moved();
    heuristics_are_old = true;
  }
  FrameStats plan_frame(std::span<const std::int32_t> depth, std::span<const Grid> keep) final;
  std::size_t patch_count() const final { return patches.size(); }
  DrawSize patch_size(std::size_t i) const final { return draw_size(patches[i], plan); }
  DrawSize measure_index() final {
    layout_ = IndexLayout::of(adjacency, pairing.depth, plan);
    return {layout_.vertex_count, 0, layout_.triangle_count};
  }
  void write_index(IndexedMesh<Real>& out) final {
    write_control_vertices(out);
    index(layout_, out);
  }

  void list_patches(std::vector<PatchWanted>& out) const final {
    out.clear();
    for (std::size_t i = 0; i < patches.size(); ++i)
      out.push_back(wanted_patch(pairing.grids[i], patches[i], plan));
  }
  void add_patch_draws(std::span<const PatchPlace> places, IndexForm form, PatchIndices& patterns,
                       std::vector<std::uint32_t>& indices, std::vector<PatchDraw>& out) const final {
    for (std::size_t i = 0; i < patches.size(); ++i)
      fast::add_patch_draws(patches[i], plan, places[i].first, form, patterns, indices,
                            [&](const PatchDraw& draw) { out.push_back(draw); });
  }

  /// Evaluates all patches into an indexed mesh that has room for them, through index_writer().
  virtual void index(const IndexLayout& layout, IndexedMesh<Real>& out) = 0;
  /// The limit point of a vertex of the adjacency, in the caller's coordinates.
  virtual SurfaceVertex<Real> limit(std::int32_t v) const = 0;

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
            scratch,
            stores};
  }
  IndexWriter<Real> index_writer(std::size_t i, const IndexLayout& layout, IndexedMesh<Real>& out) const {
    return {adjacency, patches[i], plan, layout, placement, out};
  }

  PrintedRules rules;
  TriangleMesh triangles;
  const Adjacency& adjacency = triangles.adjacency();
  std::optional<DepthHeuristics> heuristics;
  bool heuristics_are_old = false;  // the points have moved since
  std::vector<Patch> patches;

 private:
  void write_control_vertices(IndexedMesh<Real>& out) const;

  IndexLayout layout_;
};

extern template struct EngineState<float>;
extern template struct EngineState<double>;

}  // namespace limitcheck::fast
