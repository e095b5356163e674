// SPDX-License-Identifier: MIT
// Writes control faces of Catmull-Clark's scheme into one indexed mesh in which every point of a control
// vertex or edge appears once, on either side of a cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/draw_writer.h"
#include "fast/frame/quad_patch.h"

namespace limitcheck::fast {

/// Where vertices and triangles go: first the vertices of control vertices, then those of control edges, then
/// those of faces; triangles by face. It depends on the depths alone.
///
/// The points inside a face that was cut into parts: its centre, then part by part those with i = 1 .. m and
/// j = 1 .. m - 1, row by row. Those with j = m are points i = m of the part before.
struct QuadIndexLayout {
  static constexpr std::int64_t kUnused = -1;

  std::vector<std::int64_t> vertex;          // per vertex of the mesh of quads, or kUnused
  std::vector<std::int64_t> side;            // per side: index of its points 1 .. 2^d - 1
  std::vector<std::uint8_t> reversed;        // per side: the points are those of its twin, counted back
  std::vector<std::int64_t> interior;        // per face: its interior points, or its centre
  std::vector<std::int64_t> first_triangle;  // per face
  std::int64_t vertex_count = 0, triangle_count = 0;

  static QuadIndexLayout of(const QuadFaces& faces, std::span<const std::int32_t> depth,
                            const CrackPlan& plan) {
    QuadIndexLayout l;
    l.vertex.assign(static_cast<std::size_t>(faces.mesh->adjacency.vertex_count()), kUnused);
    l.side.assign(faces.face.size(), kUnused);
    l.reversed.assign(faces.face.size(), 0);
    l.interior.assign(depth.size(), kUnused);
    l.first_triangle.assign(depth.size(), kUnused);
    const auto sides = static_cast<std::int32_t>(faces.face.size());
    for (std::int32_t c = 0; c < sides; ++c)
      if (depth[faces.face[c]] >= 0) l.vertex[faces.vertex(c)] = 0;
    for (std::int64_t& v : l.vertex)
      if (v != kUnused) v = l.vertex_count++;
    for (std::int32_t c = 0; c < sides; ++c) {
      if (depth[faces.face[c]] < 0) continue;
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
      const QuadPatch patch{f, depth[f], plan.display[f]};
      l.interior[f] = l.vertex_count;
      l.first_triangle[f] = l.triangle_count;
      l.triangle_count += quad_draw_size(patch, faces, plan).triangles;
      const std::int64_t m = faces.part_size(depth[f]);
      if (patch.display == Display::kFan)
        l.vertex_count += 1;
      else if (!faces.cut())
        l.vertex_count += (m - 1) * (m - 1);
      else if (m > 0)
        l.vertex_count += 1 + faces.parts(f) * m * (m - 1);
    }
    return l;
  }

  /// Index of point t = 0 .. 2^d of a side.
  std::uint32_t on_side(const QuadFaces& faces, std::int32_t c, int d, std::int64_t t) const {
    const std::int64_t count = std::int64_t{1} << d;
    if (t == 0) return static_cast<std::uint32_t>(vertex[faces.vertex(c)]);
    if (t == count) return static_cast<std::uint32_t>(vertex[faces.vertex(faces.next(c))]);
    return static_cast<std::uint32_t>(side[c] + (reversed[c] != 0 ? count - t : t) - 1);
  }
};

/// Writes one face; different faces write to different places.
template <class Real>
class QuadIndexWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  QuadIndexWriter(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                  const QuadIndexLayout& layout, const Placement<Real>& placement, IndexedMesh<Real>& out)
      : patch_(patch),
        faces_(faces),
        plan_(plan),
        layout_(layout),
        placement_(placement),
        out_(out),
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
    const auto corner = [&](int k) { return on_side(k, 0, 0); };
    for (int k = 1; k + 1 < faces_.sides(patch_.face); ++k)
      triangle(Kind::kPair, corner(0), corner(k), corner(k + 1));
  }

  void fan(const Vertex& centre, const QuadBorder<Real>& border) {
    const std::int64_t middle = layout_.interior[patch_.face];
    write(middle, centre, faces_.centre(patch_.face));
    write_border(border);
    for (int side = 0; side < faces_.sides(patch_.face); ++side)
      for (int t = 0; t < 1 << depth_of(side); ++t)
        triangle(Kind::kFan, static_cast<std::uint32_t>(middle), on_side(side, depth_of(side), t),
                 on_side(side, depth_of(side), t + 1));
  }

  void stitch(const FacePoints<Real>& points, const QuadBorder<Real>& border) {
    write_border(border);
    const InnerCells inner(patch_, faces_);
    for (int part = 0; part < faces_.parts(patch_.face); ++part) {
      for (int j = inner.from; j <= inner.to; ++j)
        for (int i = inner.from; i <= inner.to; ++i) write_own({part, i, j}, points.at({part, i, j}));
      for (int j = inner.to; j > inner.from; --j) cells(part, inner.from, inner.to, j, Kind::kStitched);
    }
    for (int side = 0; side < faces_.sides(patch_.face); ++side) {
      const auto point = [&](std::int64_t t, bool is_inner) {
        if (!is_inner) return on_side(side, depth_of(side), t);
        return index(faces_.beside(patch_.face, patch_.depth, side, static_cast<int>(t)));
      };
      stitch_side(1 << patch_.depth, depth_of(side),
                  [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
                    triangle(Kind::kStitched, point(a, ai), point(b, bi), point(c, ci));
                  });
    }
  }

 private:
  std::int32_t corner_number(int k) const {
    return static_cast<std::int32_t>(faces_.first[patch_.face]) + k % faces_.sides(patch_.face);
  }
  int depth_of(int side) const { return plan_.edge_depth[corner_number(side)]; }
  std::uint32_t on_side(int side, int d, std::int64_t t) const {
    return layout_.on_side(faces_, corner_number(side), d, t);
  }
  bool owns_side(int side) const { return layout_.reversed[corner_number(side)] == 0; }

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
    if (const OnSide at = side_of(p); at.side >= 0) return on_side(at.side, patch_.depth, at.t);
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
      if (at.t == 0 || at.t == 1 << patch_.depth || !owns_side(at.side)) return;
      if (faces_.cut() && p.i == 0 && p.j == m_) return;  // the middle of the side is the other part's
    } else if (faces_.cut() && p.j == m_ && (p.i < m_ || p.part > 0)) {
      return;
    }
    write(index(p), v, faces_.lattice(patch_.face, patch_.depth, p));
  }
  void write_border(const QuadBorder<Real>& border) {
    for (int side = 0; side < faces_.sides(patch_.face); ++side) {
      if (!owns_side(side)) continue;
      const int d = depth_of(side);
      for (int t = 1; t < 1 << d; ++t)
        write(on_side(side, d, t), border[side][t], faces_.on_side(patch_.face, side, t, 1 << d));
    }
  }
  void write(std::int64_t at, const Vertex& vertex, const LatticePoint& lattice) {
    out_.vertices[at] = placed(vertex, placement_);
    if (!out_.provenance.empty()) out_.provenance[at] = lattice;
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
    out_.triangles[triangle_] = {a, b, c};
    out_.triangle_face[triangle_] = patch_.face;
    out_.triangle_kind[triangle_] = kind;
    ++triangle_;
  }

  const QuadPatch& patch_;
  const QuadFaces& faces_;
  const CrackPlan& plan_;
  const QuadIndexLayout& layout_;
  const Placement<Real>& placement_;
  IndexedMesh<Real>& out_;
  int m_;
  std::int64_t triangle_;
};

}  // namespace limitcheck::fast
