// SPDX-License-Identifier: MIT
// Row streaming: the sliding window with every point of every level computed once, one grid per vector lane.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "fast/stream/batch.h"
#include "fast/stream/rings.h"
#include "fast/stream/targets.h"
#include "fast/stream/vertex.h"

namespace limitcheck::fast::row_stream {

struct CompactVertex;

/// Memory that the kernels can load vectors from.
class AlignedFloats {
 public:
  void grow(std::size_t count);  // keeps nothing; new memory is zero
  float* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(float* p) const;
  };
  std::unique_ptr<float[], Free> data_;
  std::size_t size_ = 0;
};

/// What one thread needs besides the mesh: a batch's control points, the kernel's rows and a row of output.
/// 143 040 bytes at depth 5 with 16 lanes, whatever the mesh.
struct Workspace {
  AlignedFloats input, work, row;
  std::size_t bytes() const { return 4 * (input.size() + work.size() + row.size()); }
};

/// Vertices per side of a grid.
constexpr int side(int depth) {
  return (1 << depth) + 1;
}

/// Row j of a batch of grids, overwritten by the next row.
struct RowView {
  std::span<const Grid> grids;
  int depth;
  int j;
  const float* base;
  std::ptrdiff_t pitch;  // in floats

  /// The side(depth) vertices of grids[lane].
  const Vertex* vertices(std::size_t lane) const {
    return reinterpret_cast<const Vertex*>(base + static_cast<std::ptrdiff_t>(lane) * pitch);
  }
};

/// A control mesh made ready: rings and limits per vertex. Read only afterwards, so threads may share it.
///
/// Output forms, all of the same points: row buffers that the next row overwrites (rows), whole grids in
/// memory (whole; streamed: past the caches, or compact), to which grid_indices.h has the index buffers that
/// all grids of a depth share, and, by StreamTessellator, an indexed mesh in which shared points appear once.
class RowStream {
 public:
  /// Both must outlive this.
  RowStream(const data::ControlMesh& mesh, const Adjacency& adjacency,
            const Kernel& kernel = kernels().front());

  const Kernel& kernel() const { return kernel_; }
  const Rings& rings() const { return rings_; }

  /// Calls visit(context, RowView) for each row of each batch of grids, which all have this depth. From C,
  /// rows and columns are counted from that corner.
  void rows(std::span<const Grid> grids, int depth, Workspace& workspace,
            void (*visit)(void*, const RowView&), void* context, Order order = Order::kFromA) const;

  /// All vertices: those of grids[p] from out[p * side * side], row by row. `kernel`: another one for this
  /// call, with the same bits.
  void whole(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out,
             const Kernel* kernel = nullptr) const;

  /// The same bytes as whole() by non-temporal stores, row after row: for output much larger than the caches
  /// that nobody reads soon. `out` is aligned as any Vertex is; nothing beyond the grids is touched. Visible
  /// to other threads as whatever this thread writes afterwards.
  void streamed(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out) const;
  /// The same in 16 bytes per vertex, see compact_vertex.h.
  void streamed(std::span<const Grid> grids, int depth, Workspace& workspace, CompactVertex* out) const;

  /// The points of control edges at a depth of their own: those of half_edges[e], from its origin to its
  /// target, from out[e * side]. The same bits as a grid of that depth gives them.
  void edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
             const Kernel* kernel = nullptr) const;

 private:
  void batches(const Kernel& kernel, std::span<const Grid> grids, int depth, Workspace& workspace,
               void (*visit)(void*, const RowView&), void* context, Order order) const;

  const Adjacency& adjacency_;
  const Kernel& kernel_;
  Rings rings_;
};

}  // namespace limitcheck::fast::row_stream
