// SPDX-License-Identifier: MIT
// The limit points of one control edge at a depth of its own, along the edge only. [mueller2000, section 5]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/window/sliding_window.h"

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
        out[i] =
            regular_vertex_limit<N, Surface>(line[i], along_row(line, up - 1, from->down, i), zero_normals_);
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
    refine_row(n, 0, line, up - 1, has_down_ ? down : nullptr, old.left, old.right, out.line);
    const Ring &left = old.left, &right = old.right;
    refine_apexes(n, line, up, left.has_face_after(1), left.at(2), right.has_face_after(right.n - 2),
                  right.ring[right.n - 2], out.up);
    if (has_down_)
      refine_apexes(n, line, down, left.has_face_after(left.n - 2), left.ring[left.n - 2],
                    right.has_face_after(1), right.at(2), out.down);
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
