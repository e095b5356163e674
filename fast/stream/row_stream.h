// SPDX-License-Identifier: MIT
// Row streaming: the sliding window with every point of every level computed once, one grid or quad per vector lane.
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
class SemiSharpQuads;

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
/// 143 360 bytes at depth 5 with 16 lanes, whatever the mesh; 156 672 if two rows are kept.
struct Workspace {
  AlignedFloats input, work, row;
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

/// Row j of a batch, overwritten by the next row or, if two are kept, by the one after it. Row 0 runs from corner A to
/// B; of a quad, from its corner 0 to 1.
struct RowView {
  int depth;
  int j;
  RowBuffer rows;
  std::size_t grids = 0;                 // of the batch, one in each lane
  std::size_t first = 0;                 // lane k has number first + k of the caller's list
  const std::uint32_t* index = nullptr;  // or, if this is not null, number index[k]

  std::size_t size() const { return grids; }
  std::size_t number(std::size_t lane) const { return index != nullptr ? index[lane] : first + lane; }
  /// The side(depth) vertices of the grid in a lane,
  const Vertex* vertices(std::size_t lane) const { return rows.row(lane, j); }
  /// and those of the row before, j > 0, if two are kept.
  const Vertex* before(std::size_t lane) const { return rows.row(lane, j - 1); }
};

/// Loop's scheme, whose items are grids of triangles, and Catmull-Clark's, whose items are quads by their numbers.
struct LoopStreams {
  using Item = Grid;
  using Kernel = row_stream::Kernel;
  using Rings = LoopRings;
  using Alone = CutGrids;
  static bool has_lines(const Kernel& kernel) { return kernel.run_lines != nullptr; }
};
struct QuadStreams {
  using Item = std::int32_t;
  using Kernel = QuadKernel;
  using Rings = QuadRings;
  using Alone = SemiSharpQuads;
  static bool has_lines(const Kernel& kernel) { return kernel.quad_lines != nullptr; }
};

/// A control mesh prepared for the kernel: the rings and limits of its vertices. Read-only afterwards, so that threads
/// may share it.
///
/// The same points come out in several forms: rows() hands over each row in a buffer that the next one
/// overwrites; whole(), put() and streamed() write whole grids to memory; and StreamTessellator makes strips,
/// patches, or an indexed mesh in which shared points appear once.
template <class Scheme>
class BasicRowStream {
 public:
  using Item = typename Scheme::Item;
  using Kernel = typename Scheme::Kernel;
  using Rings = typename Scheme::Rings;

  const Kernel& kernel() const { return kernel_; }
  const Rings& rings() const { return rings_; }
  /// Whether put() writes whole lines.
  bool has_lines() const { return Scheme::has_lines(kernel_); }
  /// The limit point of a vertex.
  Vertex limit(std::int32_t v) const { return vertex_from(rings_.head(v) + Rings::Block::kLimit); }

  /// Calls visit(context, RowView) for each row of each batch of items, which all have this depth; the rows of a batch
  /// come one after the other. A batch takes items that can go together from anywhere in the list. From C, rows and
  /// columns are counted from that corner; the points are the same, those inside regular quads and quads that something
  /// semi-sharp touches but for rounding.
  void rows(std::span<const Item> items, int depth, Workspace& workspace,
            void (*visit)(void*, const RowView&), void* context, Order order = Order::kFromA,
            Kept kept = Kept::kOneRow) const;

  /// All vertices: those of items[p] from out[p * side * side], row by row. `kernel`: another one for this
  /// call, with the same bits.
  void whole(std::span<const Item> items, int depth, Workspace& workspace, Vertex* out,
             const Kernel* kernel = nullptr) const;

  /// The same vertices, those of items[p] from places[p] on: with AVX-512 in whole cache lines straight from
  /// registers, elsewhere row after row. From C they come in the opposite order. Nothing beyond the items is
  /// touched. Past the caches they are seen by other threads after fence(stores).
  void put(std::span<const Item> items, int depth, Workspace& workspace, Vertex* const* places, Order order,
           Stores stores) const;

  /// The same bytes as whole(), written past the caches as put() does it: for output that is much larger than
  /// the caches and that nobody reads soon. Nothing beyond the items is touched. Other threads see the output
  /// when they see what this thread writes afterwards.
  void streamed(std::span<const Item> items, int depth, Workspace& workspace, Vertex* out) const;

  /// The points of control edges at a depth of their own: those of half_edges[e], from its origin to its
  /// target, from out[e * side]. The same bits as a grid of that depth gives them.
  void edges(std::span<const std::int32_t> half_edges, int depth, Workspace& workspace, Vertex* out,
             const Kernel* kernel = nullptr) const;

 protected:
  using Alone = typename Scheme::Alone;
  /// alone   null: there are no items that the kernels are not for
  BasicRowStream(const Kernel& kernel, Rings rings, std::shared_ptr<const Alone> alone);

  const Kernel& kernel_;
  Rings rings_;
  std::shared_ptr<const Alone> alone_;
};

extern template class BasicRowStream<LoopStreams>;
extern template class BasicRowStream<QuadStreams>;

/// Of triangles: 256 + 12 n bytes for a vertex of valence n (a boundary: 376 + 12 n), and 27 bytes a face, 32 where some
/// triangle is low (see LocalOrigins).
///
/// Bits: each point on an edge or at a vertex comes out the same from every grid that has it, whatever the instruction set,
/// the other grids of the call and their order. What lies inside depends on the grid alone. From depth 4 on regular edges
/// and grids (see regular_offset()) are polynomials, whose points are the same at every depth.
///
/// Grids next to a cut are evaluated one by one, by the rules of the sliding window: the kernels have ghosts
/// beyond a border, which would give its two sides other bits.
class RowStream : public BasicRowStream<LoopStreams> {
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

  /// The depth from which some part of a grid has an origin of its own, see Part.
  int local_from(const Grid& grid) const { return row_stream::local_from(rings_.local(), grid); }
  /// The grids in an order in which those of the same local_from() follow each other, and among them those of the same
  /// regularity_rank(), which makes the best batches. Any order is right.
  std::vector<Grid> sorted(std::span<const Grid> grids) const;
};

/// Of quads, by Catmull-Clark's rules.
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
class QuadRowStream : public BasicRowStream<QuadStreams> {
 public:
  /// Keeps references to the kernel and, if something is semi-sharp, to the mesh, which must outlive it.
  explicit QuadRowStream(const QuadMesh& mesh, const QuadKernel& kernel = quad_kernels().front());
  explicit QuadRowStream(QuadMesh&&, const QuadKernel& = quad_kernels().front()) = delete;

  /// The mesh that it was made with, whose points have moved.
  void move_points(const QuadMesh& mesh);

  /// A vertex of the mesh, rounded.
  Vec3<float> control(std::int32_t v) const {
    const float* x = rings_.head(v) + QuadCornerBlock::kCentre;
    return rings_.placement()(Vec3<float>{x[0], x[1], x[2]});
  }

  /// The faces in an order in which neighbours in the list are quads of like valences, which makes the best
  /// batches. Any order is right.
  std::vector<std::int32_t> sorted(std::span<const std::int32_t> faces) const;
};

}  // namespace limitcheck::fast::row_stream
