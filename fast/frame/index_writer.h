// SPDX-License-Identifier: MIT
// Writes patches into one indexed mesh in which every point of a control vertex or edge appears once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/frame/draw_writer.h"

namespace limitcheck::fast {

/// Where vertices and triangles go: first the vertices of control vertices, then those of control edges, then
/// those of faces; triangles by face. It depends on the depths alone, not on the pairing.
struct IndexLayout {
  static constexpr std::int64_t kUnused = -1;

  std::vector<std::int64_t> vertex;          // per control vertex, kUnused if no displayed face has it
  std::vector<std::int64_t> edge;            // per half-edge: index of its points 1 .. 2^d - 1
  std::vector<std::uint8_t> reversed;        // per half-edge: the points are those of its twin, counted back
  std::vector<std::int64_t> interior;        // per face: its interior points, or its centre
  std::vector<std::int64_t> first_triangle;  // per face
  std::int64_t vertex_count = 0, triangle_count = 0;

  /// Two faces share the points of an edge if both give it the same depth, which they do unless cracks are
  /// left open; the smaller half-edge owns them.
  static IndexLayout of(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                        const CrackPlan& plan) {
    IndexLayout l;
    const auto faces = static_cast<std::size_t>(adjacency.face_count());
    l.vertex.assign(static_cast<std::size_t>(adjacency.vertex_count()), kUnused);
    l.edge.assign(3 * faces, kUnused);
    l.reversed.assign(3 * faces, 0);
    l.interior.assign(faces, kUnused);
    l.first_triangle.assign(faces, kUnused);
    for (std::size_t f = 0; f < faces; ++f)
      if (depth[f] >= 0)
        for (int k = 0; k < 3; ++k) l.vertex[adjacency.corner(static_cast<std::int32_t>(f), k)] = 0;
    for (std::int64_t& v : l.vertex)
      if (v != kUnused) v = l.vertex_count++;
    for (std::size_t h = 0; h < 3 * faces; ++h) {
      if (depth[h / 3] < 0) continue;
      const auto twin = static_cast<std::size_t>(adjacency.twin(static_cast<std::int32_t>(h)));
      if (twin < h && plan.edge_depth[twin] == plan.edge_depth[h]) {
        l.edge[h] = l.edge[twin];
        l.reversed[h] = 1;
      } else {
        l.edge[h] = l.vertex_count;
        l.vertex_count += (std::int64_t{1} << plan.edge_depth[h]) - 1;
      }
    }
    for (std::size_t f = 0; f < faces; ++f) {
      if (depth[f] < 0) continue;
      const std::int64_t k = std::int64_t{1} << depth[f];
      std::int64_t border = 0;
      for (std::size_t e = 0; e < 3; ++e) border += std::int64_t{1} << plan.edge_depth[3 * f + e];
      l.interior[f] = l.vertex_count;
      l.first_triangle[f] = l.triangle_count;
      const bool fan = plan.display[f] == Display::kFan;
      l.vertex_count += fan ? 1 : interior_points(k);
      l.triangle_count += fan                                   ? border
                          : plan.display[f] == Display::kStitch ? (k - 3) * (k - 3) + border + 3 * (k - 3)
                                                                : k * k;
    }
    return l;
  }

  /// Index of point t = 0 .. 2^d of half-edge h.
  std::uint32_t on_edge(const Adjacency& adjacency, std::int32_t h, int d, std::int64_t t) const {
    const std::int64_t count = std::int64_t{1} << d;
    if (t == 0) return static_cast<std::uint32_t>(vertex[adjacency.origin(h)]);
    if (t == count) return static_cast<std::uint32_t>(vertex[adjacency.target(h)]);
    return static_cast<std::uint32_t>(edge[h] + (reversed[h] != 0 ? count - t : t) - 1);
  }
};

/// Writes one half after the other; different halves write to different places.
template <class Real>
class IndexWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  IndexWriter(const Adjacency& adjacency, const Patch& patch, const CrackPlan& plan,
              const IndexLayout& layout, const Placement<Real>& placement, IndexedMesh<Real>& out)
      : adjacency_(adjacency),
        patch_(patch),
        plan_(plan),
        layout_(layout),
        placement_(placement),
        out_(out),
        k_(1 << patch.depth) {}

  template <class At>
  void whole_strip(int row, At&& at) {
    half_strip(0, row, at);
    if constexpr (std::is_same_v<std::decay_t<At>, RowPair<Real>>)
      half_strip(1, k_ - 1 - row, at.turned(k_));
    else
      half_strip(1, k_ - 1 - row, [&](int q) -> const Vertex& { return at(2 * k_ + 1 - q); });
  }

  template <class At>
  void half_strip(int side, int row, At&& at) {
    const Half& half = patch_.half[side];
    const bool stitch = half.display == Display::kStitch;
    // Every row is written with the strip below it; row k is a corner.
    write_row(half, stitch, row, at);

    if (row == 0) write_triangles(half, stitch);
  }

  void fan(int side, const Vertex& centre, const Border<Real>& border) {
    const std::int32_t face = patch_.half[side].face;
    const std::int64_t middle = layout_.interior[face];
    write(middle, centre, {face, 1, 1, 3});
    write_border(face, border);
    std::int64_t out = layout_.first_triangle[face];
    for (int e = 0; e < 3; ++e) {
      const int d = edge_depth(plan_, face, e);
      for (std::int64_t t = 0; t < (std::int64_t{1} << d); ++t)
        triangle(out++, face, Kind::kFan, static_cast<std::uint32_t>(middle),
                 layout_.on_edge(adjacency_, 3 * face + e, d, t),
                 layout_.on_edge(adjacency_, 3 * face + e, d, t + 1));
    }
  }

  void ring(int side, const Border<Real>& border) {
    const Half& half = patch_.half[side];
    write_border(half.face, border);
    std::int64_t out = layout_.first_triangle[half.face] + static_cast<std::int64_t>(k_ - 3) * (k_ - 3);
    for (int e = 0; e < 3; ++e) {
      const int d = edge_depth(plan_, half.face, e);
      const auto point = [&](std::int64_t t, bool is_inner) {
        if (!is_inner) return layout_.on_edge(adjacency_, 3 * half.face + e, d, t);
        // weights k - t - 2, t + 1, 1 at corners e, e + 1, e + 2, in the half's frame
        const int w[3] = {k_ - static_cast<int>(t) - 2, static_cast<int>(t) + 1, 1};
        return index(half, w[(half.edge - e + 3) % 3], w[(half.edge - e + 4) % 3]);
      };
      stitch_edge(k_, d, [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
        triangle(out++, half.face, Kind::kStitched, point(a, ai), point(b, bi), point(c, ci));
      });
    }
  }

 private:
  /// Index of (row, column) of a half whose face has its own depth on all edges; of others, interior points
  /// only.
  std::uint32_t index(const Half& half, int row, int column) const {
    const std::int32_t h = 3 * half.face;
    if (row + column == k_) return layout_.on_edge(adjacency_, h + half.edge, patch_.depth, column);
    if (row == 0) return layout_.on_edge(adjacency_, h + (half.edge + 1) % 3, patch_.depth, k_ - column);
    if (column == 0) return layout_.on_edge(adjacency_, h + (half.edge + 2) % 3, patch_.depth, row);
    return static_cast<std::uint32_t>(layout_.interior[half.face] + interior_before(k_, row) + column - 1);
  }

  /// index() of all columns of a row, but of those on the border if the face has another depth there.
  void indices(const Half& half, int row, std::uint32_t* out) const {
    const int last = k_ - row;
    out[0] = index(half, row, 0), out[last] = index(half, row, last);
    if (last < 2) return;
    const std::uint32_t first = index(half, row, 1);
    const std::uint32_t step = row > 0 || last == 2 ? 1 : index(half, row, 2) - first;  // 1 or -1
    for (int c = 1; c < last; ++c) out[c] = first + static_cast<std::uint32_t>(c - 1) * step;
  }

  /// The triangles of all rows; of a stitched half those within its outer ring.
  void write_triangles(const Half& half, bool stitch) {
    const int from = stitch ? 1 : 0, rows = stitch ? k_ - 3 : k_;
    const std::int64_t first = layout_.first_triangle[half.face], count = std::int64_t{rows} * rows;
    std::fill_n(out_.triangle_face.data() + first, count, half.face);
    std::fill_n(out_.triangle_kind.data() + first, count, stitch ? Kind::kStitched : patch_.kind);
    std::array<std::uint32_t, (1 << kDeepest) + 1> row_a, row_b;  // NOLINT: filled as far as they are read
    std::uint32_t *upper = row_a.data(), *lower = row_b.data();
    indices(half, from, upper);
    std::array<std::uint32_t, 3>* out = out_.triangles.data() + first;
    for (int row = from, end = from + rows; row < from + rows; ++row, --end) {
      indices(half, row + 1, lower);
      for (int c = from; c + 1 < end; ++c, out += 2) {
        out[0] = {upper[c], lower[c], upper[c + 1]};
        out[1] = {upper[c + 1], lower[c], lower[c + 1]};
      }
      *out++ = {upper[end - 1], lower[end - 1], upper[end]};
      std::swap(upper, lower);
    }
  }

  /// Whether this half writes the points inside that edge.
  bool owns(std::int32_t h) const { return layout_.reversed[h] == 0; }

  /// The points of a row: those with even numbers of the strip below it.
  template <class At>
  void write_row(const Half& half, bool only_interior, int row, const At& at) {
    if (only_interior && (row < 1 || row > k_ - 2)) return;
    const int last = k_ - row;
    const std::int32_t h = 3 * half.face;
    if (!only_interior && row > 0) {
      if (owns(h + (half.edge + 2) % 3)) write(index(half, row, 0), at(0), half.lattice(k_, row, 0));
      if (owns(h + half.edge)) write(index(half, row, last), at(2 * last), half.lattice(k_, row, last));
    }
    if (last < 2 || (row == 0 && !owns(h + (half.edge + 1) % 3))) return;
    if (row > 0 && out_.provenance.empty() && placement_.is_identity()) {
      Vertex* to = out_.vertices.data() + index(half, row, 1);
      if constexpr (std::is_same_v<At, RowPair<Real>>) {
        if (at.step == 1)
          return copy_vertices(&at(2), static_cast<std::size_t>(last) - 1, to, Stores::kOrdinary);
      }
      for (int c = 1; c < last; ++c) *to++ = at(2 * c);
      return;
    }
    for (int c = 1; c < last; ++c) write(index(half, row, c), at(2 * c), half.lattice(k_, row, c));
  }

  void write_border(std::int32_t face, const Border<Real>& border) {
    for (int e = 0; e < 3; ++e) {
      if (!owns(3 * face + e)) continue;
      const int d = edge_depth(plan_, face, e);
      for (int t = 1; t < (1 << d); ++t)
        write(layout_.on_edge(adjacency_, 3 * face + e, d, t), border[e][t],
              lattice_on_edge(face, e, t, 1 << d));
    }
  }

  void write(std::int64_t at, const Vertex& vertex, const LatticePoint& lattice) {
    out_.vertices[at] = placed(vertex, placement_);
    if (!out_.provenance.empty()) out_.provenance[at] = lattice;
  }
  void triangle(std::int64_t at, std::int32_t face, Kind kind, std::uint32_t a, std::uint32_t b,
                std::uint32_t c) {
    out_.triangles[at] = {a, b, c};
    out_.triangle_face[at] = face;
    out_.triangle_kind[at] = kind;
  }

  const Adjacency& adjacency_;
  const Patch& patch_;
  const CrackPlan& plan_;
  const IndexLayout& layout_;
  const Placement<Real>& placement_;
  IndexedMesh<Real>& out_;
  int k_;
};

}  // namespace limitcheck::fast
