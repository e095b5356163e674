// SPDX-License-Identifier: MIT
// The limit points of one side of a quad at a depth of its own, along the side only. [mueller2000, section 5]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/window/quad_rows.h"

namespace limitcheck::fast {

/// Three rows along a side need nothing else to be subdivided but the rings of its two ends, which give the
/// first and last point of the outer rows:
///
///       up[0] ---- up[1] ---- up[2]       `up` lies in the quad of the half-edge;
///         |          |          |         `down` is missing on a boundary.
///      line[0] -- line[1] -- line[2]
///         |          |          |
///      down[0] -- down[1] -- down[2]
///
/// Work O(2^depth + depth * valence). The operations are those of QuadWindow, so the points have the bits that
/// a quad of that depth gives them, from either side. [D14]
///
/// Arrays are allocated once; one instance per thread.
template <class N, class Surface = LimitSurface<N>>
class QuadEdge {
 public:
  using Vertex = typename Surface::Vertex;

  QuadEdge(int max_depth, int max_valence) : max_depth_(max_depth), max_valence_(std::max(max_valence, 4)) {
    const std::size_t length = (std::size_t{1} << max_depth) + 1;
    const std::size_t ring = 2 * static_cast<std::size_t>(max_valence_) + 1;
    storage_.resize(2 * (3 * length + 2 * ring));
    strip_.resize(2 * length);
    Vec3<N>* next = storage_.data();
    for (Rows& rows : rows_) {
      for (Vec3<N>** row : {&rows.line, &rows.up, &rows.down}) *row = std::exchange(next, next + length);
      for (Corner* corner : {&rows.left, &rows.right}) corner->star.ring = std::exchange(next, next + ring);
    }
  }

  /// Limit vertices at 0, 1, .., 2^depth of half-edge h from its origin into out[0 .. 2^depth].
  ///   throws   data::ArgumentError: depth or valence beyond the arrays
  void evaluate(const PreparedQuads<N, Surface>& mesh, std::int32_t h, int depth, Vertex* out) {
    const QuadAdjacency& adjacency = mesh.mesh().adjacency;
    if (depth < 0 || depth > max_depth_ || adjacency.max_valence() > max_valence_)
      throw data::ArgumentError("quad edge: depth or valence beyond the arrays");
    side_.fill(mesh, h, depth, false);
    Rows *from = &rows_[0], *to = &rows_[1];
    from->left = gather_corner(mesh, h, from->left.star.ring);
    from->right = gather_corner(mesh, QuadAdjacency::next(h), from->right.star.ring);
    from->line[0] = from->left.star.centre;
    from->line[1] = from->right.star.centre;
    put_ends(*from, 1);
    const QuadSide none;  // the ends come from the rings
    const RowEnds ends{&none, &none};
    for (int s = 0; s < depth; ++s) {
      const int n = 1 << s;
      const Vec3<N>* const down = side_.inside() ? from->down : nullptr;
      odd_row(n, from->up, from->line, ends, s, -1, to->up);
      if (down != nullptr) odd_row(n, from->line, down, ends, s, -1, to->down);
      even_row(n, from->line, from->up, down, to->up, down == nullptr ? nullptr : to->down, ends, &side_, s,
               -1, to->line);
      subdivide_corner(from->left, to->left);
      subdivide_corner(from->right, to->right);
      to->line[0] = to->left.star.centre;
      to->line[2 * n] = to->right.star.centre;
      put_ends(*to, 2 * n);
      std::swap(from, to);
    }
    const int n = 1 << depth;
    limit_row<N, Surface>(n, from->line, from->up, side_.inside() ? from->down : nullptr, ends, &side_, depth,
                          -1, strip_.data(), zero_normals_);
    out[0] = *from->left.limit;
    for (int i = 1; i < n; ++i) out[i] = strip_[2 * static_cast<std::size_t>(i)];
    out[n] = *from->right.limit;
  }

  std::int64_t zero_normals() const { return zero_normals_; }

 private:
  using Corner = QuadCorner<N, Vertex>;
  struct Rows {
    Vec3<N>*line, *up, *down;
    Corner left, right;
  };

  void put_ends(Rows& r, int n) const {
    r.up[0] = r.left.star.edge(r.left.sector + 1);
    r.up[n] = r.right.star.edge(r.right.sector);
    if (!side_.inside()) return;
    r.down[0] = r.left.beyond_right();
    r.down[n] = r.right.beyond_left();
  }

  int max_depth_, max_valence_;
  QuadSide side_;
  Rows rows_[2];
  std::vector<Vec3<N>> storage_;
  std::vector<Vertex> strip_;
  std::int64_t zero_normals_ = 0;
};

}  // namespace limitcheck::fast
