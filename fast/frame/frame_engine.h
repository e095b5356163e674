// SPDX-License-Identifier: MIT
// What Engine asks of the frames of a mesh, whatever the subdivision scheme.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/engine.h"
#include "fast/frame/patch.h"
#include "fast/frame/patch_store.h"
#include "fast/frame/sink.h"
#include "fast/frame/stores.h"
#include "fast/mesh/vec3.h"
#include "fast/plan/crack.h"
#include "fast/plan/pairing.h"

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

}  // namespace limitcheck::fast
