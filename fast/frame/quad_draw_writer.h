// SPDX-License-Identifier: MIT
// Writes the strips and fans of one control face of Catmull-Clark's scheme to their place in a draw list.
#pragma once

#include <cstdint>
#include <type_traits>

#include "fast/frame/draw_writer.h"
#include "fast/frame/quad_patch.h"

namespace limitcheck::fast {

template <class Real>
class QuadDrawWriter {
 public:
  using Vertex = SurfaceVertex<Real>;

  /// `first` is the place of the first vertex in the whole list.
  QuadDrawWriter(const QuadPatch& patch, const QuadFaces& faces, const CrackPlan& plan,
                 const Placement<Real>& placement, Vertex* vertices, LatticePoint* provenance, Draw* draws,
                 std::int64_t first, Stores stores)
      : patch_(patch),
        faces_(faces),
        plan_(plan),
        placement_(placement),
        vertex_(vertices),
        provenance_(provenance),
        draw_(draws),
        first_(first),
        stores_(stores) {}

  /// Leaves out strips that somebody else writes.
  void skip(std::int64_t strips) {
    const std::int64_t vertices = strips * 2 * (faces_.part_size(patch_.depth) + 1);
    vertex_ += vertices;
    if (provenance_ != nullptr) provenance_ += vertices;
    draw_ += strips;
    first_ += vertices;
  }

  /// A strip of the window: at(q) is vertex q of 2 (m + 1) between rows j = m - row and below, m =
  /// part_size(depth).
  template <class At>
  void strip(int part, int row, const At& at) {
    const int m = faces_.part_size(patch_.depth);
    begin(DrawMode::kStrip, Kind::kPair);
    if constexpr (std::is_same_v<At, RowPair<Real>>) {
      if (provenance_ == nullptr && placement_.is_identity() && at.step == -1) {
        interleave_backwards(at.above, at.below, static_cast<std::size_t>(m) + 1, vertex_, stores_);
        vertex_ += 2 * (m + 1);
        draw_->count += 2 * (m + 1);
        return end();
      }
    }
    for (int q = 0; q < 2 * (m + 1); ++q) put(at(q), PartPoint{part, q / 2, m - row - q % 2});
    end();
  }

  /// The corners by themselves; limit(k) is that of corner k.
  template <class Limit>
  void corners(Limit&& limit) {
    begin(DrawMode::kFan, Kind::kPair);
    for (int k = 0; k < faces_.sides(patch_.face); ++k) put(limit(k), faces_.corner(patch_.face, k));
    end();
  }

  void fan(const Vertex& centre, const QuadBorder<Real>& border) {
    begin(DrawMode::kFan, Kind::kFan);
    put(centre, faces_.centre(patch_.face));
    for (int side = 0; side < faces_.sides(patch_.face); ++side)
      for (int t = 0; t < side_points(side); ++t) put_border(border, side, t);
    put_border(border, 0, 0);
    end();
  }

  void stitch(const FacePoints<Real>& points, const QuadBorder<Real>& border) {
    const InnerCells inner(patch_, faces_);
    for (int part = 0; part < faces_.parts(patch_.face); ++part) {
      for (int j = inner.to; j > inner.from; --j) {
        begin(DrawMode::kStrip, Kind::kStitched);
        for (int i = inner.from; i <= inner.to; ++i)
          for (const int row : {j, j - 1}) put(points.at({part, i, row}), PartPoint{part, i, row});
        end();
      }
    }
    begin(DrawMode::kTriangles, Kind::kStitched);
    for (int side = 0; side < faces_.sides(patch_.face); ++side) {
      const auto one = [&](std::int64_t index, bool is_inner) {
        const int t = static_cast<int>(index);
        if (!is_inner) return put_border(border, side, t);
        const PartPoint p = faces_.beside(patch_.face, patch_.depth, side, t);
        put(points.at(p), p);
      };
      stitch_side(1 << patch_.depth, depth_of(side),
                  [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
                    one(a, ai);
                    one(b, bi);
                    one(c, ci);
                  });
    }
    end();
  }

 private:
  int depth_of(int side) const {
    return plan_.edge_depth[faces_.first[patch_.face] + static_cast<std::size_t>(side)];
  }
  int side_points(int side) const { return 1 << depth_of(side); }

  void begin(DrawMode mode, Kind kind) {
    *draw_ = {first_, 0, 0, patch_.face, patch_.face, mode, kind, static_cast<std::int8_t>(patch_.depth)};
  }
  void put(const Vertex& v, PartPoint p) { put(v, faces_.lattice(patch_.face, patch_.depth, p)); }
  void put(const Vertex& v, const LatticePoint& lattice) {
    const Vertex here = placed(v, placement_);
    copy_vertices(&here, 1, vertex_++, stores_);
    if (provenance_ != nullptr) *provenance_++ = lattice;
    ++draw_->count;
  }
  void put_border(const QuadBorder<Real>& border, int side, int t) {
    put(border[side][t], faces_.on_side(patch_.face, side, t, side_points(side)));
  }
  void end() {
    draw_->split = draw_->triangle_count();
    first_ += draw_->count;
    ++draw_;
  }

  const QuadPatch& patch_;
  const QuadFaces& faces_;
  const CrackPlan& plan_;
  const Placement<Real>& placement_;
  Vertex* vertex_;
  LatticePoint* provenance_;
  Draw* draw_;
  std::int64_t first_;
  Stores stores_;
};

}  // namespace limitcheck::fast
