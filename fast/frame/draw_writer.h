// SPDX-License-Identifier: MIT
// Writes the strips and fans of one patch of either scheme to their place in a draw list.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

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

}  // namespace limitcheck::fast
