// SPDX-License-Identifier: MIT
// Writes the strips and fans of one patch to their place in a draw list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "fast/frame/crack_stitch.h"
#include "fast/frame/frame_engine.h"
#include "fast/frame/patch.h"
#include "fast/frame/sink.h"
#include "fast/frame/stores.h"
#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// From the coordinates of an engine to the caller's.
template <class Real>
SurfaceVertex<Real> placed(const SurfaceVertex<Real>& v, const Placement<Real>& placement) {
  return {placement(v.position), v.normal};
}

/// The depth of edge k of a face.
inline int edge_depth(const CrackPlan& plan, std::int32_t face, int k) {
  return plan.edge_depth[3 * face + k];
}

/// Point t of 0 .. count on edge e of a face.
inline LatticePoint lattice_on_edge(std::int32_t face, int e, int t, int count) {
  return Half{face, e}.lattice(count, count - t, t);
}

/// The number of limit points evaluated for a patch: rows, each once, the borders of repaired faces, centres.
inline std::int64_t limit_points_of(const Patch& patch, const CrackPlan& plan) {
  const std::int64_t k = std::int64_t{1} << patch.depth;
  std::int64_t points = 0;
  if (patch.half[1].face < 0)
    points = patch.half[0].uses_window() ? k * (k + 2) : 0;  // both rows of every strip
  else if (patch.half[0].uses_window() || patch.half[1].uses_window())
    points = (k + 1) * (k + 1);
  for (const Half& half : patch.half) {
    if (!half.repaired()) continue;
    for (int e = 0; e < 3; ++e) points += std::int64_t{1} << edge_depth(plan, half.face, e);
    points += half.display == Display::kFan ? 1 : 0;
  }
  return points;
}

/// The room that a patch takes in a draw list.
inline DrawSize draw_size(const Patch& patch, const CrackPlan& plan) {
  const std::int64_t k = std::int64_t{1} << patch.depth;
  if (patch.full()) return {2 * k * (k + 1), k, 2 * k * k};
  DrawSize size;
  for (const Half& half : patch.half) {
    std::int64_t border = 0, ring = 0;
    if (half.repaired()) {
      for (int e = 0; e < 3; ++e) {
        border += std::int64_t{1} << edge_depth(plan, half.face, e);
        ring += stitch_triangles(k, edge_depth(plan, half.face, e));
      }
    }
    switch (half.display) {
      case Display::kStrips:
        size.vertices += k * k + 2 * k;
        size.draws += k;
        size.triangles += k * k;
        break;
      case Display::kFan:
        size.vertices += border + 2;
        size.draws += 1;
        size.triangles += border;
        break;
      case Display::kStitch:
        size.vertices += (k - 1) * (k - 3) + 3 * ring;
        size.draws += k - 3 + 1;
        size.triangles += (k - 3) * (k - 3) + ring;
        break;
      case Display::kNothing:
        break;
    }
  }
  return size;
}

/// The border of a repaired face: limit vertices along its three edges, from corner e to corner e + 1.
template <class Real>
using Border = std::array<const SurfaceVertex<Real>*, 3>;

/// Writes the strips and fans of one patch into arrays that are large enough.
template <class Real>
class DrawWriter {
 public:
  using Vertex = SurfaceVertex<Real>;
  /// Room for the inner border of a stitched face: 3 rows of `stride` vertices for each half.
  struct Scratch {
    std::vector<Vertex> inner;
    std::size_t stride = 0;
    void reserve(int max_depth) {
      stride = std::size_t{1} << max_depth;
      inner.resize(6 * stride);
    }
  };

  DrawWriter(const Patch& patch, const CrackPlan& plan, const Placement<Real>& placement, Vertex* vertices,
             LatticePoint* provenance, Draw* draws, std::int64_t first, Scratch& scratch, Stores stores)
      : patch_(patch),
        plan_(plan),
        placement_(placement),
        vertex_(vertices),
        provenance_(provenance),
        draw_(draws),
        first_(first),
        scratch_(scratch),
        stores_(stores),
        k_(1 << patch.depth) {}

  /// A strip of the window, both halves at once: at(q) is vertex q of 2 (k + 1).
  template <class At>
  void whole_strip(int row, At&& at) {
    begin(DrawMode::kStrip, patch_.kind, patch_.half[0].face, patch_.half[1].face, 2 * (k_ - row) - 1);
    if (!copied(at, 2 * (k_ + 1))) {
      for (int q = 0; q < 2 * (k_ + 1); ++q) {
        const int r = row + q % 2, c = q / 2;
        put(at(q), [&] {
          return r + c <= k_ ? patch_.half[0].lattice(k_, r, c) : patch_.half[1].lattice(k_, k_ - r, k_ - c);
        });
      }
    }
    end(2 * (k_ + 1));
  }

  /// The part of a strip that one half displays. `row` counts in the half's own frame, at(q) is vertex q of
  /// the strip in that frame.
  template <class At>
  void half_strip(int side, int row, At&& at) {
    const Half& half = patch_.half[side];
    int from = 0, to = 2 * (k_ - row);
    Kind kind = patch_.kind;
    if (half.display == Display::kStitch) {
      capture(side, row, at);
      if (row < 1 || row > k_ - 3) return;
      from = 2;
      to = 2 * (k_ - 1 - row);
      kind = Kind::kStitched;
    }
    begin(DrawMode::kStrip, kind, half.face, half.face, to - from - 1);
    if (from > 0 || !copied(at, to + 1))
      for (int q = from; q <= to; ++q) put(at(q), [&] { return half.lattice(k_, row + q % 2, q / 2); });
    end(to - from + 1);
  }

  void fan(int side, const Vertex& centre, const Border<Real>& border) {
    const Half& half = patch_.half[side];
    std::int32_t triangles = 0;
    for (int e = 0; e < 3; ++e) triangles += 1 << edge_depth(plan_, half.face, e);
    begin(DrawMode::kFan, Kind::kFan, half.face, half.face, triangles);
    put(centre, [&] { return LatticePoint{half.face, 1, 1, 3}; });
    for (int e = 0; e < 3; ++e) {
      const int count = 1 << edge_depth(plan_, half.face, e);
      if (as_it_is()) {
        copy_vertices(border[e], static_cast<std::size_t>(count), vertex_, stores_);
        vertex_ += count;
        continue;
      }
      for (int t = 0; t < count; ++t)
        put(border[e][t], [&] { return lattice_on_edge(half.face, e, t, count); });
    }
    put(border[0][0], [&] { return lattice_on_edge(half.face, 0, 0, 1 << edge_depth(plan_, half.face, 0)); });
    end(triangles + 2);
  }

  void ring(int side, const Border<Real>& border) {
    const Half& half = patch_.half[side];
    begin(DrawMode::kTriangles, Kind::kStitched, half.face, half.face, 0);
    std::int32_t triangles = 0;
    for (int e = 0; e < 3; ++e) {
      const int depth = edge_depth(plan_, half.face, e);
      const auto one = [&](std::int64_t index, bool is_inner) {
        const int t = static_cast<int>(index);
        if (!is_inner) return put(border[e][t], [&] { return lattice_on_edge(half.face, e, t, 1 << depth); });
        put(inner(side, e)[t], [&] { return Half{half.face, e}.lattice(k_, k_ - t - 2, t + 1); });
      };
      stitch_edge(k_, depth, [&](std::int64_t a, bool ai, std::int64_t b, bool bi, std::int64_t c, bool ci) {
        one(a, ai);
        one(b, bi);
        one(c, ci);
        ++triangles;
      });
    }
    draw_->split = triangles;
    end(3 * triangles);
  }

 private:
  Vertex* inner(int side, int e) {
    return scratch_.inner.data() + static_cast<std::size_t>(3 * side + e) * scratch_.stride;
  }

  /// Keeps the points of a row (and of the one below, for the last) that the outer ring will be stitched to.
  template <class At>
  void capture(int side, int row, At&& at) {
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

  void begin(DrawMode mode, Kind kind, std::int32_t face, std::int32_t face_after, std::int32_t split) {
    *draw_ = {first_, 0, split, face, face_after, mode, kind, static_cast<std::int8_t>(patch_.depth)};
  }
  template <class Lattice>
  void put(const Vertex& vertex, Lattice&& lattice) {
    if (provenance_ != nullptr) *provenance_++ = lattice();
    const Vertex here = placed(vertex, placement_);
    copy_vertices(&here, 1, vertex_++, stores_);
  }

  /// Vertices are copied without a look at each.
  bool as_it_is() const { return provenance_ == nullptr && placement_.is_identity(); }
  /// Points 0 .. count - 1 of a strip, if they are and lie as the copying wants them.
  template <class At>
  bool copied(const At& at, int count) {
    if constexpr (std::is_same_v<At, RowPair<Real>>) {
      if (!as_it_is() || at.step != -1) return false;
      const auto couples = static_cast<std::size_t>(count / 2);
      interleave_backwards(at.above, at.below, couples, vertex_, stores_);
      if (count % 2 != 0) copy_vertices(&at(count - 1), 1, vertex_ + count - 1, stores_);
      vertex_ += count;
      return true;
    }
    return false;
  }
  void end(std::int32_t count) {
    draw_->count = count;
    ++draw_;
    first_ += count;
  }

  const Patch& patch_;
  const CrackPlan& plan_;
  const Placement<Real>& placement_;
  Vertex* vertex_;
  LatticePoint* provenance_;
  Draw* draw_;
  std::int64_t first_;
  Scratch& scratch_;
  Stores stores_;
  int k_;
};

}  // namespace limitcheck::fast
