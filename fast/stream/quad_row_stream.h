// SPDX-License-Identifier: MIT
// Row streaming of quads: Catmull-Clark's surfaces, one quad per vector lane.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/surface_vertex.h"
#include "fast/stream/gather/quad_rings.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

class SemiSharpQuads;

/// Row j of a batch of quads. Row 0 runs from corner A = 0 of a face to B = 1.
struct QuadRowView : BatchRow {
  std::span<const std::uint32_t> index;  // of the quads, in the caller's list

  std::size_t size() const { return index.size(); }
  std::size_t number(std::size_t lane) const { return index[lane]; }
};

/// A mesh of quads prepared for the kernel: the rings and limits of its vertices. Read-only afterwards,
/// so that threads may share it.
///
/// Bits: each point on a side or at a corner comes out the same from every quad that has it, whatever the
/// instruction set, the other quads of the call and their order. What lies inside depends on the quad alone.
/// Points on sides between two regular vertices, and all points of regular quads, are the same at every depth
/// up to 8.
///
/// Quads that something semi-sharp touches are evaluated one by one, by the rules of the sliding window; the
/// bits are equal there too.
///
/// Error in float, against the exact limit: position 1e-7 of the mesh's box; normals of regular quads 1e-6
/// rad at every depth, of others 1e-5 for 99.9 % of the points to depth 5 from where they have origins of
/// their own (rings.cpp); tables in NOTES.md.
class QuadRowStream {
 public:
  /// Keeps references to the kernel and, if something is semi-sharp, to the mesh, which must outlive it.
  explicit QuadRowStream(const QuadMesh& mesh, const QuadKernel& kernel = quad_kernels().front());
  explicit QuadRowStream(QuadMesh&&, const QuadKernel& = quad_kernels().front()) = delete;

  const QuadKernel& kernel() const { return kernel_; }
  const QuadRings& rings() const { return rings_; }
  /// A vertex of the mesh, rounded; and its limit point.
  Vec3<float> control(std::int32_t v) const {
    const float* x = rings_.head(v) + QuadCornerBlock::kCentre;
    return rings_.placement()(Vec3<float>{x[0], x[1], x[2]});
  }
  SurfaceVertex<float> limit(std::int32_t v) const {
    return vertex_from(rings_.head(v) + QuadCornerBlock::kLimit);
  }

  /// The faces in an order in which neighbours in the list are quads of like valences, which makes the best
  /// batches. Any order is right.
  std::vector<std::int32_t> sorted(std::span<const std::int32_t> faces) const;

  /// Calls visit(context, QuadRowView) for each row of each batch of quads. A batch takes quads that can go
  /// together from anywhere in the list; its rows come one after the other. From C, rows and columns are
  /// counted from that corner; the points are the same, those inside regular quads and quads that something
  /// semi-sharp touches but for rounding.
  void rows(std::span<const std::int32_t> faces, int depth, Workspace& workspace,
            void (*visit)(void*, const QuadRowView&), void* context, Order order = Order::kFromA,
            Kept kept = Kept::kOneRow) const;

  /// All vertices: those of faces[p] from out[p * side * side], row by row. `kernel`: another one for this
  /// call, with the same bits.
  void whole(std::span<const std::int32_t> faces, int depth, Workspace& workspace, Vertex* out,
             const QuadKernel* kernel = nullptr) const;

  /// The same vertices, those of faces[p] from places[p] on, as RowStream::put() does it.
  void put(std::span<const std::int32_t> faces, int depth, Workspace& workspace, Vertex* const* places,
           Order order, Stores stores) const;

  /// The same bytes as whole(), written past the caches as RowStream does it. Nothing beyond the quads is touched.
  /// Other threads see the output when they see what this thread writes afterwards.
  void streamed(std::span<const std::int32_t> faces, int depth, Workspace& workspace, Vertex* out) const;

  /// The points of sides at a depth of their own: those of half_edges[e], from its origin to its target, from
  /// out[e * side]. The same bits as a quad of that depth gives them.
  void edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
             const QuadKernel* kernel = nullptr) const;

 private:
  template <class At>
  void put_at(const At& at, std::span<const std::int32_t> faces, int depth, Workspace& workspace, Order order,
              Stores stores) const;

  const QuadKernel& kernel_;
  QuadRings rings_;
  std::shared_ptr<const SemiSharpQuads> semi_sharp_;  // null: nothing is
};

}  // namespace limitcheck::fast::row_stream
