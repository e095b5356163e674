// SPDX-License-Identifier: MIT
// Writes the patches of either scheme into one indexed mesh in which every point of a control vertex or edge appears
// once, or once on either side of a cut.
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
#include "fast/plan/depth.h"

namespace limitcheck::fast {

/// Where vertices and triangles go: first the vertices of control vertices, then those of control edges, then
/// those of faces; triangles by face. It depends on the depths alone, not on the pairing.
///
/// The points inside a face that was cut into parts: its centre, then part by part those with i = 1 .. m and
/// j = 1 .. m - 1, row by row. Those with j = m are points i = m of the part before.
struct IndexLayout {
  static constexpr std::int64_t kUnused = -1;

  std::vector<std::int64_t> vertex;          // per vertex, kUnused if no displayed face has it
  std::vector<std::int64_t> side;            // per side: index of its points 1 .. 2^d - 1
  std::vector<std::uint8_t> reversed;        // per side: the points are those of its twin, counted back
  std::vector<std::int64_t> interior;        // per face: its interior points, or its centre
  std::vector<std::int64_t> first_triangle;  // per face
  std::int64_t vertex_count = 0, triangle_count = 0;

  /// Two faces share the points of an edge if both give it the same depth, which they do unless cracks are
  /// left open; the smaller side owns them.
  template <class Faces>
  static IndexLayout of(const Faces& faces, std::span<const std::int32_t> depth, const CrackPlan& plan) {
    IndexLayout l;
    const std::int32_t sides = faces.first_side(faces.size());
    l.vertex.assign(static_cast<std::size_t>(faces.vertex_count()), kUnused);
    l.side.assign(static_cast<std::size_t>(sides), kUnused);
    l.reversed.assign(l.side.size(), 0);
    l.interior.assign(depth.size(), kUnused);
    l.first_triangle.assign(depth.size(), kUnused);
    for (std::int32_t c = 0; c < sides; ++c)
      if (depth[faces.face_of(c)] >= 0) l.vertex[faces.vertex(c)] = 0;
    for (std::int64_t& v : l.vertex)
      if (v != kUnused) v = l.vertex_count++;
    for (std::int32_t c = 0; c < sides; ++c) {
      if (depth[faces.face_of(c)] < 0) continue;
      const std::int32_t twin = faces.twin(c);
      if (twin >= 0 && twin < c && plan.edge_depth[twin] == plan.edge_depth[c]) {
        l.side[c] = l.side[twin];
        l.reversed[c] = 1;
      } else {
        l.side[c] = l.vertex_count;
        l.vertex_count += (std::int64_t{1} << plan.edge_depth[c]) - 1;
      }
    }
    for (std::int32_t f = 0; f < faces.size(); ++f) {
      if (depth[f] < 0) continue;
      const FaceSize inside = face_size(faces, f, depth[f], plan);
      l.interior[f] = std::exchange(l.vertex_count, l.vertex_count + inside.points);
      l.first_triangle[f] = std::exchange(l.triangle_count, l.triangle_count + inside.triangles);
    }
    return l;
  }

  /// Index of point t = 0 .. 2^d of a side.
  template <class Faces>
  std::uint32_t on_side(const Faces& faces, std::int32_t c, int d, std::int64_t t) const {
    const std::int64_t count = std::int64_t{1} << d;
    if (t == 0) return static_cast<std::uint32_t>(vertex[faces.vertex(c)]);
    if (t == count) return static_cast<std::uint32_t>(vertex[faces.vertex(faces.next(c))]);
    return static_cast<std::uint32_t>(side[c] + (reversed[c] != 0 ? count - t : t) - 1);
  }
};

/// What the writers of both schemes do alike. Different patches write to different places.
template <class Real, class Faces>
class IndexOutput {
 public:
  using Vertex = SurfaceVertex<Real>;

 protected:
  IndexOutput(const Faces& faces, const CrackPlan& plan, const IndexLayout& layout,
              const Placement<Real>& placement, IndexedMesh<Real>& out)
      : faces_(faces), plan_(plan), layout_(layout), placement_(placement), out_(out) {}

  std::uint32_t on_side(std::int32_t c, int d, std::int64_t t) const {
    return layout_.on_side(faces_, c, d, t);
  }
  /// Whether this face writes the points inside a side.
  bool owns(std::int32_t c) const { return layout_.reversed[c] == 0; }
  void write(std::int64_t at, const Vertex& vertex, const LatticePoint& lattice) {
    out_.vertices[at] = placed(vertex, placement_);
    if (!out_.provenance.empty()) out_.provenance[at] = lattice;
  }
  void put_triangle(std::int64_t at, std::int32_t face, Kind kind, std::uint32_t a, std::uint32_t b,
                    std::uint32_t c) {
    out_.triangles[at] = {a, b, c};
    out_.triangle_face[at] = face;
    out_.triangle_kind[at] = kind;
  }

  /// border[side][t]: the limit vertices along each side, from corner to corner.
  template <class Border>
  void put_fan(std::int32_t f, const Vertex& centre, const Border& border) {
    const FaceInRepair<Faces> face{faces_, plan_, f};
    const std::int64_t middle = layout_.interior[f];
    write(middle, centre, face.centre());
    write_border(face, border);
    std::int64_t at = layout_.first_triangle[f];
    for (int side = 0; side < face.sides(); ++side) {
      const std::int32_t c = faces_.first_side(f) + side;
      for (int t = 0, d = face.depth(side); t < 1 << d; ++t)
        put_triangle(at++, f, Kind::kFan, static_cast<std::uint32_t>(middle), on_side(c, d, t),
                     on_side(c, d, t + 1));
    }
  }
  /// Triangles from number `at` on; inner(side, t) is the index of point t of the row next to a side.
  template <class Border, class Inner>
  void put_ring(std::int32_t f, int k, std::int64_t at, const Border& border, Inner&& inner) {
    const FaceInRepair<Faces> face{faces_, plan_, f};
    write_border(face, border);
    for (int side = 0; side < face.sides(); ++side) {
      const auto point = [&](std::int64_t t, bool is_inner) {
        return is_inner ? inner(side, static_cast<int>(t))
                        : on_side(faces_.first_side(f) + side, face.depth(side), t);
      };
      face.stitch(k, side, [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
        put_triangle(at++, f, Kind::kStitched, point(a, ai), point(b, bi), point(c, ci));
      });
    }
  }

  const Faces& faces_;
  const CrackPlan& plan_;
  const IndexLayout& layout_;
  const Placement<Real>& placement_;
  IndexedMesh<Real>& out_;

 private:
  template <class Border>
  void write_border(const FaceInRepair<Faces>& face, const Border& border) {
    for (int side = 0; side < face.sides(); ++side) {
      const std::int32_t c = faces_.first_side(face.face) + side;
      if (!owns(c)) continue;
      for (int t = 1, d = face.depth(side); t < 1 << d; ++t)
        write(on_side(c, d, t), border[side][t], face.on_side(side, t));
    }
  }
};

/// Writes one half after the other; different halves write to different places.
template <class Real>
class LoopIndexWriter : IndexOutput<Real, LoopFaces> {
 public:
  using Output = IndexOutput<Real, LoopFaces>;
  using typename Output::Vertex;

  LoopIndexWriter(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan,
                  const IndexLayout& layout, const Placement<Real>& placement, IndexedMesh<Real>& out)
      : Output(faces, plan, layout, placement, out), patch_(patch), k_(1 << patch.depth) {}

  template <class At>
  void whole_strip(int row, const At& at) {
    half_strip(0, row, at);
    if constexpr (std::is_same_v<At, RowPair<Real>>)
      half_strip(1, k_ - 1 - row, at.turned(k_));
    else
      half_strip(1, k_ - 1 - row, [&](int q) -> const Vertex& { return at(2 * k_ + 1 - q); });
  }

  template <class At>
  void half_strip(int side, int row, const At& at) {
    const Half& half = patch_.half[side];
    const bool stitch = half.display == Display::kStitch;
    // Every row is written with the strip below it; row k is a corner.
    write_row(half, stitch, row, at);
    if (row == 0) write_triangles(half, stitch);
  }

  void fan(int side, const Vertex& centre, const Border<Real>& border) {
    this->put_fan(patch_.half[side].face, centre, border);
  }
  void ring(int side, const Border<Real>& border) {
    const Half& half = patch_.half[side];
    this->put_ring(half.face, k_, layout_.first_triangle[half.face] + std::int64_t{k_ - 3} * (k_ - 3), border,
                   [&](int e, int t) {
                     const auto [row, column] = half.beside(k_, e, t);
                     return index(half, row, column);
                   });
  }

 private:
  using Output::layout_, Output::out_, Output::placement_, Output::on_side, Output::owns, Output::write;

  /// Index of (row, column) of a half whose face has its own depth on all edges; of others, interior points
  /// only.
  std::uint32_t index(const Half& half, int row, int column) const {
    const std::int32_t h = 3 * half.face;
    if (row + column == k_) return on_side(h + half.edge, patch_.depth, column);
    if (row == 0) return on_side(h + (half.edge + 1) % 3, patch_.depth, k_ - column);
    if (column == 0) return on_side(h + (half.edge + 2) % 3, patch_.depth, row);
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

  const LoopPatch& patch_;
  int k_;
};

template <class Real>
class QuadIndexWriter : IndexOutput<Real, QuadFaces> {
 public:
  using Output = IndexOutput<Real, QuadFaces>;
  using typename Output::Vertex;

  QuadIndexWriter(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                  const IndexLayout& layout, const Placement<Real>& placement, IndexedMesh<Real>& out)
      : Output(faces, plan, layout, placement, out),
        patch_(patch),
        m_(faces.part_size(patch.depth)),
        triangle_(layout.first_triangle[patch.face]) {}

  /// Leaves out strips that somebody else writes.
  void skip(std::int64_t strips) { triangle_ += strips * 2 * m_; }

  template <class At>
  void strip(int part, int row, const At& at) {
    const int j = m_ - row;
    for (int i = 0; i <= m_; ++i) {
      write_own({part, i, j}, at(2 * i));
      if (j == 1) write_own({part, i, 0}, at(2 * i + 1));
    }
    cells(part, 0, m_, j, Kind::kPair);
  }

  template <class Limit>
  void corners(Limit&&) {  // control vertices are written once and for all
    const std::int32_t first = faces_.first_side(patch_.face);
    for (int k = 1; k + 1 < faces_.sides(patch_.face); ++k)
      triangle(Kind::kPair, on_side(first, 0, 0), on_side(first + k, 0, 0), on_side(first + k + 1, 0, 0));
  }

  void fan(const Vertex& centre, const QuadBorder<Real>& border) {
    this->put_fan(patch_.face, centre, border);
  }
  void stitch(const FacePoints<Real>& points, const QuadBorder<Real>& border) {
    const InnerCells inner(patch_, faces_);
    for (int part = 0; part < faces_.parts(patch_.face); ++part) {
      for (int j = inner.from; j <= inner.to; ++j)
        for (int i = inner.from; i <= inner.to; ++i) write_own({part, i, j}, points.at({part, i, j}));
      for (int j = inner.to; j > inner.from; --j) cells(part, inner.from, inner.to, j, Kind::kStitched);
    }
    this->put_ring(patch_.face, 1 << patch_.depth, triangle_, border,
                   [&](int side, int t) { return index(faces_.beside(patch_.face, patch_.depth, side, t)); });
  }

 private:
  using Output::faces_, Output::layout_, Output::on_side, Output::write;

  /// The side that a point of a part lies on and how far along, or side = -1.
  struct OnSide {
    int side, t;
  };
  OnSide side_of(PartPoint p) const {
    if (faces_.cut()) {
      if (p.j == 0) return {p.part, p.i};
      if (p.i == 0) return {p.part == 0 ? faces_.sides(patch_.face) - 1 : p.part - 1, 2 * m_ - p.j};
      return {-1, 0};
    }
    if (p.j == 0) return {0, p.i};
    if (p.i == m_) return {1, p.j};
    if (p.j == m_) return {2, m_ - p.i};
    if (p.i == 0) return {3, m_ - p.j};
    return {-1, 0};
  }
  std::uint32_t index(PartPoint p) const {
    if (const OnSide at = side_of(p); at.side >= 0)
      return on_side(faces_.first_side(patch_.face) + at.side, patch_.depth, at.t);
    const std::int64_t m = m_, interior = layout_.interior[patch_.face];
    if (!faces_.cut()) return static_cast<std::uint32_t>(interior + (p.j - 1) * (m - 1) + p.i - 1);
    if (p.i == m_ && p.j == m_) return static_cast<std::uint32_t>(interior);
    if (p.j == m_) p = {(p.part + faces_.parts(patch_.face) - 1) % faces_.parts(patch_.face), m_, p.i};
    return static_cast<std::uint32_t>(interior + 1 + (p.part * (m - 1) + p.j - 1) * m + p.i - 1);
  }

  /// A point of the lattice, unless another face or part writes it.
  void write_own(PartPoint p, const Vertex& v) {
    const OnSide at = side_of(p);
    if (at.side >= 0) {
      if (at.t == 0 || at.t == 1 << patch_.depth || !this->owns(faces_.first_side(patch_.face) + at.side))
        return;
      if (faces_.cut() && p.i == 0 && p.j == m_) return;  // the middle of the side is the other part's
    } else if (faces_.cut() && p.j == m_ && (p.i < m_ || p.part > 0)) {
      return;
    }
    write(index(p), v, faces_.lattice(patch_.face, patch_.depth, p));
  }

  /// The cells from..to between rows j and j - 1.
  void cells(int part, int from, int to, int j, Kind kind) {
    for (int i = from; i < to; ++i) {
      const std::uint32_t a = index({part, i, j}), b = index({part, i, j - 1}), c = index({part, i + 1, j});
      triangle(kind, a, b, c);
      triangle(kind, c, b, index({part, i + 1, j - 1}));
    }
  }
  void triangle(Kind kind, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    this->put_triangle(triangle_++, patch_.face, kind, a, b, c);
  }

  const QuadPatch& patch_;
  int m_;
  std::int64_t triangle_;
};

}  // namespace limitcheck::fast
