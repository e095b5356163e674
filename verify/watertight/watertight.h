// SPDX-License-Identifier: MIT
// Exact watertightness of a triangle soup: no tolerance, no welding.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limitcheck::verify {

/// Which vertices are one point.
///   point_of   for each vertex the number of its point, by first appearance; -1: a vertex that is not finite
///   vertex_of  for each point its first vertex
struct MergedPoints {
  std::vector<std::int32_t> point_of;
  std::vector<std::int32_t> vertex_of;
};

/// Merges vertices whose three coordinates are equal as numbers and nothing else: bit-identical coordinates,
/// and -0 with +0, which are the same place to every consumer (`shared-positions` compares the bits of
/// zeros). A vertex with a NaN or an infinity is merged with nothing.
///   positions  3 * n coordinates
/// O(n log n), in parallel; the result does not depend on the number of threads.
MergedPoints merge_identical(std::span<const float> positions);
MergedPoints merge_identical(std::span<const double> positions);

/// What is wrong with an indexed triangle set as a surface. Counts are of elements; each list holds the first
/// few witnesses in ascending order, except `open_edges`, which is complete.
struct SurfaceReport {
  struct Edge {
    std::int32_t from, to;  // points
    std::int32_t triangle;  // the triangle that runs along it in this direction
  };

  std::int64_t points = 0, triangles = 0;
  std::int64_t edges = 0;                 // undirected, of the triangles that are not degenerate
  std::int64_t degenerate_triangles = 0;  // two corners in one point, or a corner that is not finite
  std::int64_t duplicate_triangles = 0;   // the same three points as an earlier triangle, in any order
  std::int64_t crowded_edges = 0;         // more than two triangles
  std::int64_t clashing_edges = 0;        // two triangles that run the same way
  std::int64_t bow_tie_points = 0;        // the triangles at the point form more than one fan
  std::int64_t open_loops = 0;            // closed walks along the open edges; -1 where they branch
  std::vector<Edge> open_edges;           // one triangle only, by ascending `from`

  std::vector<std::int32_t> degenerate_witness;         // triangles
  std::vector<std::int32_t> duplicate_witness;          // triangles
  std::vector<Edge> crowded_witness, clashing_witness;  // edges
  std::vector<std::int32_t> bow_tie_witness;            // points

  /// Every edge has one triangle or two that run opposite ways, every point one fan.
  bool manifold() const {
    return degenerate_triangles + duplicate_triangles + crowded_edges + clashing_edges + bow_tie_points == 0;
  }
  /// All that is looked at: no count of faults is larger.
  std::int64_t elements() const { return points + edges + triangles; }
  bool closed() const { return manifold() && open_edges.empty(); }
};

/// Two corners are one point, or one is not finite.
inline bool is_degenerate(const std::array<std::int32_t, 3>& t) {
  return t[0] < 0 || t[1] < 0 || t[2] < 0 || t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// Looks at the surface that `triangles` (3 indices each, into 0..point_count-1, -1 for a point that is not
/// finite) forms. Linear in the input, in parallel; the result does not depend on the number of threads.
SurfaceReport inspect_surface(std::int64_t point_count,
                              std::span<const std::array<std::int32_t, 3>> triangles);

/// The same question put to CGAL's Surface_mesh, which shares no code with the above.
struct SurfaceJudgement {
  std::int64_t refused_triangles = 0;  // add_face: would not be manifold, or not consistently oriented
  std::int64_t bow_tie_points = 0;
  std::int64_t boundary_cycles = 0;
  bool valid = false;  // CGAL::is_valid_polygon_mesh
  bool closed = false;

  bool manifold() const { return refused_triangles == 0 && bow_tie_points == 0 && valid; }
};

/// CGAL's judgement. Some 0.3 microseconds and 150 bytes a triangle.
SurfaceJudgement judge_surface(std::int64_t point_count,
                               std::span<const std::array<std::int32_t, 3>> triangles);

/// Points that lie exactly inside an open edge, in exact arithmetic: geometric T-vertices. Only points on
/// open edges are looked at, since no other can be one on a surface that is otherwise manifold.
struct TVertex {
  std::int32_t point;
  std::int32_t edge;  // index into the open edges
};
std::vector<TVertex> find_t_vertices(std::span<const double> positions,
                                     std::span<const std::int32_t> vertex_of,
                                     std::span<const SurfaceReport::Edge> open_edges);

}  // namespace limitcheck::verify
