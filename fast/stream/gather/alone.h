// SPDX-License-Identifier: MIT
// Grids next to a cut and quads that something semi-sharp touches: one by one, by the rules of the sliding window, in
// double.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings.h"
#include "fast/window/crack_edge.h"
#include "fast/window/quad_rows.h"
#include "fast/window/quad_window.h"
#include "fast/window/sliding_window.h"

namespace limitcheck::fast::row_stream {

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

// A vertex of the sliding window as row streaming delivers it. Zeros have no sign.
inline Vertex rounded(const SurfaceVertex<double>& v) {
  const auto number = [](double x) { return static_cast<float>(x) + 0.F; };
  return {{number(v.position.x), number(v.position.y), number(v.position.z)},
          {number(v.normal.x), number(v.normal.y), number(v.normal.z)}};
}

template <class Mesh>
AloneEvaluator<Mesh>::AloneEvaluator(const Mesh& mesh, const Rings& rings, int depth)
    : mesh_(mesh),
      rings_(rings),
      depth_(depth),
      window_(depth, mesh.adjacency().max_valence()),
      edge_(depth, mesh.adjacency().max_valence()),
      line_((std::size_t{1} << depth) + 1),
      edge_points_(line_.size()) {}

template <class Mesh>
void AloneEvaluator<Mesh>::edge(std::int32_t h, Vertex* out) {
  edge_.evaluate(mesh_.prepared(), h, depth_, line_.data());
  std::transform(line_.begin(), line_.end(), out, rounded);
  out[0] = limit(mesh_.adjacency().origin(h));
  out[line_.size() - 1] = limit(mesh_.adjacency().target(h));
}

template <class Mesh>
void AloneEvaluator<Mesh>::grid(const typename Mesh::Item& item, Order order, const QuadTarget<float>& target,
                                const std::function<void(std::int32_t h, Vertex* out)>& by_kernel) {
  const int last = 1 << depth_;
  const std::size_t n = line_.size();
  grid_.resize(n * n);
  const auto at = [&](int j, int i) -> Vertex& {
    return grid_[static_cast<std::size_t>(j) * n + static_cast<std::size_t>(i)];
  };
  mesh_.run(window_, item, depth_, order,
            [&](int j, int i, const SurfaceVertex<double>& point) { at(j, i) = rounded(point); });
  const GridEdges on = mesh_.edges(item, order);
  for (std::size_t k = on.of.size(); k-- > 0;) {  // the diagonal first: of its ends others are to decide
    const std::int32_t h = on.of[k];
    if (h < 0) continue;
    const auto point = [&](int t) -> Vertex& {
      const int back = last - t, across = on.from_a ? t : back;
      const int row[] = {0, t, last, back, across}, column[] = {t, last, back, 0, across};
      return at(row[k], column[k]);
    };
    if (!mesh_.touches(rings_, h)) {
      by_kernel(h, edge_points_.data());
      for (int t = 0; t <= last; ++t) point(t) = edge_points_[static_cast<std::size_t>(t)];
    }
    if (k == kAC) continue;
    point(0) = limit(mesh_.adjacency().origin(h));
    point(last) = limit(mesh_.adjacency().target(h));
  }
  for (int j = 0; j <= last; ++j) {
    std::memcpy(target.lane[0] + target.row_offset(j), &at(j, 0), n * sizeof(Vertex));
    if (target.row != nullptr) target.row(target.context, j);
  }
}

// Instantiated apart, for the compiler inlines less where both stand together.
extern template class AloneEvaluator<CutGrids>;
extern template class AloneEvaluator<SemiSharpQuads>;

}  // namespace limitcheck::fast::row_stream
