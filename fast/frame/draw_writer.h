// SPDX-License-Identifier: MIT
// Writes one patch of either scheme: its strips and fans to their place in a draw list, or its points to its block of
// vertices; what a patch wants of such a block, and the calls that draw it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fast/frame/patch_store.h"
#include "fast/frame/quad_patch.h"
#include "fast/frame/sink.h"
#include "fast/frame/stores.h"
#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// From the coordinates of an engine to the caller's.
template <class Real>
SurfaceVertex<Real> placed(const SurfaceVertex<Real>& v, const Placement<Real>& placement) {
  return {placement(v.position), v.normal};
}

/// The place of a patch in arrays that are large enough; `first` is that of its first vertex in the whole list.
template <class Real>
struct DrawPlace {
  SurfaceVertex<Real>* vertices;
  LatticePoint* provenance;  // or null
  Draw* draws;
  std::int64_t first;
  Stores stores;
};

/// The border of a repaired triangle: limit vertices along its three edges, from corner e to corner e + 1.
template <class Real>
using Border = std::array<const SurfaceVertex<Real>*, 3>;

/// Takes the strips, fans and stitched faces of a patch one after the other.
template <class Real, class Patch, class Faces>
class DrawWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  DrawWriter(const Patch& patch, const Faces& faces, const CrackPlan& plan, const Placement<Real>& placement,
             const DrawPlace<Real>& place)
      : patch_(patch), faces_(faces), plan_(plan), placement_(placement), to_(place) {}

  /// Leaves out the strips of the parts before this one, which somebody else writes.
  void go_to(int part) {
    const DrawSize before = part * patch_.block(0).strips();
    to_.vertices += before.vertices;
    if (to_.provenance != nullptr) to_.provenance += before.vertices;
    to_.draws += before.draws;
    to_.first += before.vertices;
  }

  /// The strip below a row: at(q) is its vertex q, one of the row if q is even.
  template <class At>
  void strip(int part, int row, const At& at) {
    const int count = patch_.block(part).strip_points(row);
    begin(DrawMode::kStrip, patch_.kind, patch_.face_of(part));
    if (!copied(at, count))
      for (int q = 0; q < count; ++q) put(at(q), {part, row + q % 2, q / 2});
    if constexpr (std::is_same_v<Patch, LoopPatch>)
      if (part == LoopPatch::kWhole) return end(2 * (patch_.k() - row) - 1, patch_.half[1].face);
    end();
  }

  /// The corners by themselves; limit(k) is that of corner k.
  template <class Limit>
  void corners(Limit&& limit) {
    const std::int32_t f = patch_.shown(0).face;
    begin(DrawMode::kFan, patch_.kind, f);
    for (int k = 0; k < faces_.sides(f); ++k) put_at(limit(k), [&] { return faces_.corner(f, k); });
    end();
  }

  /// border[side][t]: the limit vertices along each side of face s of the patch, from corner to corner.
  template <class Border>
  void fan(int s, const Vertex& centre, const Border& border) {
    const FaceInRepair<Faces> face{faces_, plan_, patch_.shown(s).face};
    begin(DrawMode::kFan, Kind::kFan, face.face);
    put_at(centre, [&] { return face.centre(); });
    for (int side = 0; side < face.sides(); ++side) {
      const int count = face.points(side);
      if (as_it_is()) {
        copy_vertices(&border[side][0], static_cast<std::size_t>(count), to_.vertices, to_.stores);
        took(count);
        continue;
      }
      for (int t = 0; t < count; ++t) put_at(border[side][t], [&] { return face.on_side(side, t); });
    }
    put_at(border[0][0], [&] { return face.on_side(0, 0); });
    end();
  }

  /// Of a part of a stitched face: a strip inside the outer ring; then, of the face, the ring.
  ///   row    counted from the first inner one on
  ///   grid   the points of the patch, see in_grid()
  void inner_strip(int part, int row, const Vertex* grid) {
    const ShownFace shown = patch_.shown(Patch::shown_of(part));
    const PatchPoint first = shown.first_inner(part);
    begin(DrawMode::kStrip, Kind::kStitched, shown.face);
    for (int q = 0, count = shown.inner().strip_points(row); q < count; ++q)
      put_inner({part, first.row + row + q % 2, first.column + q / 2}, grid);
    end();
  }
  template <class Border>
  void ring(int s, const Vertex* grid, const Border& border) {
    const ShownFace shown = patch_.shown(s);
    const FaceInRepair<Faces> face{faces_, plan_, shown.face};
    begin(DrawMode::kTriangles, Kind::kStitched, face.face);
    for (int side = 0; side < face.sides(); ++side) {
      const auto one = [&](StitchPoint p) {
        const int t = static_cast<int>(p.t);
        if (p.inner) return put_inner(patch_.beside(faces_, s, side, t), grid);
        put_at(border[side][t], [&] { return face.on_side(side, t); });
      };
      face.stitch(shown.cells, side,
                  [&](StitchPoint a, StitchPoint b, StitchPoint c) { one(a), one(b), one(c); });
    }
    end();
  }

 private:
  void begin(DrawMode mode, Kind kind, std::int32_t face) {
    *to_.draws = {to_.first, 0, 0, face, face, mode, kind, static_cast<std::int8_t>(patch_.depth)};
  }
  void end() { end(to_.draws->triangle_count(), to_.draws->face); }
  void end(std::int32_t split, std::int32_t face_after) {
    to_.draws->split = split;
    to_.draws->face_after = face_after;
    to_.first += to_.draws->count;
    ++to_.draws;
  }
  void put(const Vertex& vertex, PatchPoint p) {
    put_at(vertex, [&] { return patch_.lattice(faces_, p); });
  }
  void put_inner(PatchPoint p, const Vertex* grid) { put(grid[patch_.in_grid(p)], p); }
  template <class Lattice>
  void put_at(const Vertex& vertex, Lattice&& lattice) {
    if (to_.provenance != nullptr) *to_.provenance++ = lattice();
    const Vertex here = placed(vertex, placement_);
    copy_vertices(&here, 1, to_.vertices++, to_.stores);
    ++to_.draws->count;
  }
  /// Vertices are copied without a look at each.
  bool as_it_is() const { return to_.provenance == nullptr && placement_.is_identity(); }
  /// Points 0 .. count - 1 of a strip, if they are and lie as the copying wants them.
  template <class At>
  bool copied(const At& at, int count) {
    if constexpr (std::is_same_v<At, RowPair<Real>>) {
      if (!as_it_is() || at.step != -1) return false;
      const auto couples = static_cast<std::size_t>(count / 2);
      interleave_backwards(at.above, at.below, couples, to_.vertices, to_.stores);
      if (count % 2 != 0) copy_vertices(&at(count - 1), 1, to_.vertices + count - 1, to_.stores);
      took(count);
      return true;
    }
    return false;
  }
  void took(int count) { to_.vertices += count, to_.draws->count += count; }

  const Patch& patch_;
  const Faces& faces_;
  const CrackPlan& plan_;
  const Placement<Real>& placement_;
  DrawPlace<Real> to_;
};

/// The block of a face, one after the other in that of its patch: its parts (strips; the corners alone where it has
/// none), its parts and the border (stitched), or the centre and the border (fan).
template <class Faces>
inline std::int32_t block_size(const ShownFace& shown, const Faces& faces, const CrackPlan& plan) {
  const auto border = [&] { return FaceInRepair<Faces>{faces, plan, shown.face}.border(); };
  switch (shown.display) {
    case Display::kStrips:
      return shown.parts == 0 ? faces.sides(shown.face) : shown.parts * shown.block().size();
    case Display::kStitch:
      return shown.parts * shown.block().size() + border();
    case Display::kFan:
      return 1 + border();
    default:
      return 0;
  }
}

template <class Patch, class Faces>
inline PatchWanted wanted_patch(const Grid& grid, const Patch& patch, const Faces& faces,
                                const CrackPlan& plan) {
  PatchWanted wanted{{grid, {}, {}}, 0, true};
  std::size_t edges = 0;
  for (int s = 0, end = patch.faces(); s < end; ++s) {
    const ShownFace shown = patch.shown(s);
    wanted.key.display[static_cast<std::size_t>(s)] = shown.display;
    wanted.size += block_size(shown, faces, plan);
    if (!shown.repaired()) continue;
    for (int side = 0; side < faces.sides(shown.face); ++side, ++edges)
      if (edges < PatchKey::kEdges)
        wanted.key.edge_depth[edges] = plan.edge_depth[faces.first_side(shown.face) + side];
  }
  wanted.comparable = edges <= PatchKey::kEdges;
  return wanted;
}

/// Adds the calls that draw a patch whose block begins at vertex `base`.
template <class Patch, class Faces>
[[gnu::always_inline]] inline void add_patch_draws(const Patch& patch, const Faces& faces,
                                                   const CrackPlan& plan, std::int64_t base, IndexForm form,
                                                   PatchIndices& patterns,
                                                   std::vector<std::uint32_t>& indices,
                                                   std::vector<PatchDraw>& out) {
  for (int s = 0, end = patch.faces(); s < end; ++s) {
    const ShownFace shown = patch.shown(s);
    const std::int32_t size = block_size(shown, faces, plan);
    IndexPattern pattern;
    IndexForm of = IndexForm::kTriangles;
    Kind kind = patch.kind;
    switch (shown.display) {
      case Display::kNothing:
        continue;
      case Display::kStrips:
        of = shown.parts > 0 ? form : IndexForm::kTriangles;
        pattern = shown.parts > 0 ? patterns.strips(shown, patch.depth, form, indices)
                                  : patterns.corners(size, indices);
        break;
      case Display::kFan:
        kind = Kind::kFan;
        pattern = patterns.fan(size - 1, indices);
        break;
      case Display::kStitch:
        kind = Kind::kStitched;
        pattern = patterns.stitched(patch, s, faces, plan, indices);
    }
    const bool pair = shown.both_halves;
    out.push_back({base, pattern.first, pattern.count, size, pattern.triangles,
                   pair ? pattern.triangles / 2 : pattern.triangles, shown.face,
                   pair ? patch.last_face() : shown.face, of, kind, static_cast<std::int8_t>(patch.depth)});
    base += size;
  }
}

/// As DrawWriter: takes the strips, fans and stitched faces of a patch, each to its place in the patch's block.
template <class Real, class Patch, class Faces>
class PatchWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  PatchWriter(const Patch& patch, const Faces& faces, const CrackPlan& plan, const Placement<Real>& placement,
              const PatchTarget<Real>& out)
      : patch_(patch), faces_(faces), plan_(plan), placement_(placement), out_(out) {}

  /// Where the points of a part lie, row by row, those of a row from the last column on.
  Vertex* grid(int part) const { return out_.vertices + first(part); }

  template <class At>
  void strip(int part, int row, const At& at) {
    const RowBlock block = patch_.block(part);
    const std::uint32_t begin = first(part);
    for (int below = 0; below <= (row + 1 == block.k ? 1 : 0); ++below) {
      const int last = block.last(row + below);
      const std::uint32_t to = begin + block.at(row + below, last);
      if (!copied(at, 2 * last + below, to, last + 1))
        for (int c = last; c >= 0; --c)
          put(to + static_cast<std::uint32_t>(last - c), at(2 * c + below), {part, row + below, c});
    }
  }

  template <class Limit>
  void corners(Limit&& limit) {
    const std::int32_t f = patch_.shown(0).face;
    for (int k = 0; k < faces_.sides(f); ++k)
      put_at(static_cast<std::uint32_t>(k), limit(k), [&] { return faces_.corner(f, k); });
  }

  template <class Border>
  void fan(int s, const Vertex& centre, const Border& border) {
    put_at(first_of(s), centre, [&] { return faces_.centre(patch_.shown(s).face); });
    put_border(s, border, first_of(s) + 1);
  }
  void inner_strip(int /*part*/, int /*row*/, const Vertex* /*grid*/) {}  // comes with the ring
  template <class Border>
  void ring(int s, const Vertex* grid, const Border& border) {
    const ShownFace shown = patch_.shown(s);
    std::uint32_t to = first_of(s);
    for (int part = Patch::first_part(s), k = 0; k < shown.parts; ++part, ++k)
      for (int row = 0; row <= shown.block().k; ++row)
        for (int c = shown.block().last(row); c >= 0; --c)
          put(to++, grid[patch_.in_grid({part, row, c})], {part, row, c});
    put_border(s, border, to);
  }

 private:
  /// Where the block of a face of the patch begins, and that of a part.
  std::uint32_t first_of(int s) const {
    return s == 0 ? 0 : static_cast<std::uint32_t>(block_size(patch_.shown(0), faces_, plan_));
  }
  std::uint32_t first(int part) const {
    const std::uint32_t begin = first_of(Patch::shown_of(part));
    if constexpr (std::is_same_v<Patch, LoopPatch>)
      return begin;
    else
      return begin + static_cast<std::uint32_t>(part * patch_.block(part).size());
  }
  template <class Lattice>
  void put_at(std::uint32_t at, const Vertex& vertex, Lattice&& lattice) {
    if (out_.provenance != nullptr) out_.provenance[at] = lattice();
    out_.put(at, placement_.is_identity() ? vertex : placed(vertex, placement_));
  }
  void put(std::uint32_t at, const Vertex& vertex, PatchPoint p) {
    put_at(at, vertex, [&] { return patch_.lattice(faces_, p); });
  }
  /// A row of a strip whose last point is number q, from there on to its first, if it lies as the copying wants it.
  template <class At>
  bool copied(const At& at, int q, std::uint32_t to, int count) {
    if constexpr (std::is_same_v<At, RowPair<Real>>) {
      if (out_.provenance != nullptr || !placement_.is_identity() || at.step != -1) return false;
      out_.put(to, &at(q), static_cast<std::size_t>(count));
      return true;
    }
    return false;
  }
  template <class Border>
  void put_border(int s, const Border& border, std::uint32_t to) {
    const FaceInRepair<Faces> face{faces_, plan_, patch_.shown(s).face};
    for (int side = 0; side < face.sides(); ++side)
      for (int t = 0, count = face.points(side); t < count; ++t)
        put_at(to++, border[side][t], [&] { return face.on_side(side, t); });
  }

  const Patch& patch_;
  const Faces& faces_;
  const CrackPlan& plan_;
  const Placement<Real>& placement_;
  const PatchTarget<Real> out_;
};

}  // namespace limitcheck::fast
