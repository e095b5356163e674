// SPDX-License-Identifier: MIT
// Rows of points of a mesh of quads, the rows that a step makes of them, and the sides that they end at; and the limit
// points of one side at a depth of its own. [mueller2000, section 5]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/rules/prepared_quads.h"

namespace limitcheck::fast {

/// What the window asks of a side. Parts are counted from one of its ends.
class QuadSide {
 public:
  /// `depth` levels are to come.
  ///   reversed   count parts from the target of half-edge h
  template <class N, class Surface>
  void fill(const PreparedQuads<N, Surface>& mesh, std::int32_t h, int depth, bool reversed) {
    inside_ = mesh.mesh().adjacency.twin(h) >= 0;
    reversed_ = reversed;
    creasing_ = mesh.mesh().creasing;
    if (mesh.semi_sharp().has(h))
      mesh.semi_sharp().along(h, depth + 1, sharpness_);
    else
      sharpness_.clear();
  }

  /// Whether there is a face beyond.
  bool inside() const { return inside_; }
  bool semi_sharp() const { return !sharpness_.empty(); }
  /// The share of the midpoint in the point of part i of 2^level, and of the curve in point i = 1 .. 2^level
  /// - 1.
  double edge_share(int level, int i) const {
    if (sharpness_.empty()) return 0;
    const SidePart p = part(level, i);
    return edge_crease_share(p.sharpness, p.first_half, p.second_half);
  }
  double point_share(int level, int i) const {
    if (sharpness_.empty()) return 0;
    return curve_share(at(level, i - 1), at(level, i), creasing_);
  }
  bool sharp_at(int level, int i) const {
    return !sharpness_.empty() && (at(level, i - 1) > 0 || at(level, i) > 0);
  }
  SidePart part(int level, int i) const {
    return {at(level, i), at(level + 1, 2 * i), at(level + 1, 2 * i + 1)};
  }
  data::Creasing creasing() const { return creasing_; }

 private:
  double at(int level, int i) const {
    const std::size_t n = std::size_t{1} << level, k = static_cast<std::size_t>(i);
    return sharpness_[n - 1 + (reversed_ ? n - 1 - k : k)];
  }

  bool inside_ = false, reversed_ = false;
  data::Creasing creasing_ = data::Creasing::kUniform;
  std::vector<double> sharpness_;
};

/// The two sides that all rows end at, from the first to the last row. A row of n edges has the points 0 .. n
/// and one more beyond each end that has a face beyond it: -1, n + 1.
struct RowEnds {
  const QuadSide *left, *right;

  int first() const { return left->inside() ? -1 : 0; }
  int last(int n) const { return right->inside() ? n + 1 : n; }
};

/// The row between two rows, 2 n edges of n: middles of faces, and of the edges between the rows.
///   level, part   of the sides: the part between the two rows; -1 for rows beyond the quad
template <class N>
void odd_row(int n, const Vec3<N>* above, const Vec3<N>* below, const RowEnds& ends, int level, int part,
             Vec3<N>* out) {
  for (int i = ends.first(); i < ends.last(n); ++i)
    out[2 * i + 1] = quad_face_point(above[i], above[i + 1], below[i + 1], below[i]);
  const auto end = [&](const QuadSide& side, int i) {
    if (!side.inside()) {
      out[2 * i] = midpoint(above[i], below[i]);
      return;
    }
    out[2 * i] = quad_edge_point(above[i], below[i], out[2 * i - 1], out[2 * i + 1]);
    if (const double share = part < 0 ? 0 : side.edge_share(level, part); share > 0)
      out[2 * i] =
          share < 1 ? blend(share, midpoint(above[i], below[i]), out[2 * i]) : midpoint(above[i], below[i]);
  };
  end(*ends.left, 0);
  for (int i = 1; i < n; ++i)
    out[2 * i] = quad_edge_point(above[i], below[i], out[2 * i - 1], out[2 * i + 1]);
  end(*ends.right, n);
}

/// Blends a point on a semi-sharp line of three, of which it is the middle one.
template <class N>
void add_curve(double share, const Vec3<N>& v, const Vec3<N>& e, const Vec3<N>& w, Vec3<N>& point) {
  if (share > 0) point = share < 1 ? blend(share, curve_vertex(v, e, w), point) : curve_vertex(v, e, w);
}

/// The row that a row becomes: 2 n edges of n. Its ends are those of the quad's sides.
///   above, below           the rows next to it, and the odd rows made of them; null beyond a boundary
///   side                   the side that this row is, or null inside
///   level, row             of the left and right side: which point of theirs it passes; -1: their corner,
///                          and points 0 and 2 n are left out, as are -1 and 2 n + 1
template <class N>
void even_row(int n, const Vec3<N>* line, const Vec3<N>* above, const Vec3<N>* below,
              const Vec3<N>* odd_above, const Vec3<N>* odd_below, const RowEnds& ends, const QuadSide* side,
              int level, int row, Vec3<N>* out) {
  const bool curve = odd_above == nullptr || odd_below == nullptr;
  const auto edge = [&](int i) {
    if (curve) {
      out[2 * i + 1] = midpoint(line[i], line[i + 1]);
      return;
    }
    out[2 * i + 1] = quad_edge_point(line[i], line[i + 1], odd_above[2 * i + 1], odd_below[2 * i + 1]);
    if (side == nullptr || i < 0 || i >= n) return;
    if (const double share = side->edge_share(level, i); share > 0)
      out[2 * i + 1] = share < 1 ? blend(share, midpoint(line[i], line[i + 1]), out[2 * i + 1])
                                 : midpoint(line[i], line[i + 1]);
  };
  const auto vertex = [&](int i) {
    if (curve) {
      out[2 * i] = curve_vertex(line[i], line[i + 1], line[i - 1]);
      return;
    }
    out[2 * i] = regular_quad_vertex(
        line[i], QuadNeighbours<N>{line[i + 1], odd_above[2 * i + 1], above[i], odd_above[2 * i - 1],
                                   line[i - 1], odd_below[2 * i - 1], below[i], odd_below[2 * i + 1]});
    if (side != nullptr)
      add_curve(side->point_share(level, i), line[i], line[i + 1], line[i - 1], out[2 * i]);
  };
  for (int i = 0; i < n; ++i) edge(i);
  for (int i = 1; i < n; ++i) vertex(i);
  if (row < 0) return;
  const auto end = [&](const QuadSide& at, int i, int beyond) {
    if (!at.inside()) {
      out[2 * i] = curve_vertex(line[i], above[i], below[i]);
      return;
    }
    edge(beyond);
    vertex(i);
    add_curve(at.point_share(level, row), line[i], above[i], below[i], out[2 * i]);
  };
  end(*ends.left, 0, -1);
  end(*ends.right, n, n);
}

/// Limit vertices of a row into every other place of `out`, points 0 and n by the caller if it is a side.
///   row   as above: -1 where the ends are corners
template <class N, class Surface>
void limit_row(int n, const Vec3<N>* line, const Vec3<N>* above, const Vec3<N>* below, const RowEnds& ends,
               const QuadSide* side, int level, int row, typename Surface::Vertex* out,
               std::int64_t& zero_normals) {
  const auto regular = [&](int i) {
    const QuadNeighbours<N> ring{line[i + 1], above[i + 1], above[i], above[i - 1],
                                 line[i - 1], below[i - 1], below[i], below[i + 1]};
    out[2 * i] = quad_vertex_limit<N, Surface>(line[i], ring, zero_normals);
  };
  for (int i = 1; i < n; ++i) {
    if (above == nullptr)
      out[2 * i] = quad_boundary_limit<N, Surface>(line[i], line[i - 1], below[i - 1], below[i], below[i + 1],
                                                   line[i + 1], zero_normals);
    else if (below == nullptr)
      out[2 * i] = quad_boundary_limit<N, Surface>(line[i], line[i + 1], above[i + 1], above[i], above[i - 1],
                                                   line[i - 1], zero_normals);
    else if (side != nullptr && side->sharp_at(level, i))
      out[2 * i] = semi_sharp_limit<N, Surface>(line[i],
                                                {line[i + 1], above[i + 1], above[i], above[i - 1],
                                                 line[i - 1], below[i - 1], below[i], below[i + 1]},
                                                side->part(level, i - 1), side->part(level, i),
                                                side->creasing(), zero_normals);
    else
      regular(i);
  }
  if (row < 0) return;
  const auto end = [&](const QuadSide& at, int i, int in) {
    // Seen along the side, downwards on the left and upwards on the right, so that the quad is to the left.
    const Vec3<N>*next = in > 0 ? below : above, *previous = in > 0 ? above : below;
    if (!at.inside())
      out[2 * i] = quad_boundary_limit<N, Surface>(line[i], next[i], next[i + in], line[i + in],
                                                   previous[i + in], previous[i], zero_normals);
    else if (at.sharp_at(level, row))
      out[2 * i] = semi_sharp_limit<N, Surface>(line[i],
                                                {below[i], below[i + 1], line[i + 1], above[i + 1], above[i],
                                                 above[i - 1], line[i - 1], below[i - 1]},
                                                at.part(level, row - 1), at.part(level, row), at.creasing(),
                                                zero_normals);
    else
      regular(i);
  };
  end(*ends.left, 0, 1);
  end(*ends.right, n, -1);
}

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
