// SPDX-License-Identifier: MIT
// The limit points of one control edge at a depth of its own, along the edge only. [mueller2000, section 5]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/rules/prepared_mesh.h"

namespace limitcheck::fast {

/// A strip of three rows along an edge needs nothing else to be subdivided but the rings of its two ends:
///
///        up[0]  up[1]  up[2]            Work O(2^depth + depth * valence), not O(4^depth). The operations
///        /   \  /  \   /   \            are those of the sliding window, with the edge as axis: the points
///     line[0]-line[1]-line[2]-line[3]   have the bits that a pair of that depth gives them, from either
///        \   /  \  /   \   /            face. [D14]
///       down[0] down[1] down[2]
///                                       `up` lies in the face of the half-edge; `down` is missing on a
///                                       boundary edge.
///
/// Arrays are allocated once; one instance per thread.
template <class N, class Surface = LimitSurface<N>>
class EdgeStrip {
 public:
  using Vertex = typename Surface::Vertex;

  EdgeStrip(int max_depth, int max_valence) : max_depth_(max_depth), max_valence_(max_valence) {
    const std::size_t length = (std::size_t{1} << max_depth) + 1;
    const auto valence = static_cast<std::size_t>(std::max(max_valence, 2));
    storage_.resize(2 * (3 * length + 2 * valence));
    Vec3<N>* next = storage_.data();
    for (Rows& rows : rows_) {
      for (Vec3<N>** row : {&rows.line, &rows.up, &rows.down}) *row = std::exchange(next, next + length);
      for (Ring* ring : {&rows.left, &rows.right}) ring->ring = std::exchange(next, next + valence);
    }
  }

  /// Limit vertices at 0, 1, .., 2^depth of half-edge h from its origin into out[0 .. 2^depth].
  ///   throws   data::ArgumentError: depth or valence beyond the arrays
  void evaluate(const PreparedMesh<N, Surface>& mesh, std::int32_t h, int depth, Vertex* out) {
    if (depth < 0 || depth > max_depth_ || mesh.adjacency().max_valence() > max_valence_)
      throw data::ArgumentError("edge strip: depth or valence beyond the arrays");
    fill(mesh, h);
    Rows* from = &rows_[0];
    Rows* to = &rows_[1];
    for (int s = 0; s < depth; ++s) {
      refine(1 << s, *from, *to);
      std::swap(from, to);
    }
    const int n = 1 << depth;
    out[0] = *from->left.limit;
    out[n] = *from->right.limit;
    const Vec3<N>*line = from->line, *up = from->up;
    for (int i = 1; i < n; ++i) {
      if (has_down_)
        out[i] = regular_vertex_limit<N, Surface>(line[i], axis(*from, i), zero_normals_);
      else
        out[i] = boundary_vertex_limit<N, Surface>(line[i], line[i + 1], up[i], up[i - 1], line[i - 1],
                                                   zero_normals_);
    }
  }

  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  using Ring = CornerRing<N, Vertex>;
  struct Rows {
    Vec3<N>*line, *up, *down;
    Ring left, right;  // slot 0 along the line
  };

  static AxisRing<N> axis(const Rows& r, int i) {
    return {r.line[i + 1], r.up[i], r.up[i - 1], r.line[i - 1], r.down[i - 1], r.down[i]};
  }

  void fill(const PreparedMesh<N, Surface>& mesh, std::int32_t h) {
    const Adjacency& adjacency = mesh.adjacency();
    Rows& r = rows_[0];
    r.left = gather_corner(mesh, h, false, r.left.ring);
    // Around the far end, the neighbour counter-clockwise before the line's origin is that of the next
    // half-edge.
    r.right = gather_corner(mesh, Adjacency::next(h), true, r.right.ring);
    r.line[0] = mesh.position(adjacency.origin(h));
    r.line[1] = mesh.position(adjacency.target(h));
    has_down_ = r.right.has_face_after(0);
    r.up[0] = r.left.at(1);
    if (has_down_) r.down[0] = r.right.at(1);
  }

  void refine(int n, const Rows& old, Rows& out) {
    const Vec3<N>*line = old.line, *up = old.up, *down = old.down;
    out.line[0] = subdivide_corner(line[0], old.left);
    out.line[2 * n] = subdivide_corner(line[n], old.right);
    for (int i = 1; i < n; ++i)
      out.line[2 * i] =
          has_down_ ? regular_vertex(line[i], axis(old, i)) : curve_vertex(line[i], line[i + 1], line[i - 1]);
    for (int i = 0; i < n; ++i)
      out.line[2 * i + 1] =
          has_down_ ? edge_point(line[i], line[i + 1], up[i], down[i]) : midpoint(line[i], line[i + 1]);
    refine_flap(n, line, up, old.left.has_face_after(1), old.left.at(2),
                old.right.has_face_after(old.right.n - 2), old.right.ring[old.right.n - 2], out.up);
    if (has_down_)
      refine_flap(n, line, down, old.left.has_face_after(old.left.n - 2), old.left.ring[old.left.n - 2],
                  old.right.has_face_after(1), old.right.at(2), out.down);
    subdivide_ring(line[0], old.left, out.left);
    subdivide_ring(line[n], old.right, out.right);
  }

  /// The apexes over the edges of the line: before the first and after the last there is a face, or none.
  static void refine_flap(int n, const Vec3<N>* line, const Vec3<N>* apex, bool has_before,
                          const Vec3<N>& before, bool has_after, const Vec3<N>& after, Vec3<N>* out) {
    out[0] = has_before ? edge_point(line[0], apex[0], line[1], before) : midpoint(line[0], apex[0]);
    for (int i = 1; i < n; ++i) {
      out[2 * i - 1] = edge_point(apex[i - 1], line[i], line[i - 1], apex[i]);
      out[2 * i] = edge_point(line[i], apex[i], line[i + 1], apex[i - 1]);
    }
    out[2 * n - 1] =
        has_after ? edge_point(apex[n - 1], line[n], line[n - 1], after) : midpoint(apex[n - 1], line[n]);
  }

  int max_depth_, max_valence_;
  bool has_down_ = false;
  Rows rows_[2];
  std::vector<Vec3<N>> storage_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
