// SPDX-License-Identifier: MIT
// Grids next to a cut and quads that something semi-sharp touches: one by one, by the rules of the sliding window, in
// double.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/quad_rings.h"
#include "fast/window/crack_edge.h"
#include "fast/window/quad_rows.h"
#include "fast/window/quad_window.h"
#include "fast/window/sliding_window.h"

namespace limitcheck::fast::row_stream {

/// The control edges of a grid: half-edges along A B, B C, C D, D A; from C, along C D, D A, A B, B C; last
/// the diagonal A C, which quads have not. -1: there is no such edge to show.
struct GridEdges {
  static constexpr std::size_t kCount = 5, kDiagonal = 4;
  GridEdges(const Adjacency& adjacency, const Grid& grid, Order order);
  GridEdges(std::int32_t quad, Order order);
  bool from_a;
  std::array<std::int32_t, kCount> of;
};

/// The mesh for these rules, and what is next to a cut: what the kernels make of a boundary has other bits on
/// its other side. Keeps references to the mesh. Read-only afterwards.
class CutGrids {
 public:
  using Item = Grid;
  using Rings = LoopRings;
  using Window = SlidingWindow<double>;
  using Edge = EdgeStrip<double>;

  explicit CutGrids(const TriangleMesh& mesh);

  /// Whether an end of a half-edge, or a corner of a grid, is on a cut.
  bool touches(std::int32_t h) const {
    return on_cut_[adjacency().origin(h)] != 0 || on_cut_[adjacency().target(h)] != 0;
  }
  bool touches(const Grid& grid) const { return touches_face(grid.face0) || touches_face(grid.face1); }
  bool touches(const Rings& /*rings*/, std::int32_t h) const { return touches(h); }

  const PreparedMesh<double>& prepared() const { return prepared_; }
  const Adjacency& adjacency() const { return prepared_.adjacency(); }
  GridEdges edges(const Grid& grid, Order order) const { return {adjacency(), grid, order}; }
  /// put(j, i, point) for each point.
  template <class Put>
  void run(Window& window, const Grid& grid, int depth, Order order, Put&& put) const;

 private:
  bool touches_face(std::int32_t f) const { return f >= 0 && (touches(3 * f) || touches(3 * f + 1)); }

  PreparedMesh<double> prepared_;
  std::vector<std::uint8_t> on_cut_;  // per vertex
};

/// The same of a mesh of quads with something semi-sharp. An item is a quad.
class SemiSharpQuads {
 public:
  using Item = std::int32_t;
  using Rings = QuadRings;
  using Window = QuadWindow<double>;
  using Edge = QuadEdge<double>;

  explicit SemiSharpQuads(const QuadMesh& mesh);

  static bool touches(const QuadRings& rings, std::int32_t h) { return rings.touches_semi_sharp(h); }
  const PreparedQuads<double>& prepared() const { return prepared_; }
  const QuadAdjacency& adjacency() const { return prepared_.mesh().adjacency; }
  static GridEdges edges(std::int32_t quad, Order order) { return {quad, order}; }
  template <class Put>
  void run(Window& window, std::int32_t quad, int depth, Order order, Put&& put) const;

 private:
  PreparedQuads<double> prepared_;
};

/// Evaluates them at one depth. An edge with an end that is touched comes from its own three rows, with the same
/// bits from both of its faces; the kernels make all other edges, and the rings the corners: so these grids meet
/// the others bit by bit.
template <class Mesh>
class AloneEvaluator {
 public:
  using Rings = typename Mesh::Rings;

  AloneEvaluator(const Mesh& mesh, const Rings& rings, int depth);

  /// 2^depth + 1 points from the origin of a half-edge on.
  void edge(std::int32_t h, Vertex* out);

  /// A grid, row by row, from A or from C, into lane 0 of a target.
  ///   by_kernel(h, out)   evaluates an edge that is not touched
  void grid(const typename Mesh::Item& item, Order order, const QuadTarget<float>& target,
            const std::function<void(std::int32_t h, Vertex* out)>& by_kernel);

 private:
  Vertex limit(std::int32_t v) const { return vertex_from(rings_.head(v) + Rings::Block::kLimit); }

  const Mesh& mesh_;
  const Rings& rings_;
  int depth_;
  typename Mesh::Window window_;
  typename Mesh::Edge edge_;
  std::vector<SurfaceVertex<double>> line_;
  std::vector<Vertex> grid_, edge_points_;
};

extern template class AloneEvaluator<CutGrids>;
extern template class AloneEvaluator<SemiSharpQuads>;

}  // namespace limitcheck::fast::row_stream
