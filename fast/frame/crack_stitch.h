// SPDX-License-Identifier: MIT
// A repair that keeps the interior points: only the outer ring of triangles is made anew.
#pragma once

#include <cstdint>

namespace limitcheck::fast {

/// Triangles of the outer ring of a triangle along one edge: 2^edge_depth on the border, k - 3 on the inside.
constexpr std::int64_t stitch_triangles(std::int64_t k, int edge_depth) {
  return (std::int64_t{1} << edge_depth) + k - 3;
}
/// The same along a side of a quad or larger face: k - 2 on the inside.
constexpr std::int64_t quad_stitch_triangles(std::int64_t k, int edge_depth) {
  return (std::int64_t{1} << edge_depth) + k - 2;
}

/// Joins the border points 0 .. 2^edge_depth of an edge to the inner points 0 .. inner_count of the row of
/// lattice points next to it (k = 2^depth), without T-vertices. The shorter way goes first: segments are
/// taken in the order of their midpoints along the edge.
///   middle   twice the place of the middle of inner segment 0, in steps of the lattice
///   triangle(a, a_inner, b, b_inner, c, c_inner)   counter-clockwise; a_inner says whether a is an index of
///                                                  the inner row
template <class Triangle>
void stitch_rows(int k, int edge_depth, std::int64_t inner_count, int middle, Triangle&& triangle) {
  const std::int64_t outer_count = std::int64_t{1} << edge_depth;
  std::int64_t outer = 0, inner = 0;
  while (outer < outer_count || inner < inner_count) {
    const bool take_outer =
        inner == inner_count ||
        (outer < outer_count && (2 * outer + 1) * k <= (2 * inner + middle) * outer_count);
    if (take_outer) {
      triangle(outer, false, outer + 1, false, inner, true);
      ++outer;
    } else {
      triangle(outer, false, inner + 1, true, inner, true);
      ++inner;
    }
  }
}

/// Of a triangle, k >= 4: inner point j lies over (j + 3/2) / k.
template <class Triangle>
void stitch_edge(int k, int edge_depth, Triangle&& triangle) {
  stitch_rows(k, edge_depth, k - 3, 4, triangle);
}
/// Of a quad or larger face, k >= 4: inner point j lies over (j + 1) / k.
template <class Triangle>
void stitch_side(int k, int edge_depth, Triangle&& triangle) {
  stitch_rows(k, edge_depth, k - 2, 3, triangle);
}

}  // namespace limitcheck::fast
