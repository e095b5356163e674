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
      const ShownFace shown = shown_face(faces, f, depth[f], plan.display[f]);
      const std::int64_t inside = shown.display == Display::kFan ? 1 : inner_points(faces, shown),
                         triangles = draw_size(shown, faces, plan).triangles;
      l.interior[f] = std::exchange(l.vertex_count, l.vertex_count + inside);
      l.first_triangle[f] = std::exchange(l.triangle_count, l.triangle_count + triangles);
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

/// Takes the strips, fans and stitched faces of a patch. Different patches, and different parts of one, write to
/// different places.
template <class Real, class Patch, class Faces>
class IndexWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  IndexWriter(const Patch& patch, const Faces& faces, const CrackPlan& plan, const IndexLayout& layout,
              const Placement<Real>& placement, IndexedMesh<Real>& out)
      : patch_(patch), faces_(faces), plan_(plan), layout_(layout), placement_(placement), out_(out) {}

  template <class At>
  void strip(int part, int row, const At& at) {
    if constexpr (std::is_same_v<Patch, LoopPatch>) {
      if (part == LoopPatch::kWhole) {
        const int k = patch_.k();
        strip_of(0, row, at);
        if constexpr (std::is_same_v<At, RowPair<Real>>)
          return strip_of(1, k - 1 - row, at.turned(k));
        else
          return strip_of(1, k - 1 - row, [&](int q) -> const Vertex& { return at(2 * k + 1 - q); });
      }
    }
    strip_of(part, row, at);
  }

  template <class Limit>
  void corners(Limit&&) {  // control vertices are written once and for all
    const std::int32_t f = patch_.shown(0).face, first = faces_.first_side(f);
    for (int k = 1; k + 1 < faces_.sides(f); ++k)
      put_triangle(layout_.first_triangle[f] + k - 1, f, patch_.kind,
                   {on_side(first, 0, 0), on_side(first + k, 0, 0), on_side(first + k + 1, 0, 0)});
  }

  /// border[side][t]: the limit vertices along each side of face s of the patch, from corner to corner.
  template <class Border>
  void fan(int s, const Vertex& centre, const Border& border) {
    const std::int32_t f = patch_.shown(s).face;
    const FaceInRepair<Faces> face{faces_, plan_, f};
    const std::int64_t middle = layout_.interior[f];
    write_at(middle, centre, [&] { return face.centre(); });
    write_border(face, border);
    std::int64_t at = layout_.first_triangle[f];
    for (int side = 0; side < face.sides(); ++side) {
      const std::int32_t c = faces_.first_side(f) + side;
      for (int t = 0, d = face.depth(side); t < 1 << d; ++t)
        put_triangle(at++, f, Kind::kFan,
                     {static_cast<std::uint32_t>(middle), on_side(c, d, t), on_side(c, d, t + 1)});
    }
  }

  /// Of a part of a stitched face: the points and triangles of a strip inside the outer ring; then, of the face, the ring.
  ///   row    counted from the first inner one on
  ///   grid   the points of the patch, see in_grid()
  void inner_strip(int part, int row, const Vertex* grid) {
    const ShownFace shown = patch_.shown(Patch::shown_of(part));
    const RowBlock inner = shown.inner();
    const PatchPoint first = shown.first_inner(part);
    for (int r = row; r <= (row + 1 == inner.k ? row + 1 : row); ++r)
      write_row(part, first.row + r, first.column, first.column + inner.last(r), [&](int q) -> const Vertex& {
        return grid[patch_.in_grid({part, first.row + r, q / 2})];
      });
    if (row == 0) write_triangles(part, inner, first.row, first.column, Kind::kStitched);
  }
  template <class Border>
  void ring(int s, const Vertex* /*grid*/, const Border& border) {
    const ShownFace shown = patch_.shown(s);
    const FaceInRepair<Faces> face{faces_, plan_, shown.face};
    write_border(face, border);
    std::int64_t at = layout_.first_triangle[shown.face] + shown.parts * shown.inner().strips().triangles;
    for (int side = 0; side < face.sides(); ++side) {
      const auto point = [&](StitchPoint p) {
        return p.inner ? index(patch_.beside(faces_, s, side, static_cast<int>(p.t)))
                       : on_side(faces_.first_side(shown.face) + side, face.depth(side), p.t);
      };
      face.stitch(shown.cells, side, [&](StitchPoint a, StitchPoint b, StitchPoint c) {
        put_triangle(at++, shown.face, Kind::kStitched, {point(a), point(b), point(c)});
      });
    }
  }

 private:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Every row is written with the strip below it, the last one of a square with that above it.
  template <class At>
  void strip_of(int part, int row, const At& at) {
    const RowBlock block = patch_.block(part);
    write_row(part, row, 0, block.last(row), at);
    if (row + 1 == block.k && !block.triangle)
      write_row(part, block.k, 0, block.k, [&](int q) -> const Vertex& { return at(q + 1); });
    if (row == 0) write_triangles(part, block, 0, 0, patch_.kind);
  }

  std::uint32_t on_side(std::int32_t c, int d, std::int64_t t) const {
    return layout_.on_side(faces_, c, d, t);
  }
  /// Whether this face writes the points inside a side.
  bool owns(std::int32_t c) const { return layout_.reversed[c] == 0; }

  /// The index of a point that lies there: of a face that has its own depth on all sides, or inside.
  // Inlined always: else small structs are packed for each call, which is most of what an index costs.
  [[gnu::always_inline]] std::uint32_t index(PatchPoint p, OnSide at) const {
    const std::int32_t f = patch_.face_of(p.part);
    if (at.side >= 0) return on_side(faces_.first_side(f) + at.side, patch_.depth, at.t);
    return static_cast<std::uint32_t>(layout_.interior[f] + patch_.inside(p));
  }
  [[gnu::always_inline]] std::uint32_t index(PatchPoint p) const { return index(p, patch_.side_of(p)); }
  /// Whether it is this part of this face that writes a point, no corner.
  bool writes(PatchPoint p, OnSide at) const {
    return !patch_.repeats(p) && (at.side < 0 || owns(faces_.first_side(patch_.face_of(p.part)) + at.side));
  }
  /// What is added to the index of a point, the second of a row, for the third, .., the last but one.
  std::uint32_t step(PatchPoint second, OnSide at, std::uint32_t first) const {
    const PatchPoint third{second.part, second.row, second.column + 1};
    if (at.side < 0) return static_cast<std::uint32_t>(patch_.inside(third) - patch_.inside(second));
    return index(third) - first;
  }

  template <class Lattice>
  [[gnu::always_inline]] void write_at(std::int64_t at, const Vertex& vertex, Lattice&& lattice) {
    out_.vertices[at] = placed(vertex, placement_);
    if (!out_.provenance.empty()) out_.provenance[at] = lattice();
  }
  [[gnu::always_inline]] void write(std::int64_t at, const Vertex& vertex, PatchPoint p) {
    write_at(at, vertex, [&] { return patch_.lattice(faces_, p); });
  }
  [[gnu::always_inline]] void write_end(PatchPoint p, const Vertex& vertex) {
    const OnSide at = patch_.side_of(p);
    const bool corner = at.side >= 0 && (at.t == 0 || at.t == 1 << patch_.depth);
    if (!corner && writes(p, at)) write(index(p, at), vertex, p);
  }
  /// Columns from .. to of a row, those that are to be written: at(2 c) is the point in column c. All but the first and
  /// the last are of one side, or inside.
  template <class At>
  void write_row(int part, int row, int from, int to, const At& at) {
    write_end({part, row, from}, at(2 * from));
    if (to > from) write_end({part, row, to}, at(2 * to));
    if (to - from < 2) return;
    const PatchPoint second{part, row, from + 1};
    const OnSide side = patch_.side_of(second);
    if (!writes(second, side)) return;
    const std::uint32_t begin = index(second, side);
    if (side.side < 0 && out_.provenance.empty() && placement_.is_identity()) {
      Vertex* first = out_.vertices.data() + begin;
      if constexpr (std::is_same_v<At, RowPair<Real>>) {
        if (at.step == 1) {
          std::copy_n(&at(2 * from + 2), to - from - 1, first);
          return;
        }
      }
      for (int c = from + 1; c < to; ++c) *first++ = at(2 * c);
      return;
    }
    const std::uint32_t by = to - from == 2 ? 1 : step(second, side, begin);
    for (int c = from + 1; c < to; ++c)
      write(begin + static_cast<std::uint32_t>(c - from - 1) * by, at(2 * c), PatchPoint{part, row, c});
  }

  /// The indices of columns from .. to of a row, but of those on a side that has another depth.
  void indices(int part, int row, int from, int to, std::uint32_t* out) const {
    out[0] = index({part, row, from}), out[to - from] = index({part, row, to});
    if (to - from < 2) return;
    const PatchPoint second{part, row, from + 1};
    const OnSide side = patch_.side_of(second);
    const std::uint32_t begin = index(second, side), by = to - from == 2 ? 1 : step(second, side, begin);
    for (int c = 1; c < to - from; ++c) out[c] = begin + static_cast<std::uint32_t>(c - 1) * by;
  }

  /// Those between the rows of a block that begins at a row and column of the part.
  void write_triangles(int part, const RowBlock& block, int first_row, int column, Kind kind) {
    const std::int32_t f = patch_.face_of(part);
    const std::int64_t count = block.strips().triangles,
                       first = layout_.first_triangle[f] +
                               (part - Patch::first_part(Patch::shown_of(part))) * count;
    std::fill_n(out_.triangle_face.data() + first, count, f);
    std::fill_n(out_.triangle_kind.data() + first, count, kind);
    std::array<std::uint32_t, (1 << kDeepest) + 1> row_a, row_b;  // NOLINT: filled as far as they are read
    std::uint32_t *upper = row_a.data(), *lower = row_b.data();
    indices(part, first_row, column, column + block.last(0), upper);
    Triangle* out = out_.triangles.data() + first;
    for (int row = 0; row < block.k; ++row) {
      const int last = block.last(row), below = block.last(row + 1);
      indices(part, first_row + row + 1, column, column + below, lower);
      for (int c = 0; c < below; ++c, out += 2) {
        out[0] = {upper[c], lower[c], upper[c + 1]};
        out[1] = {upper[c + 1], lower[c], lower[c + 1]};
      }
      if (below < last) *out++ = {upper[below], lower[below], upper[last]};
      std::swap(upper, lower);
    }
  }

  template <class Border>
  void write_border(const FaceInRepair<Faces>& face, const Border& border) {
    for (int side = 0; side < face.sides(); ++side) {
      const std::int32_t c = faces_.first_side(face.face) + side;
      if (!owns(c)) continue;
      for (int t = 1, d = face.depth(side); t < 1 << d; ++t)
        write_at(on_side(c, d, t), border[side][t], [&] { return face.on_side(side, t); });
    }
  }
  void put_triangle(std::int64_t at, std::int32_t face, Kind kind, const Triangle& triangle) {
    out_.triangles[at] = triangle;
    out_.triangle_face[at] = face;
    out_.triangle_kind[at] = kind;
  }

  const Patch& patch_;
  const Faces& faces_;
  const CrackPlan& plan_;
  const IndexLayout& layout_;
  const Placement<Real>& placement_;
  IndexedMesh<Real>& out_;
};

}  // namespace limitcheck::fast
