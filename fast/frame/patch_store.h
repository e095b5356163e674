// SPDX-License-Identifier: MIT
// The index patterns of patches, each made once. Brings a PatchMesh from one frame of an engine to the next:
// where the patches of a mesh lie in a buffer of vertices, what they showed when they were written there, and
// how their points get there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/frame/patch_mesh.h"
#include "fast/frame/stores.h"
#include "fast/plan/crack.h"
#include "fast/plan/depth.h"
#include "fast/plan/pairing.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// A pattern: indices first .. first + count - 1.
struct IndexPattern {
  std::uint32_t first = 0, count = 0;
  std::int32_t triangles = 0;
};

/// Makes patterns where they are asked for first; they are appended to a list.
class PatchIndices {
 public:
  /// The parts of a face; or both halves of a grid, face0's triangles first.
  IndexPattern strips(const ShownFace& shown, int depth, IndexForm form, std::vector<std::uint32_t>& out);
  /// The centre, then `border` points, then the triangles between them, the last of which ends at the first point.
  IndexPattern fan(int border, std::vector<std::uint32_t>& out);
  /// The corners of a face by themselves.
  IndexPattern corners(int sides, std::vector<std::uint32_t>& out);
  /// A face of a patch whose inside is kept and whose outer ring is stitched to its border, the points of which follow
  /// those of its parts: side by side, but for the end of each.
  template <class Patch, class Faces>
  IndexPattern stitched(const Patch& patch, int s, const Faces& faces, const CrackPlan& plan,
                        std::vector<std::uint32_t>& out);

 private:
  std::array<std::array<IndexPattern, 2>, kDeepest + 1> grids_, halves_;  // by depth and form
  std::vector<IndexPattern> fans_, corners_;                              // by number of points
  std::map<std::array<int, 3>, IndexPattern> quads_;
  std::map<std::vector<int>, IndexPattern> stitched_;  // by depth, the half's edge, and the depths of sides
};

template <class Real>
struct FrameEngine;

/// All that the points of a patch depend on, but for the control mesh: two patches of equal keys have equal
/// bits.
struct PatchKey {
  static constexpr std::size_t kEdges = 8;

  Grid grid;
  std::array<Display, 2> display{};
  std::array<std::int8_t, kEdges> edge_depth{};  // of the faces in repair; else 0
  friend bool operator==(const PatchKey&, const PatchKey&) = default;
};

/// A patch that a frame shows.
struct PatchWanted {
  PatchKey key;
  std::int32_t size = 0;   // vertices
  bool comparable = true;  // false: the key does not tell everything; it is always made anew
};

struct BlockOffset {
  std::int64_t first = 0;
  bool fresh = true;  // to be evaluated; else it is there
};

/// Places, one patch for each first face of a grid.
struct PatchStore {
  /// The places of the patches of the list, in their order. If `reuse`, patches whose keys are as before
  /// stay.
  void place(std::size_t faces, bool reuse);
  void clear();

  std::vector<PatchWanted> list;  // the patches of a frame
  std::vector<BlockOffset> places;
  std::int64_t end = 0;      // vertices in use and between
  std::uint64_t writer = 0;  // FrameState::version of the frame that is here, 0: none
  std::uint64_t mesh = 0;    // FrameState::id of the last
  PatchIndices indices;
  std::vector<Grid> pairs;           // of the last frame, for sticky pairing
  std::vector<std::int32_t> depths;  // those that were asked for in the last frame

 private:
  struct Kept {
    PatchKey key;
    std::int64_t first = -1;  // -1: nothing
    std::int32_t size = 0;
    std::uint32_t shown = 0;  // the last frame that did
  };

  void place_all_anew(std::size_t faces);
  std::int64_t take(std::int32_t size);
  void give_back(Kept& kept);
  void evict(std::int64_t most);

  std::vector<Kept> kept_;                                     // per face
  std::map<std::int32_t, std::vector<std::int64_t>> free_;     // places by size
  std::vector<std::pair<std::uint32_t, std::size_t>> hidden_;  // age and face, while evict() is at it
  std::uint32_t frame_ = 0;
};

/// One of `vertices` and `compact`, which only float has, and provenance or null.
template <class Real>
struct PatchTarget {
  SurfaceVertex<Real>* vertices = nullptr;
  CompactVertex* compact = nullptr;
  LatticePoint* provenance = nullptr;
  CompactRow compact_row = &fast::compact_row;  // or one that gives the same bits sooner

  /// Whether whole vertices alone are wanted, so that who computes them may put them there.
  bool takes_vertices() const { return vertices != nullptr && compact == nullptr && provenance == nullptr; }

  PatchTarget from(std::int64_t first) const {
    return {vertices != nullptr ? vertices + first : nullptr, compact != nullptr ? compact + first : nullptr,
            provenance != nullptr ? provenance + first : nullptr, compact_row};
  }
  /// Vertices at .. at + count - 1.
  void put(std::uint32_t at, const SurfaceVertex<Real>* from, std::size_t count) const {
    if constexpr (std::is_same_v<Real, float>)
      if (compact != nullptr) return compact_row(from, count, compact + at);
    std::copy_n(from, count, vertices + at);
  }
  void put(std::uint32_t at, const SurfaceVertex<Real>& vertex) const {
    if constexpr (std::is_same_v<Real, float>)
      if (compact != nullptr) return void(compact[at] = compacted(vertex));
    vertices[at] = vertex;
  }
};

template <class Real>
class PatchFrame {
 public:
  PatchFrame(FrameEngine<Real>& engine, PatchMesh<Real>& out) : engine_(engine), out_(out) {}

  /// The pairs of the last frame that stay: those of faces that want the same depth again.
  std::vector<Grid> pairs_to_keep(std::span<const std::int32_t> depth) const;

  /// When the engine has planned its frame at these depths. Returns the number of vertices of the patches.
  ///   throws   data::ArgumentError: a patch of more vertices than narrow indices reach; what memory throws
  std::int64_t write(std::span<const std::int32_t> depth);

 private:
  bool continues() const;
  void make_room(std::size_t keep);
  void add_draws();
  void list_changes();

  FrameEngine<Real>& engine_;
  PatchMesh<Real>& out_;
};

extern template class PatchFrame<float>;
extern template class PatchFrame<double>;

}  // namespace limitcheck::fast
