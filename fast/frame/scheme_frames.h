// SPDX-License-Identifier: MIT
// What Engine asks of the frames of a mesh; frames of either scheme, and what each kind of engine does in its own way.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/draw_writer.h"
#include "fast/frame/engine.h"
#include "fast/frame/index_writer.h"
#include "fast/frame/patch.h"
#include "fast/frame/patch_store.h"
#include "fast/frame/sink.h"
#include "fast/frame/stores.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/mesh/vec3.h"
#include "fast/plan/crack.h"
#include "fast/plan/pairing.h"
#include "fast/plan/printed_rules.h"
#include "fast/plan/quad_depth.h"

namespace limitcheck::fast {

/// A mesh, and the plan of the frame it is at.
struct FrameState {
  /// throws   data::ArgumentError: no faces, a coordinate that is not finite, a negative number of threads
  FrameState(const data::ControlMesh& given, const TessellatorOptions& with);
  virtual ~FrameState() = default;

  virtual int face_count() const = 0;
  /// The depths that a strategy assigns to the control faces. Called in the arena.
  virtual std::vector<std::int32_t> depths(const DepthOptions& strategy, const Camera& camera) = 0;
  /// Makes grids of the faces, plans the cracks and makes the patches. The statistics that it returns lack
  /// the number of vertices, the zero normals, and the times of what is still to do.
  ///   throws   data::ArgumentError: not one depth per face, a depth outside -1 .. kDeepest
  ///   keep     pairs of faces that are to stay together, each of faces of one depth; for Loop's scheme
  virtual FrameStats plan_frame(std::span<const std::int32_t> depth, std::span<const Grid> keep) = 0;
  /// The same; what was planned stays if the depths and pairs are those of the last plan.
  FrameStats plan_or_keep(std::span<const std::int32_t> depth, std::span<const Grid> keep);
  /// When mesh.positions have changed: what depends on them is made anew.
  virtual void points_moved() = 0;
  virtual std::size_t patch_count() const = 0;
  virtual DrawSize patch_size(std::size_t i) const = 0;

  data::ControlMesh mesh;
  TessellatorOptions options;
  tbb::task_arena arena;
  PairingResult pairing;
  CrackPlan plan;
  int max_depth = 0;                        // of grids and edges
  const std::uint64_t id = next_version();  // of this mesh with its options, among all in the process
  std::uint64_t version = id;               // of its control points
  void renew_version() { version = next_version(); }

 private:
  static std::uint64_t next_version();

  struct Planned {
    std::vector<std::int32_t> depth;
    std::vector<Grid> keep;
    FrameStats stats;
  };
  std::optional<Planned> planned_;
};

/// The same with points of a number type.
template <class Real>
struct FrameEngine : FrameState {
  using FrameState::FrameState;

  /// Called when a frame has been planned.
  virtual void prepare() = 0;
  /// Evaluates patches first .. last - 1 into a draw list that has room for them, offsets[] saying where.
  virtual void draw(std::size_t first, std::size_t last, DrawList<Real>& out) = 0;
  /// Evaluates all patches into an indexed mesh.
  ///   throws   data::ArgumentError: more vertices than 32-bit indices reach
  virtual void write_index(IndexedMesh<Real>& out) = 0;
  /// The patches of this frame, in their order; then writes those that are fresh to their places, and adds
  /// the calls that draw them all.
  virtual void list_patches(std::vector<PatchWanted>& out) const = 0;
  virtual void write_patches(std::span<const BlockOffset> places, const PatchTarget<Real>& out) = 0;
  virtual void add_patch_draws(std::span<const BlockOffset> places, IndexForm form, PatchIndices& patterns,
                               std::vector<std::uint32_t>& indices, std::vector<PatchDraw>& out) const = 0;
  /// Vertices of this frame whose normal came from the rule for vanishing tangents.
  virtual std::int64_t zero_normals() const = 0;

  /// How a draw list is written: past the caches if it is large, but for the part that a sink reads at once.
  Stores stores_of(const DrawList<Real>& out) const {
    return &out == &part ? Stores::kOrdinary : stores_for(sizeof(SurfaceVertex<Real>) * out.vertices.size());
  }

  Placement<Real> placement;          // from the coordinates of what the writers are given to the caller's
  std::vector<DrawSize> offsets;      // where each patch of the draw list begins, and the end
  Stores stores = Stores::kOrdinary;  // of the vertices of a draw list
  DrawList<Real> part;                // the part of a frame that a sink is given at a time
};

/// Of Loop's scheme: pairs of triangles.
struct LoopScheme {
  using Faces = LoopFaces;
  using Patch = LoopPatch;
  using Heuristics = DepthHeuristics;

  /// Refers to the mesh. Throws data::ArgumentError: what TriangleMesh refuses.
  LoopScheme(const data::ControlMesh& mesh, const PrintedRules& by) : rules(by), cut_mesh(mesh) {}
  void take_points(const data::ControlMesh& /*mesh*/) { cut_mesh.points_moved(); }

  PairingResult pair(std::span<const std::int32_t> depth, std::span<const Grid> keep) const {
    return pair_faces(adjacency, depth, rules, keep);
  }
  void make(std::optional<Heuristics>& heuristics, int max_depth) const {
    heuristics.emplace(cut_mesh.points(), adjacency, max_depth, cut_mesh.kinds());
  }

  PrintedRules rules;
  TriangleMesh cut_mesh;
  const Adjacency& adjacency = cut_mesh.adjacency();
  LoopFaces faces{&adjacency, &cut_mesh};
};

/// Of Catmull-Clark's: a grid for each quad. [C21]
struct QuadScheme {
  using Faces = QuadFaces;
  using Patch = QuadPatch;
  using Heuristics = QuadDepthHeuristics;

  /// Throws data::ArgumentError: what QuadMesh refuses.
  QuadScheme(const data::ControlMesh& mesh, const PrintedRules& /*by*/)
      : cut_mesh(mesh), faces(mesh.faces, cut_mesh), semi_sharp(cut_mesh) {}
  void take_points(const data::ControlMesh& mesh) {
    cut_mesh = QuadMesh(mesh);
  }  // the same but for the positions

  /// One grid for each face that is displayed.
  PairingResult pair(std::span<const std::int32_t> depth, std::span<const Grid> keep) const;
  void make(std::optional<Heuristics>& heuristics, int max_depth) const {
    heuristics.emplace(faces, semi_sharp, max_depth);
  }

  static constexpr PrintedRules rules{};
  QuadMesh cut_mesh;
  QuadFaces faces;
  SemiSharp semi_sharp;
};

/// An engine overrides how points are evaluated; Engine calls it.
template <class Real, class Scheme>
struct SchemeFrames : FrameEngine<Real>, Scheme {
  using Patch = typename Scheme::Patch;
  using Faces = typename Scheme::Faces;
  using DrawWriter = fast::DrawWriter<Real, Patch, Faces>;
  using IndexWriter = fast::IndexWriter<Real, Patch, Faces>;
  using PatchWriter = fast::PatchWriter<Real, Patch, Faces>;
  using FrameEngine<Real>::max_depth, FrameEngine<Real>::mesh, FrameEngine<Real>::offsets,
      FrameEngine<Real>::options, FrameEngine<Real>::pairing, FrameEngine<Real>::placement,
      FrameEngine<Real>::plan, FrameEngine<Real>::stores, Scheme::faces;

  /// throws   data::ArgumentError: what FrameState and the scheme refuse
  SchemeFrames(const data::ControlMesh& given, const TessellatorOptions& with, const PrintedRules& by = {})
      : FrameEngine<Real>(given, with), Scheme(mesh, by) {}

  int face_count() const final { return faces.size(); }
  std::vector<std::int32_t> depths(const DepthOptions& strategy, const Camera& camera) final {
    if (!heuristics_)
      this->make(heuristics_, options.max_depth);
    else if (heuristics_are_old_)
      heuristics_->points_moved();
    heuristics_are_old_ = false;
    return heuristics_->depths(strategy, camera);
  }
  void points_moved() override {
    this->take_points(mesh);
    heuristics_are_old_ = true;
  }
  FrameStats plan_frame(std::span<const std::int32_t> depth, std::span<const Grid> keep) final;
  std::size_t patch_count() const final { return patches.size(); }
  DrawSize patch_size(std::size_t i) const final { return draw_size(patches[i], faces, plan); }
  void write_index(IndexedMesh<Real>& out) final;

  void list_patches(std::vector<PatchWanted>& out) const final {
    out.clear();
    for (std::size_t i = 0; i < patches.size(); ++i)
      out.push_back(wanted_patch(pairing.grids[i], patches[i], faces, plan));
  }
  void add_patch_draws(std::span<const BlockOffset> places, IndexForm form, PatchIndices& patterns,
                       std::vector<std::uint32_t>& indices, std::vector<PatchDraw>& out) const final {
    for (std::size_t i = 0; i < patches.size(); ++i)
      fast::add_patch_draws(patches[i], faces, plan, places[i].first, form, patterns, indices, out);
  }

  /// Evaluates all patches into an indexed mesh that has room for them, through index_writer().
  virtual void index(const IndexLayout& layout, IndexedMesh<Real>& out) = 0;
  /// The limit point of a vertex of the adjacency, in the caller's coordinates.
  virtual SurfaceVertex<Real> limit(std::int32_t v) const = 0;

  /// Writes patch i to its place in a draw list that begins with patch `first`.
  DrawWriter draw_writer(std::size_t first, std::size_t i, DrawList<Real>& out) const {
    const DrawSize& at = offsets[i - first];
    const DrawPlace<Real> place{out.vertices.data() + at.vertices,
                                options.provenance ? out.provenance.data() + at.vertices : nullptr,
                                out.draws.data() + at.draws, at.vertices, stores};
    return {patches[i], faces, plan, placement, place};
  }
  IndexWriter index_writer(std::size_t i, const IndexLayout& layout, IndexedMesh<Real>& out) const {
    return {patches[i], faces, plan, layout, placement, out};
  }
  PatchWriter patch_writer(const Patch& patch, std::int64_t first, const PatchTarget<Real>& out) const {
    return {patch, faces, plan, placement, out.from(first)};
  }

  std::vector<Patch> patches;  // one per grid

 private:
  void write_control_vertices(const IndexLayout& layout, IndexedMesh<Real>& out) const;

  std::optional<typename Scheme::Heuristics> heuristics_;
  bool heuristics_are_old_ = false;  // the points have moved since
};

extern template struct SchemeFrames<float, LoopScheme>;
extern template struct SchemeFrames<double, LoopScheme>;
extern template struct SchemeFrames<float, QuadScheme>;
extern template struct SchemeFrames<double, QuadScheme>;

}  // namespace limitcheck::fast
