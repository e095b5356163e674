// SPDX-License-Identifier: MIT
// Frames of Catmull-Clark's scheme, and what each kind of engine does in its own way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fast/frame/frame_engine.h"
#include "fast/frame/quad_draw_writer.h"
#include "fast/frame/quad_index_writer.h"
#include "fast/frame/quad_patch_writer.h"
#include "fast/plan/quad_depth.h"

namespace limitcheck::fast {

/// A grid for each quad. An engine overrides how points are evaluated; Engine calls it. [C21]
template <class Real>
struct QuadEngineState : FrameEngine<Real> {
  /// throws   data::ArgumentError: what FrameState and QuadMesh refuse
  QuadEngineState(const data::ControlMesh& given, const TessellatorOptions& with)
      : FrameEngine<Real>(given, with), quads(mesh), faces(mesh.faces, quads), semi_sharp(quads) {}
  using FrameEngine<Real>::max_depth, FrameEngine<Real>::mesh, FrameEngine<Real>::offsets,
      FrameEngine<Real>::options, FrameEngine<Real>::pairing, FrameEngine<Real>::placement,
      FrameEngine<Real>::plan, FrameEngine<Real>::stores;

  int face_count() const final { return faces.size(); }
  std::vector<std::int32_t> depths(const DepthOptions& strategy, const Camera& camera) final {
    if (!heuristics)
      heuristics.emplace(faces, semi_sharp, options.max_depth);
    else if (heuristics_are_old)
      heuristics->points_moved();
    heuristics_are_old = false;
    return heuristics->depths(strategy, camera);
  }
  void points_moved() override {
    quads = QuadMesh(mesh);  // the same but for the positions
    heuristics_are_old = true;
  }
  FrameStats plan_frame(std::span<const std::int32_t> depth, std::span<const Grid> /*keep*/) final;
  std::size_t patch_count() const final { return patches.size(); }
  DrawSize patch_size(std::size_t i) const final { return quad_draw_size(patches[i], faces, plan); }
  DrawSize measure_index() final {
    layout_ = QuadIndexLayout::of(faces, pairing.depth, plan);
    return {layout_.vertex_count, 0, layout_.triangle_count};
  }
  void write_index(IndexedMesh<Real>& out) final {
    write_control_vertices(out);
    index(layout_, out);
  }

  void list_patches(std::vector<PatchWanted>& out) const final {
    out.clear();
    for (const QuadPatch& patch : patches) out.push_back(wanted_quad_patch(patch, faces, plan));
  }
  void add_patch_draws(std::span<const PatchPlace> places, IndexForm form, PatchIndices& patterns,
                       std::vector<std::uint32_t>& indices, std::vector<PatchDraw>& out) const final {
    for (std::size_t i = 0; i < patches.size(); ++i)
      out.push_back(quad_patch_draw(patches[i], faces, plan, places[i].first, form, patterns, indices));
  }

  /// Evaluates all patches into an indexed mesh that has room for them, through index_writer().
  virtual void index(const QuadIndexLayout& layout, IndexedMesh<Real>& out) = 0;
  /// The limit point of a vertex of the mesh of quads, in the caller's coordinates.
  virtual SurfaceVertex<Real> limit(std::int32_t v) const = 0;

  /// Writes patch i to its place in a draw list that begins with patch `first`.
  QuadDrawWriter<Real> draw_writer(std::size_t first, std::size_t i, DrawList<Real>& out) const {
    const DrawSize& at = offsets[i - first];
    return {patches[i],
            faces,
            plan,
            placement,
            out.vertices.data() + at.vertices,
            options.provenance ? out.provenance.data() + at.vertices : nullptr,
            out.draws.data() + at.draws,
            at.vertices,
            stores};
  }
  QuadIndexWriter<Real> index_writer(std::size_t i, const QuadIndexLayout& layout,
                                     IndexedMesh<Real>& out) const {
    return {patches[i], faces, plan, layout, placement, out};
  }

  QuadMesh quads;
  QuadFaces faces;
  SemiSharp semi_sharp;
  std::optional<QuadDepthHeuristics> heuristics;
  bool heuristics_are_old = false;  // the points have moved since
  std::vector<QuadPatch> patches;   // one per face that is displayed

 private:
  void write_control_vertices(IndexedMesh<Real>& out) const;

  QuadIndexLayout layout_;
};

extern template struct QuadEngineState<float>;
extern template struct QuadEngineState<double>;

}  // namespace limitcheck::fast
