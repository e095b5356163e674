// SPDX-License-Identifier: MIT
// Row streaming in any number type, a grid at a time: the same prepass, gathering and kernel as for vectors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "data/error.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/gather/rings_impl.h"
#include "fast/stream/kernel/kernel.h"

namespace limitcheck::fast::row_stream {

/// N = ScalarNumber<T> or LinearNumber<T, k>, see number.h and BasicLoopRings for what T needs. A vertex of the
/// output is six numbers: limit position in the caller's coordinates, then the unit normal or, for linear
/// numbers, one tangent as the kernel has it, not placed:
///   inside a face, on the rows of the grid   slant 4^d (4 dx + 2 dy), across 4^d (2 dx + 4 dy)
///   on columns 0 and 2^d (edges A D, B C)    slant 4^d (2 dy - 2 dx), across -4^d (4 dx + 2 dy)
///   on the diagonal A C                      slant 4^d (2 dx + 4 dy), across 4^d (2 dy - 2 dx)
///   at control vertices                      the tangents du and dv of vertex_limit.h
/// where dx, dy are the derivatives of the limit by column / 2^d and row / 2^d of the grid, the unit of the
/// points' own coordinates.
///
/// Double (DoubleStream): positions within 5e-16 of the mesh's extent from the exact limit (measured: 1e-16),
/// normals within 1e-12 (measured: 1e-14, depth 5). Exact T: exact, as long as the cosines of the valences
/// are.
template <class N>
class NumberStream {
 public:
  using T = typename N::Scalar;

  /// The adjacency must outlive this.
  NumberStream(const Adjacency& adjacency, PlacedPoints<T> points) : rings_(adjacency, std::move(points)) {}
  /// T float or double.
  NumberStream(const data::ControlMesh& mesh, const Adjacency& adjacency)
      : NumberStream(adjacency, place<T>(mesh)) {}
  /// Points as they are, without a placement.
  NumberStream(const Adjacency& adjacency, std::span<const std::array<T, 3>> points)
      : NumberStream(adjacency, as_they_are(points)) {}

  template <class... Arguments>
  NumberStream(Adjacency&&, Arguments&&...) = delete;

  const BasicLoopRings<N>& rings() const { return rings_; }

  /// All vertices of grids of one depth, 0..10: those of grids[p] from out[6 p side^2], row by row, side =
  /// 2^depth + 1. Throws data::ArgumentError for another depth.
  void whole(std::span<const Grid> grids, int depth, T* out, Edges edges = Edges::kAllStreamed) const {
    check(depth);
    const std::ptrdiff_t side = (1 << depth) + 1;
    std::vector<T> input(static_cast<std::size_t>(input_size(depth))),
        work(static_cast<std::size_t>(work_size(depth)));
    for (std::size_t p = 0; p < grids.size(); ++p, out += 6 * side * side) {
      const auto placement =
          gather(rings_, grids.subspan(p, 1), depth, 1, input.data(), Order::kFromA, edges);
      const Target<T> target{out, 0, 6 * side, nullptr, nullptr};
      generic::Stream<N>(input.data(), depth, placement, work.data(), {target}).run();
    }
  }

  /// The same of one pair with regular corners, as polynomials.
  void patch(const Grid& grid, int depth, T* out, Order order = Order::kFromA) const {
    check(depth);
    std::vector<T> input(static_cast<std::size_t>(input_size(kPatchWindow)));
    const auto placement = gather_regular(rings_, {&grid, 1}, 1, input.data(), order);
    const Target<T> target{out, 0, 6 * ((1 << depth) + 1), nullptr, nullptr};
    generic::TrianglePatch<N>(input.data(), depth, placement, {target}).run();
  }

  /// The points of control edges at a depth of their own, from origin to target: those of half_edges[e] from
  /// out[6 e side].
  void edges(std::span<const std::int32_t> half_edges, int depth, T* out,
             Edges edges = Edges::kAllStreamed) const {
    check(depth);
    std::vector<T> input(static_cast<std::size_t>(edge_input_size(depth))),
        work(static_cast<std::size_t>(edge_work_size(depth)));
    for (std::size_t e = 0; e < half_edges.size(); ++e, out += edge_output_size(depth)) {
      const auto placement = gather_edges(rings_, half_edges.subspan(e, 1), depth, 1, input.data(), edges);
      generic::EdgeStream<N>(depth, placement, work.data())
          .scatter(edge_input<T>(input.data(), depth, 1, placement), generic::LaneRow<N>{out, 0});
    }
  }

 private:
  static void check(int depth) {
    if (depth < 0 || depth > kMaxDepth) throw data::ArgumentError("row streaming: depth is 0 to 10");
  }
  static PlacedPoints<T> as_they_are(std::span<const std::array<T, 3>> points) {
    PlacedPoints<T> placed{{}, Placement<T>{}};
    for (const auto& p : points) placed.points.push_back({p[0], p[1], p[2], T(0)});
    return placed;
  }

  BasicLoopRings<N> rings_;
};

using DoubleStream = NumberStream<ScalarNumber<double>>;

}  // namespace limitcheck::fast::row_stream
