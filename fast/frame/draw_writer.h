// SPDX-License-Identifier: MIT
// Writes the strips and fans of one patch of either scheme to their place in a draw list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

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

/// What the writers of both schemes do alike.
template <class Real>
class DrawOutput {
 public:
  using Vertex = SurfaceVertex<Real>;

 protected:
  DrawOutput(int depth, const Placement<Real>& placement, const DrawPlace<Real>& place)
      : depth_(depth), placement_(placement), to_(place) {}

  void begin(DrawMode mode, Kind kind, std::int32_t face) {
    *to_.draws = {to_.first, 0, 0, face, face, mode, kind, static_cast<std::int8_t>(depth_)};
  }
  void end() { end(to_.draws->triangle_count(), to_.draws->face); }
  void end(std::int32_t split, std::int32_t face_after) {
    to_.draws->split = split;
    to_.draws->face_after = face_after;
    to_.first += to_.draws->count;
    ++to_.draws;
  }
  template <class Lattice>
  void put(const Vertex& vertex, Lattice&& lattice) {
    if (to_.provenance != nullptr) *to_.provenance++ = lattice();
    const Vertex here = placed(vertex, placement_);
    copy_vertices(&here, 1, to_.vertices++, to_.stores);
    ++to_.draws->count;
  }
  /// Points at(from) .. at(to) of a strip; lattice(q) is where point q lies.
  template <class At, class Lattice>
  void put_strip(const At& at, int from, int to, Lattice&& lattice) {
    if (from == 0 && copied(at, to + 1)) return;
    for (int q = from; q <= to; ++q) put(at(q), [&] { return lattice(q); });
  }
  /// border[side][t]: the limit vertices along each side, from corner to corner.
  template <class Faces, class Border>
  void put_fan(const FaceInRepair<Faces>& face, const Vertex& centre, const Border& border) {
    begin(DrawMode::kFan, Kind::kFan, face.face);
    put(centre, [&] { return face.centre(); });
    for (int side = 0; side < face.sides(); ++side) {
      const int count = face.points(side);
      if (as_it_is()) {
        copy_vertices(&border[side][0], static_cast<std::size_t>(count), to_.vertices, to_.stores);
        took(count);
        continue;
      }
      for (int t = 0; t < count; ++t) put(border[side][t], [&] { return face.on_side(side, t); });
    }
    put(border[0][0], [&] { return face.on_side(0, 0); });
    end();
  }
  /// put_inner(side, t) puts point t of the row next to a side.
  template <class Faces, class Border, class PutInner>
  void put_ring(const FaceInRepair<Faces>& face, const Border& border, PutInner&& put_inner) {
    begin(DrawMode::kTriangles, Kind::kStitched, face.face);
    for (int side = 0; side < face.sides(); ++side) {
      const auto one = [&](std::int64_t index, bool is_inner) {
        const int t = static_cast<int>(index);
        if (is_inner) return put_inner(side, t);
        put(border[side][t], [&] { return face.on_side(side, t); });
      };
      face.stitch(1 << depth_, side,
                  [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
                    one(a, ai);
                    one(b, bi);
                    one(c, ci);
                  });
    }
    end();
  }
  void skip_draws(std::int64_t draws, std::int64_t vertices) {
    to_.vertices += vertices;
    if (to_.provenance != nullptr) to_.provenance += vertices;
    to_.draws += draws;
    to_.first += vertices;
  }

 private:
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

  int depth_;
  const Placement<Real>& placement_;
  DrawPlace<Real> to_;
};

/// The border of a repaired triangle: limit vertices along its three edges, from corner e to corner e + 1.
template <class Real>
using Border = std::array<const SurfaceVertex<Real>*, 3>;
/// The same of a face of any number of sides.
template <class Real>
using QuadBorder = std::vector<std::vector<SurfaceVertex<Real>>>;

template <class Real>
class LoopDrawWriter : DrawOutput<Real> {
 public:
  using typename DrawOutput<Real>::Vertex;
  /// Room for the inner border of a stitched face: 3 rows of `stride` vertices for each half. One per thread.
  struct Scratch {
    std::vector<Vertex> inner;
    std::size_t stride = 0;
    void reserve(int max_depth) {
      stride = std::size_t{1} << max_depth;
      inner.resize(6 * stride);
    }
  };

  LoopDrawWriter(const LoopPatch& patch, const LoopFaces& faces, const CrackPlan& plan,
                 const Placement<Real>& placement, const DrawPlace<Real>& place, Scratch& scratch)
      : DrawOutput<Real>(patch.depth, placement, place),
        patch_(patch),
        faces_(faces),
        plan_(plan),
        scratch_(scratch),
        k_(1 << patch.depth) {}

  /// A strip of the window, both halves at once: at(q) is vertex q of 2 (k + 1).
  template <class At>
  void whole_strip(int row, const At& at) {
    const Half &first = patch_.half[0], &second = patch_.half[1];  // clang 14 captures no structured bindings
    this->begin(DrawMode::kStrip, patch_.kind, first.face);
    this->put_strip(at, 0, 2 * k_ + 1, [&](int q) {
      const int r = row + q % 2, c = q / 2;
      return r + c <= k_ ? first.lattice(k_, r, c) : second.lattice(k_, k_ - r, k_ - c);
    });
    this->end(2 * (k_ - row) - 1, second.face);
  }

  /// The part of a strip that one half displays. `row` counts in the half's own frame, at(q) is vertex q of
  /// the strip in that frame.
  template <class At>
  void half_strip(int side, int row, const At& at) {
    const Half& half = patch_.half[side];
    const bool stitch = half.display == Display::kStitch;
    if (stitch) {
      capture(side, row, at);
      if (row < 1 || row > k_ - 3) return;
    }
    this->begin(DrawMode::kStrip, stitch ? Kind::kStitched : patch_.kind, half.face);
    this->put_strip(at, stitch ? 2 : 0, 2 * (k_ - row) - (stitch ? 2 : 0),
                    [&](int q) { return half.lattice(k_, row + q % 2, q / 2); });
    this->end();
  }

  void fan(int side, const Vertex& centre, const Border<Real>& border) {
    this->put_fan(in_repair(side), centre, border);
  }
  void ring(int side, const Border<Real>& border) {
    this->put_ring(in_repair(side), border, [&](int e, int t) {
      this->put(inner(side, e)[t], [&] {
        return Half{patch_.half[side].face, e}.lattice(k_, k_ - t - 2, t + 1);
      });
    });
  }

 private:
  FaceInRepair<LoopFaces> in_repair(int side) const { return {faces_, plan_, patch_.half[side].face}; }
  Vertex* inner(int side, int e) {
    return scratch_.inner.data() + static_cast<std::size_t>(3 * side + e) * scratch_.stride;
  }

  /// Keeps the points of a row (and of the one below, for the last) that the outer ring will be stitched to.
  template <class At>
  void capture(int side, int row, const At& at) {
    const int edge = patch_.half[side].edge;
    for (int r = row; r <= row + 1; ++r) {
      if (r < 1 || r > k_ - 2) continue;
      const int last = k_ - 1 - r;
      const auto point = [&](int c) { return at(2 * c + (r - row)); };
      if (r == 1)
        for (int c = 1; c <= last; ++c) inner(side, (edge + 1) % 3)[k_ - 2 - c] = point(c);
      inner(side, (edge + 2) % 3)[r - 1] = point(1);
      inner(side, edge)[last - 1] = point(last);
    }
  }

  const LoopPatch& patch_;
  const LoopFaces& faces_;
  const CrackPlan& plan_;
  Scratch& scratch_;
  int k_;
};

template <class Real>
class QuadDrawWriter : DrawOutput<Real> {
 public:
  using typename DrawOutput<Real>::Vertex;
  struct Scratch {};  // it needs none

  QuadDrawWriter(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                 const Placement<Real>& placement, const DrawPlace<Real>& place, const Scratch& /*scratch*/)
      : DrawOutput<Real>(patch.depth, placement, place), patch_(patch), faces_(faces), plan_(plan) {}

  /// Leaves out strips that somebody else writes.
  void skip(std::int64_t strips) {
    this->skip_draws(strips, strips * 2 * (faces_.part_size(patch_.depth) + 1));
  }

  /// A strip of the window: at(q) is vertex q of 2 (m + 1) between rows j = m - row and below, m =
  /// part_size(depth).
  template <class At>
  void strip(int part, int row, const At& at) {
    const int m = faces_.part_size(patch_.depth);
    this->begin(DrawMode::kStrip, Kind::kPair, patch_.face);
    this->put_strip(at, 0, 2 * m + 1, [&](int q) { return lattice({part, q / 2, m - row - q % 2}); });
    this->end();
  }

  /// The corners by themselves; limit(k) is that of corner k.
  template <class Limit>
  void corners(Limit&& limit) {
    this->begin(DrawMode::kFan, Kind::kPair, patch_.face);
    for (int k = 0; k < faces_.sides(patch_.face); ++k)
      this->put(limit(k), [&] { return faces_.corner(patch_.face, k); });
    this->end();
  }

  void fan(const Vertex& centre, const QuadBorder<Real>& border) {
    this->put_fan(FaceInRepair<QuadFaces>{faces_, plan_, patch_.face}, centre, border);
  }
  void stitch(const FacePoints<Real>& points, const QuadBorder<Real>& border) {
    const auto put_inner = [&](PartPoint p) { this->put(points.at(p), [&] { return lattice(p); }); };
    const InnerCells inner(patch_, faces_);
    for (int part = 0; part < faces_.parts(patch_.face); ++part) {
      for (int j = inner.to; j > inner.from; --j) {
        this->begin(DrawMode::kStrip, Kind::kStitched, patch_.face);
        for (int i = inner.from; i <= inner.to; ++i)
          for (const int row : {j, j - 1}) put_inner({part, i, row});
        this->end();
      }
    }
    this->put_ring(FaceInRepair<QuadFaces>{faces_, plan_, patch_.face}, border,
                   [&](int side, int t) { put_inner(faces_.beside(patch_.face, patch_.depth, side, t)); });
  }

 private:
  LatticePoint lattice(PartPoint p) const { return faces_.lattice(patch_.face, patch_.depth, p); }

  const QuadPatch& patch_;
  const QuadFaces& faces_;
  const CrackPlan& plan_;
};

}  // namespace limitcheck::fast
