// SPDX-License-Identifier: MIT
// Grids and edges of triangles next to a cut: by the rules of the sliding window, in double.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fast/mesh/cut_mesh.h"
#include "fast/plan/grid.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/kernel/layout.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/triangle_lattice.h"

namespace limitcheck::fast::row_stream {

/// A vertex of the sliding window in double, as row streaming delivers it. Zeros have no sign.
inline Vertex rounded(const SurfaceVertex<double>& v) {
  const auto number = [](double x) { return static_cast<float>(x) + 0.F; };
  return {{number(v.position.x), number(v.position.y), number(v.position.z)},
          {number(v.normal.x), number(v.normal.y), number(v.normal.z)}};
}

/// The mesh for these rules, and what is next to a cut: what the kernels make of a boundary has other bits on
/// its other side. Keeps references to the mesh. Read-only afterwards.
class CutGrids {
 public:
  explicit CutGrids(const TriangleMesh& mesh);

  /// Whether an end of a half-edge, or a corner of a grid, is on a cut.
  bool touches(std::int32_t h) const {
    return on_cut_[adjacency().origin(h)] != 0 || on_cut_[adjacency().target(h)] != 0;
  }
  bool touches(const Grid& grid) const { return touches_face(grid.face0) || touches_face(grid.face1); }

  const PreparedMesh<double>& prepared() const { return prepared_; }
  const Adjacency& adjacency() const { return prepared_.adjacency(); }

 private:
  bool touches_face(std::int32_t f) const { return f >= 0 && (touches(3 * f) || touches(3 * f + 1)); }

  PreparedMesh<double> prepared_;
  std::vector<std::uint8_t> on_cut_;  // per vertex
};

/// The control edges of a grid: half-edges along A B, B C, C D, D A; from C, along C D, D A, A B, B C; last
/// the diagonal A C. -1: the grid, a face alone, has no such edge to show.
struct GridEdges {
  static constexpr int kCount = 5, kDiagonal = 4;
  GridEdges(const Adjacency& adjacency, const Grid& grid, Order order);
  bool from_a;
  std::int32_t of[kCount];
};

/// Evaluates them at one depth. An edge with an end on a cut comes from its own three rows, with the same bits
/// from both of its faces; the kernels make all other edges, and the rings the corners: so these grids meet
/// the others bit by bit.
class CutGridEvaluator {
 public:
  CutGridEvaluator(const CutGrids& mesh, const Rings& rings, int depth);

  /// 2^depth + 1 points from the origin of a half-edge on.
  void edge(std::int32_t h, Vertex* out);

  /// A grid into lane 0 of a target, row by row, from A or from C.
  ///   edges   2^depth + 1 points of each of its GridEdges; those with an end on a cut are not looked at
  void grid(const Grid& grid, Order order, const Vertex* edges, const Target<float>& target);

 private:
  Vertex corner(std::int32_t v) const;
  void face_alone(std::int32_t face);
  template <class Points>
  void put_row(const GridEdges& along, int j, Points&& points, const Vertex* edges,
               const Target<float>& target) const;

  const CutGrids& mesh_;
  const Rings& rings_;
  int depth_;
  SlidingWindow<double> window_;
  EdgeStrip<double> edge_;
  std::vector<SurfaceVertex<double>> line_;
  std::vector<SurfaceVertex<double>> whole_;  // a face alone, as a grid from A
};

}  // namespace limitcheck::fast::row_stream
