// SPDX-License-Identifier: MIT
// A repair that keeps the interior points: only the outer ring of triangles is made anew.
#pragma once

#include <cstdint>

namespace limitcheck::fast {

/// Triangles of the outer ring along one edge: 2^edge_depth on the border, k - 3 on the inside.
constexpr std::int64_t stitch_triangles(std::int64_t k, int edge_depth) {
  return (std::int64_t{1} << edge_depth) + k - 3;
}

/// Joins the border points 0 .. 2^edge_depth of an edge to the inner points 0 .. k - 3 of the row of lattice
/// points next to it (k = 2^depth >= 4), without T-vertices. The shorter way goes first: segments are taken
/// in the order of their midpoints along the edge.
///   triangle(a, a_inner, b, b_inner, c, c_inner)   counter-clockwise; a_inner says whether a is an index of
///                                                  the inner row
template <class Triangle>
void stitch_edge(int k, int edge_depth, Triangle&& triangle) {
  const std::int64_t outer_count = std::int64_t{1} << edge_depth, inner_count = k - 3;
  std::int64_t outer = 0, inner = 0;
  while (outer < outer_count || inner < inner_count) {
    // midpoints (outer + 1/2) / outer_count and (inner + 2) / k; inner point j lies over (j + 3/2) / k
    const bool take_outer =
        inner == inner_count || (outer < outer_count && (2 * outer + 1) * k <= 2 * (inner + 2) * outer_count);
    if (take_outer) {
      triangle(outer, false, outer + 1, false, inner, true);
      ++outer;
    } else {
      triangle(outer, false, inner + 1, true, inner, true);
      ++inner;
    }
  }
}

}  // namespace limitcheck::fast
