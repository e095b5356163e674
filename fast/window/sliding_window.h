// SPDX-License-Identifier: MIT
// The sliding window: one pair of triangles at a time becomes 2^m strips. [mueller2000, 4.3; C18-C21, C43-C55]
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "data/error.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/window/crack_edge.h"

namespace limitcheck::fast {

/// Vectors stored by one or more runs, by the array they go to.
struct WindowCounts {
  std::int64_t rows = 0;            // outtop, top, middle, bottom, outbottom, by subdivision
  std::int64_t corners = 0;         // corner0 .. corner3, by subdivision
  std::int64_t middle_corners = 0;  // mcorner0, mcorner1: copies of points of the others
  std::int64_t filled = 0;          // level 0, from the mesh
  std::int64_t limit_points = 0;    // evaluated: a position and a normal each
  std::int64_t carried = 0;         // strip points taken over from the strip before
  std::int64_t strips = 0;

  std::int64_t stored() const { return rows + corners + middle_corners; }
  friend bool operator==(const WindowCounts&, const WindowCounts&) = default;
};

/// Changes nothing, counts nothing and costs nothing.
struct NoProbe {
  static constexpr void add(std::int64_t WindowCounts::*, std::int64_t) {}
  /// The two recursive calls, with their arguments in the order in which they are printed. A test may
  /// exchange some, to show that no other order works. [C43]
  static void upper(auto&& call, auto*... arguments) { call(arguments...); }
  static void lower(auto&& call, auto*... arguments) { call(arguments...); }
};

/// Counts into `counts`.
struct Counting : NoProbe {
  WindowCounts counts;
  void add(std::int64_t WindowCounts::*what, std::int64_t n) { counts.*what += n; }
};

/// The paper's eleven arrays per level, allocated once, and the recursion over them. One instance per thread.
///
///           outtop[1] outtop[2]                  The pair: face0 = corner0, corner2, corner3 (upper left),
///              /   \   /   \                               face1 = corner0, corner1, corner2 (lower right).
///   corner3  top[0]--top[1]--top[2]  corner2     Row j counts from the top, column i from the left.
///            /  \    /  \    /                   The apex over the edge from top[i] is outtop[i + 1], the
///   corner0 bot[0]--bot[1]--bot[2]   corner1     apex under the edge from bottom[i] is outbottom[i]; the
///              \   /   \   /                     slots left over hold the next neighbour of the corner
///         outbottom[0] outbottom[1]              (outtop[0], outbottom[last]). [C47]
///
///   N         number type (NumberTraits)
///   Surface   makes a vertex of a limit frame
///   Probe     NoProbe, or what a test hangs in, such as Counting
///   Carry     true: a row's limit points are evaluated once and carried to the next strip; false: both
///             rows of every strip are evaluated, as printed [C51]. The output has the same bits.
///
/// Nothing is allocated after construction; the mesh is only read.
template <class N, class Surface = LimitSurface<N>, class Probe = NoProbe, bool Carry = true>
class SlidingWindow {
 public:
  using Vertex = typename Surface::Vertex;

  /// Throws data::ArgumentError: max_depth outside 0 .. 20 or max_valence < 0.
  SlidingWindow(int max_depth, int max_valence)
      : max_depth_(max_depth), max_valence_(std::max(max_valence, 6)) {
    if (max_depth < 0 || max_depth > 20 || max_valence < 0)
      throw data::ArgumentError("sliding window: depth outside 0..20 or negative valence");
    levels_.resize(static_cast<std::size_t>(max_depth) + 1);
    std::size_t total = 0;
    for (int s = 0; s <= max_depth; ++s) total += 5 * row_length(s) + 6 * corner_length();
    storage_.resize(total);
    Vec3<N>* next = storage_.data();
    for (int s = 0; s <= max_depth; ++s) {
      Level& level = levels_[s];
      for (Vec3<N>** row : {&level.outtop, &level.top, &level.middle, &level.bottom, &level.outbottom}) {
        *row = next;
        next += row_length(s);
      }
      for (Corner* corner : {&level.corner[0], &level.corner[1], &level.corner[2], &level.corner[3],
                             &level.mcorner[0], &level.mcorner[1]}) {
        corner->ring = next;
        next += corner_length();
      }
    }
    strip_.resize(2 * row_length(max_depth));
  }

  int max_depth() const { return max_depth_; }
  int max_valence() const { return max_valence_; }
  /// 3D vectors held: sum over the levels of 5 (2^l + 1) + 6 n_max, and 2 * 2 (2^m + 1) for the strip.
  /// [C48, C49]
  std::size_t allocated_vectors() const { return storage_.size() + 2 * strip_.size(); }
  /// Normals that came from the rule for vanishing tangents, in all runs so far. [D12]
  std::int64_t zero_normals() const { return zero_normals_; }
  Probe& probe() { return probe_; }

  /// Tessellates the two faces on both sides of half-edge h0 (face0) and its twin (face1).
  ///   sink(row, strip)   for row = 0 .. 2^depth - 1: strip[2 i] lies in row `row`, strip[2 i + 1] in the
  ///                      next, i = 0 .. 2^depth. As a triangle strip they turn counter-clockwise seen from
  ///                      outside; the first 2 (2^depth - row) - 1 triangles belong to face0, the last
  ///                      2 row + 1 to face1. The array may be read and overwritten until the call returns
  ///                      (with Carry: read only).
  /// Throws data::ArgumentError: depth outside 0 .. max_depth(), no twin, a valence above max_valence().
  template <class Sink>
  void run(const PreparedMesh<N, Surface>& mesh, std::int32_t h0, int depth, Sink&& sink) {
    fill(mesh, h0, depth);
    Level& l = levels_[0];
    const bool over = l.corner[3].has_face_after(0), under = l.corner[1].has_face_after(0);
    subdivide(depth, 0, l.top, l.bottom, over ? l.outtop : nullptr, under ? l.outbottom : nullptr,
              l.corner[0], l.corner[1], l.corner[2], l.corner[3], sink);
  }

 private:
  using Corner = CornerRing<N, Vertex>;
  struct Level {
    Vec3<N>*outtop, *top, *middle, *bottom, *outbottom;
    Corner corner[4], mcorner[2];
  };

  static std::size_t row_length(int s) { return (std::size_t{1} << s) + 1; }
  std::size_t corner_length() const { return static_cast<std::size_t>(max_valence_); }

  /// Fig. 4: the freshly filled arrays.
  void fill(const PreparedMesh<N, Surface>& mesh, std::int32_t h0, int depth) {
    const Adjacency& adjacency = mesh.adjacency();
    const std::int32_t h1 = adjacency.twin(h0);
    if (depth < 0 || depth > max_depth_ || h1 < 0)
      throw data::ArgumentError("sliding window: depth beyond the arrays, or a pair without a second face");
    if (adjacency.max_valence() > max_valence_)
      throw data::ArgumentError("sliding window: a valence beyond the corner arrays");
    depth_ = depth;
    Level& l = levels_[0];
    const auto corner = [&](int i, std::int32_t h, bool from_last_slot) {
      l.corner[i] = gather_corner(mesh, h, from_last_slot, l.corner[i].ring);
      probe_.add(&WindowCounts::filled, l.corner[i].n);
    };
    corner(0, Adjacency::next(h1), false);
    corner(1, Adjacency::prev(h1), true);
    corner(2, Adjacency::next(h0), false);
    corner(3, Adjacency::prev(h0), true);
    l.bottom[0] = mesh.position(adjacency.origin(h0));
    l.bottom[1] = mesh.position(adjacency.origin(Adjacency::prev(h1)));
    l.top[0] = mesh.position(adjacency.origin(Adjacency::prev(h0)));
    l.top[1] = mesh.position(adjacency.origin(h1));
    if (l.corner[3].has_face_after(0)) {
      l.outtop[1] = l.corner[3].at(1);
      l.outtop[0] = l.corner[3].at(2);
    }
    if (l.corner[1].has_face_after(0)) {
      l.outbottom[0] = l.corner[1].at(1);
      l.outbottom[1] = l.corner[1].at(2);
    }
  }

  /// `row`: index of `top` among the rows of its level, which also places the pair's diagonal.
  template <class Sink>
  void subdivide(int level, int row, const Vec3<N>* top, const Vec3<N>* bottom, const Vec3<N>* outtop,
                 const Vec3<N>* outbottom, const Corner& corner0, const Corner& corner1,
                 const Corner& corner2, const Corner& corner3, Sink& sink) {
    if (level == 0) {
      emit(row, top, bottom, outtop, outbottom, corner0, corner1, corner2, corner3, sink);
      return;
    }
    const int s = depth_ - level;  // the rows given have 2^s edges, those computed twice as many
    Level& l = levels_[static_cast<std::size_t>(s) + 1];
    const int n = 1 << s;
    refine_row(n, n - row, top, outtop, bottom, corner3, corner2, l.top);
    refine_row(n, n - row - 1, bottom, top, outbottom, corner0, corner1, l.bottom);
    refine_middle(n, top, bottom, corner0, corner2, l.middle);
    subdivide_ring(bottom[0], corner0, l.corner[0]);
    subdivide_ring(bottom[n], corner1, l.corner[1]);
    subdivide_ring(top[n], corner2, l.corner[2]);
    subdivide_ring(top[0], corner3, l.corner[3]);
    if (outtop != nullptr) {
      refine_flap(n, top, outtop + 1, corner3.has_face_after(1), outtop[0],
                  corner2.has_face_after(corner2.n - 2), corner2.ring[corner2.n - 2], l.outtop + 1);
      l.outtop[0] = l.corner[3].at(2);
    }
    if (outbottom != nullptr) {
      refine_flap(n, bottom, outbottom, corner0.has_face_after(corner0.n - 2), corner0.ring[corner0.n - 2],
                  corner1.has_face_after(1), outbottom[n], l.outbottom);
      l.outbottom[2 * n] = l.corner[1].at(2);
    }
    collect_middle_corners(n, corner0, corner2, l);
    probe_.add(&WindowCounts::rows,
               (2 * n + 1) * (3 + (outtop != nullptr ? 1 : 0) + (outbottom != nullptr ? 1 : 0)));
    probe_.add(&WindowCounts::corners, corner0.n + corner1.n + corner2.n + corner3.n);
    probe_.add(&WindowCounts::middle_corners, l.mcorner[0].n + l.mcorner[1].n);

    using Row = const Vec3<N>*;
    using RingOf = const Corner*;
    const auto subdivide_half = [&](int half_row) {
      return [&, half_row](Row t, Row b, Row ot, Row ob, RingOf c0, RingOf c1, RingOf c2, RingOf c3) {
        subdivide(level - 1, half_row, t, b, ot, ob, *c0, *c1, *c2, *c3, sink);
      };
    };
    const Row new_top = l.top, middle = l.middle, new_bottom = l.bottom;
    const Row new_outtop = outtop != nullptr ? l.outtop : nullptr;
    const Row new_outbottom = outbottom != nullptr ? l.outbottom : nullptr;
    const RingOf c0 = &l.corner[0], c1 = &l.corner[1], c2 = &l.corner[2], c3 = &l.corner[3];
    const RingOf mcorner0 = &l.mcorner[0], mcorner1 = &l.mcorner[1];
    // subdivide upper row
    Probe::upper(subdivide_half(2 * row), new_top, middle, new_outtop, new_bottom, mcorner0, mcorner1, c2,
                 c3);
    // subdivide the lower row
    Probe::lower(subdivide_half(2 * row + 1), middle, new_bottom, new_top, new_outbottom, c0, c1, mcorner1,
                 mcorner0);
  }

  /// The edge points of the upright edges (even) and of the diagonals (odd).
  static void refine_middle(int n, const Vec3<N>* top, const Vec3<N>* bottom, const Corner& corner0,
                            const Corner& corner2, Vec3<N>* out) {
    out[0] = corner0.has_face_after(2) ? edge_point(top[0], bottom[0], top[1], corner0.at(3))
                                       : midpoint(top[0], bottom[0]);
    for (int i = 0; i < n; ++i) {
      if (i > 0) out[2 * i] = edge_point(top[i], bottom[i], top[i + 1], bottom[i - 1]);
      out[2 * i + 1] = edge_point(bottom[i], top[i + 1], top[i], bottom[i + 1]);
    }
    out[2 * n] = corner2.has_face_after(2) ? edge_point(top[n], bottom[n], bottom[n - 1], corner2.at(3))
                                           : midpoint(top[n], bottom[n]);
  }

  /// The rings of middle's two ends: copies of points just computed.
  static void collect_middle_corners(int n, const Corner& corner0, const Corner& corner2, Level& l) {
    const auto collect = [](Corner& out, bool inside, const Vec3<N>& along, const Vec3<N>& diagonal,
                            const Vec3<N>& up, const Corner& upper, const Corner& lower,
                            const Vec3<N>& down) {
      Vec3<N>* const ring = out.ring;
      out = Corner{};
      out.ring = ring;
      ring[0] = along;
      ring[1] = diagonal;
      ring[2] = up;
      if (inside) {
        ring[3] = upper.ring[upper.n - 2];
        ring[4] = lower.at(3);
      }
      out.n = inside ? 6 : 4;
      out.gap = inside ? -1 : 2;
      ring[out.n - 1] = down;
    };
    collect(l.mcorner[0], corner0.has_face_after(2), l.middle[1], l.top[1], l.top[0], l.corner[3],
            l.corner[0], l.bottom[0]);
    collect(l.mcorner[1], corner2.has_face_after(2), l.middle[2 * n - 1], l.bottom[2 * n - 1],
            l.bottom[2 * n], l.corner[1], l.corner[2], l.top[2 * n]);
  }

  template <class Sink>
  void emit(int row, const Vec3<N>* top, const Vec3<N>* bottom, const Vec3<N>* outtop,
            const Vec3<N>* outbottom, const Corner& corner0, const Corner& corner1, const Corner& corner2,
            const Corner& corner3, Sink& sink) {
    const int n = 1 << depth_;
    if (Carry && row > 0) {
      for (int i = 0; i <= n; ++i)
        strip_[2 * static_cast<std::size_t>(i)] = strip_[2 * static_cast<std::size_t>(i) + 1];
      probe_.add(&WindowCounts::carried, n + 1);
    } else {
      limit_row<N, Surface>(n, n - row, top, outtop, bottom, corner3, corner2, 2, strip_.data(),
                            zero_normals_);
      probe_.add(&WindowCounts::limit_points, n + 1);
    }
    limit_row<N, Surface>(n, n - row - 1, bottom, top, outbottom, corner0, corner1, 2, strip_.data() + 1,
                          zero_normals_);
    probe_.add(&WindowCounts::limit_points, n + 1);
    probe_.add(&WindowCounts::strips, 1);
    sink(row, strip_.data());
  }

  int max_depth_, max_valence_;
  int depth_ = 0;
  std::vector<Level> levels_;
  std::vector<Vec3<N>> storage_;
  std::vector<Vertex> strip_;
  std::int64_t zero_normals_ = 0;
  [[no_unique_address]] Probe probe_;
};

}  // namespace limitcheck::fast
