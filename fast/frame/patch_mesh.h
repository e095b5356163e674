// SPDX-License-Identifier: MIT
// A frame in the form that graphics processors want: the points of each patch once, with index patterns that
// patches share; from one frame to the next only what has changed is made anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fast/frame/sink.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// What the indices of a patch are: three for each triangle, or strips that end with kRestart where the
/// patch is a whole grid or half of one (a third of the indices).
enum class IndexForm : std::uint8_t { kTriangles, kStrips };

/// Ends a strip, as 32 and as 16 bits (the restart index of OpenGL, Vulkan, Direct3D).
inline constexpr std::uint32_t kRestartIndex = 0xffffffff;
inline constexpr std::uint16_t kRestartIndex16 = 0xffff;  ///< the same of 16 bits

/// What a mesh of patches is to hold besides vertices.
struct PatchOptions {
  IndexForm form = IndexForm::kTriangles;
  bool narrow = false;       // indices of 16 bits as well: depths of 7 and less
  bool compact = false;      // vertices of 16 bytes (CompactVertex); of float
  bool incremental = false;  // patches that are as they were in the frame before keep their places
  /// Faces stay paired as long as neither of them wants another depth, in place of pairs that depend on the
  /// frame alone: fewer patches change from frame to frame, and fewer faces are as deep as a partner wants it
  /// (about 10 per cent fewer triangles on bumpy spheres that turn, claim C86).
  bool sticky = false;
};

/// Memory for vertices, from whoever has it: a mapped buffer of a graphics library, or the heap.
class VertexMemory {
 public:
  virtual ~VertexMemory() = default;
  /// At least `bytes`, aligned to 16, which begin with the first `keep` bytes of what it gave before. It
  /// lasts until the next call. May throw; the frame is then lost, and the next one is made anew.
  virtual std::byte* reserve(std::size_t bytes, std::size_t keep) = 0;
};

/// One call of the graphics library: indices first_index .. first_index + index_count - 1 of the patterns,
/// each plus base_vertex. The first `split` triangles belong to control face `face`, the rest to
/// `face_after`.
struct PatchDraw {
  std::int64_t base_vertex = 0;
  std::uint32_t first_index = 0, index_count = 0;
  std::int32_t vertex_count = 0;  // of the patch, from base_vertex on
  std::int32_t triangles = 0, split = 0;
  std::int32_t face = -1, face_after = -1;
  IndexForm form = IndexForm::kTriangles;
  Kind kind = Kind::kPair;
  std::int8_t depth = 0;
};

/// Vertices first .. first + count - 1.
struct VertexRange {
  std::int64_t first = 0, count = 0;
};

struct PatchStore;

/// A whole frame as patches: the output of Engine::frame(), which may be given to the next frame again.
/// What it keeps belongs to the engine that wrote to it last; another one begins anew.
///
/// Between frames patches stay in their places, also those that are not shown for a while: at most as many
/// vertices as are shown. The vertices in use, shown or not or between others, are at most three times
/// those shown plus kSlack; beyond that all patches are made anew, without gaps.
template <class Real>
class PatchMesh {
 public:
  static constexpr std::int64_t kSlack = 65536;

  /// In memory of its own, or in the caller's, which must outlive it.
  explicit PatchMesh(const PatchOptions& options = {}, VertexMemory* memory = nullptr);
  PatchMesh(PatchMesh&&) noexcept = default;
  PatchMesh& operator=(PatchMesh&&) noexcept = default;

  const PatchOptions& options() const { return options_; }
  std::span<const PatchDraw> draws() const { return draws_; }
  /// All vertices, those of no draw as well, in one form or the other; provenance likewise, or none.
  std::span<const SurfaceVertex<Real>> vertices() const { return vertices_; }
  std::span<SurfaceVertex<Real>> vertices() { return vertices_; }  // for who changes them after a frame
  std::span<const CompactVertex> compact_vertices() const { return compact_; }
  std::span<const LatticePoint> provenance() const { return provenance_; }
  /// The patterns, which are added to from frame to frame and never change; and the same as 16 bits, if so
  /// wanted.
  std::span<const std::uint32_t> indices() const { return indices_; }
  std::span<const std::uint16_t> indices16() const { return indices16_; }
  /// Which vertices the last frame wrote, in order and apart, and from which index on patterns are new.
  std::span<const VertexRange> changed() const { return changed_; }
  std::size_t first_new_index() const { return first_new_index_; }

  /// Forgets everything; the next frame begins anew.
  void clear();

 private:
  template <class>
  friend class PatchFrame;

  PatchOptions options_;
  VertexMemory* memory_;
  std::unique_ptr<VertexMemory> own_;
  std::shared_ptr<PatchStore> store_;  // of this alone; shared pointers need no complete type
  std::vector<PatchDraw> draws_;
  std::span<SurfaceVertex<Real>> vertices_;
  std::span<CompactVertex> compact_;
  std::vector<LatticePoint> provenance_;
  std::vector<std::uint32_t> indices_;
  std::vector<std::uint16_t> indices16_;
  std::vector<VertexRange> changed_;
  std::size_t first_new_index_ = 0;
};

extern template class PatchMesh<float>;
extern template class PatchMesh<double>;

}  // namespace limitcheck::fast
