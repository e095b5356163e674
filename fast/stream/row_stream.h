// SPDX-License-Identifier: MIT
// Row streaming: the sliding window with every point of every level computed once, one grid per vector lane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/stores.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/plan/pairing.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/targets.h"

namespace limitcheck::fast::row_stream {

class CutGrids;

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

/// The memory of one thread: a batch's control points, the kernel's rows and a row of output.
/// 143 040 bytes at depth 5 with 16 lanes, whatever the mesh; 156 352 if two rows are kept.
struct Workspace {
  AlignedFloats input, work, row;
  /// Input and work for grids of a depth. Throws data::ArgumentError: depth is 0 to 10.
  void prepare(int depth, int lanes);
  /// So many numbers of each.
  void grow(int input_size, int work_size, int lanes);
  std::size_t bytes() const { return 4 * (input.size() + work.size() + row.size()); }
};

/// Vertices per side of a grid.
constexpr int side(int depth) {
  return (1 << depth) + 1;
}

/// How many rows of a batch are kept: only the last, or the one before it as well.
enum class Kept : std::uint8_t { kOneRow = 0, kTwoRows = 1 };

/// Where the last rows of a batch lie.
struct RowBuffer {
  float* base;
  std::ptrdiff_t pitch;   // from lane to lane, in floats
  std::ptrdiff_t stride;  // from row to row
  int mask;               // row j is at place j & mask

  /// Room for the rows of so many lanes.
  static RowBuffer in(AlignedFloats& memory, int depth, int lanes, Kept kept);
  const Vertex* row(std::size_t lane, int j) const {
    return reinterpret_cast<const Vertex*>(base + static_cast<std::ptrdiff_t>(lane) * pitch +
                                           (j & mask) * stride);
  }
};

/// Row j of a batch, overwritten by the next row or, if two are kept, by the one after it.
struct BatchRow {
  int depth;
  int j;
  RowBuffer rows;

  /// The side(depth) vertices of the grid in a lane,
  const Vertex* vertices(std::size_t lane) const { return rows.row(lane, j); }
  /// and those of the row before, j > 0, if two are kept.
  const Vertex* before(std::size_t lane) const { return rows.row(lane, j - 1); }
};

/// That of the grids from number `first` of the list on.
struct RowView : BatchRow {
  std::span<const Grid> grids;
  std::size_t first;

  std::size_t size() const { return grids.size(); }
  std::size_t number(std::size_t lane) const { return first + lane; }
};

/// A control mesh prepared for the kernel: the rings and limits of its vertices, 256 + 12 n bytes for one of valence n (a
/// boundary: 376 + 12 n), and 24 bytes a face. Read-only afterwards, so that threads may share it.
///
/// Grids next to a cut are evaluated one by one, by the rules of the sliding window: the kernels have ghosts
/// beyond a border, which would give its two sides other bits.
///
/// The same points come out in several forms: rows() hands over each row in a buffer that the next one
/// overwrites; whole() and streamed() write whole grids to memory; and StreamTessellator makes strips, patches, or an
/// indexed mesh in which shared points appear once.
class RowStream {
 public:
  /// Keeps references to the adjacency and the kernel, which must outlive it. The mesh has a position for
  /// each vertex of the adjacency.
  ///   throws   data::ArgumentError: what LoopRings refuse
  RowStream(const data::ControlMesh& mesh, const Adjacency& adjacency,
            const Kernel& kernel = kernels().front());
  RowStream(const data::ControlMesh& mesh, Adjacency&&, const Kernel& kernel = kernels().front()) = delete;
  /// A mesh that may be cut, which must outlive it.
  explicit RowStream(const TriangleMesh& mesh, const Kernel& kernel = kernels().front());

  /// The mesh that it was made with, whose points have moved.
  void move_points(const TriangleMesh& mesh);

  const Kernel& kernel() const { return kernel_; }
  const LoopRings& rings() const { return rings_; }

  /// Calls visit(context, RowView) for each row of each batch of grids, which all have this depth; a batch is a
  /// part of the list. From C, rows and columns are counted from that corner.
  void rows(std::span<const Grid> grids, int depth, Workspace& workspace,
            void (*visit)(void*, const RowView&), void* context, Order order = Order::kFromA,
            Kept kept = Kept::kOneRow) const;

  /// All vertices: those of grids[p] from out[p * side * side], row by row. `kernel`: another one for this
  /// call, with the same bits.
  void whole(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out,
             const Kernel* kernel = nullptr) const;

  /// The same vertices, those of grids[p] from places[p] on: with AVX-512 in whole cache lines straight from
  /// registers, elsewhere row after row. From C they come in the opposite order. Nothing beyond the grids is
  /// touched. Past the caches they are seen by other threads after fence(stores).
  void put(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* const* places, Order order,
           Stores stores) const;

  /// The same bytes as whole(), written past the caches as put() does it: for output that is much larger than
  /// the caches and that nobody reads soon. Nothing beyond the grids is touched. Other threads see the output
  /// when they see what this thread writes afterwards.
  void streamed(std::span<const Grid> grids, int depth, Workspace& workspace, Vertex* out) const;

  /// The points of control edges at a depth of their own: those of half_edges[e], from its origin to its
  /// target, from out[e * side]. The same bits as a grid of that depth gives them.
  void edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
             const Kernel* kernel = nullptr) const;

 private:
  template <class At>
  void put_at(const At& at, std::span<const Grid> grids, int depth, Workspace& workspace, Order order,
              Stores stores) const;
  void batches(const Kernel& kernel, std::span<const Grid> grids, int depth, Workspace& workspace,
               void (*visit)(void*, const RowView&), void* context, Order order, Kept kept) const;
  /// How many of a list, and at most `most`, go together: one that is next to a cut goes alone.
  template <class T>
  std::size_t together(std::span<const T> list, std::size_t most) const;

  const Adjacency& adjacency_;
  const Kernel& kernel_;
  LoopRings rings_;
  std::shared_ptr<const CutGrids> cut_;  // null: there is none
};

}  // namespace limitcheck::fast::row_stream
