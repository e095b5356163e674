// SPDX-License-Identifier: MIT
// The rows that a step makes of rows of triangles; and the limit points of one control edge at a depth of its own,
// along the edge only. [mueller2000, section 5]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/rules/prepared_mesh.h"

namespace limitcheck::fast {

/// The inner points of a row of n edges between two others: body(i, ring), the six neighbours of line[i] along the row,
/// or along the pair's diagonal in the column where that meets the row. The apex over the edge from line[i] is
/// above[i + 1], the apex under it below[i].
template <class N, class Body>
void for_inner_points(int n, int diagonal, const Vec3<N>* line, const Vec3<N>* above, const Vec3<N>* below,
                      Body&& body) {
  const auto row = [&](int from, int to) {
    for (int i = from; i < to; ++i)
      body(i, AxisRing<N>{line[i + 1], above[i + 1], above[i], line[i - 1], below[i - 1], below[i]});
  };
  const int d = diagonal > 0 ? std::min(diagonal, n) : n;
  row(1, d);
  if (d == n) return;
  body(d, AxisRing<N>{above[d + 1], above[d], line[d - 1], below[d - 1], below[d], line[d + 1]});
  row(d + 1, n);
}

/// A row of n edges becomes one of 2 n.
///   diagonal       the column where the pair's diagonal meets it
///   above, below   the rows next to it; null beyond a boundary
template <class N, class Corner>
void refine_row(int n, int diagonal, const Vec3<N>* line, const Vec3<N>* above, const Vec3<N>* below,
                const Corner& left, const Corner& right, Vec3<N>* out) {
  out[0] = subdivide_corner(line[0], left);
  out[2 * n] = subdivide_corner(line[n], right);
  if (above == nullptr || below == nullptr) {
    for (int i = 1; i < n; ++i) out[2 * i] = curve_vertex(line[i], line[i + 1], line[i - 1]);
    for (int i = 0; i < n; ++i) out[2 * i + 1] = midpoint(line[i], line[i + 1]);
    return;
  }
  const auto edge = [&](int i) { out[2 * i + 1] = edge_point(line[i], line[i + 1], above[i + 1], below[i]); };
  edge(0);
  for_inner_points(n, diagonal, line, above, below, [&](int i, const AxisRing<N>& ring) {
    out[2 * i] = regular_vertex(line[i], ring);
    edge(i);
  });
}

/// The apexes over or under the edges of a row become 2 n: before the first and after the last there is a face, or
/// none.
template <class N>
void refine_flap(int n, const Vec3<N>* line, const Vec3<N>* apex, bool has_before, const Vec3<N>& before,
                 bool has_after, const Vec3<N>& after, Vec3<N>* out) {
  out[0] = has_before ? edge_point(line[0], apex[0], line[1], before) : midpoint(line[0], apex[0]);
  for (int i = 1; i < n; ++i) {
    out[2 * i - 1] = edge_point(apex[i - 1], line[i], line[i - 1], apex[i]);
    out[2 * i] = edge_point(line[i], apex[i], line[i + 1], apex[i - 1]);
  }
  out[2 * n - 1] =
      has_after ? edge_point(apex[n - 1], line[n], line[n - 1], after) : midpoint(apex[n - 1], line[n]);
}

/// Limit vertices of a row into out[0], out[step], .., out[step * n].
template <class N, class Surface, class Corner>
void limit_row(int n, int diagonal, const Vec3<N>* line, const Vec3<N>* above, const Vec3<N>* below,
               const Corner& left, const Corner& right, int step, typename Surface::Vertex* out,
               std::int64_t& zero_normals) {
  out[0] = limit_corner<N, Surface>(line[0], left, zero_normals);
  out[step * n] = limit_corner<N, Surface>(line[n], right, zero_normals);
  if (above == nullptr) {
    for (int i = 1; i < n; ++i)
      out[step * i] = boundary_vertex_limit<N, Surface>(line[i], line[i - 1], below[i - 1], below[i],
                                                        line[i + 1], zero_normals);
    return;
  }
  if (below == nullptr) {
    for (int i = 1; i < n; ++i)
      out[step * i] = boundary_vertex_limit<N, Surface>(line[i], line[i + 1], above[i + 1], above[i],
                                                        line[i - 1], zero_normals);
    return;
  }
  for_inner_points(n, diagonal, line, above, below, [&](int i, const AxisRing<N>& ring) {
    out[step * i] = regular_vertex_limit<N, Surface>(line[i], ring, zero_normals);
  });
}

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
    limit_row<N, Surface>(n, 0, from->line, from->up - 1, down(*from), from->left, from->right, 1, out,
                          zero_normals_);
  }

  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  using Ring = CornerRing<N, Vertex>;
  struct Rows {
    Vec3<N>*line, *up, *down;
    Ring left, right;  // slot 0 along the line
  };

  /// Null beyond a boundary.
  const Vec3<N>* down(const Rows& r) const { return has_down_ ? r.down : nullptr; }

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
    const Vec3<N>*line = old.line, *up = old.up;
    refine_row(n, 0, line, up - 1, down(old), old.left, old.right, out.line);
    refine_flap<N>(n, line, up, old.left.has_face_after(1), old.left.at(2),
                   old.right.has_face_after(old.right.n - 2), old.right.ring[old.right.n - 2], out.up);
    if (has_down_)
      refine_flap<N>(n, line, old.down, old.left.has_face_after(old.left.n - 2),
                     old.left.ring[old.left.n - 2], old.right.has_face_after(1), old.right.at(2), out.down);
    subdivide_ring(line[0], old.left, out.left);
    subdivide_ring(line[n], old.right, out.right);
  }

  int max_depth_, max_valence_;
  bool has_down_ = false;
  Rows rows_[2];
  std::vector<Vec3<N>> storage_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
