// SPDX-License-Identifier: MIT
// The sliding window with Catmull and Clark's rules: a quad at a time becomes 2^m strips. [mueller2000, 4.3;
// C21, C43-C55]
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "data/error.h"
#include "fast/window/quad_rows.h"
#include "fast/window/sliding_window.h"

namespace limitcheck::fast {

/// The paper's arrays per level, allocated once, and the recursion over them, as in sliding_window.h. A quad
/// is what a pair of triangles is there, and has no diagonal. One instance per thread.
///
///     outtop[-1] outtop[0] outtop[1] outtop[2]       The quad: corner0 at (u, v) = (0, 0),
///         |         |         |          |           corner1 at (1, 0), corner2 at (1, 1),
///      top[-1]   corner3 - corner2 -- top[2]         corner3 at (0, 1)
///         |         |         |          |
///     bottom[-1] corner0 - corner1 - bottom[2]
///         |         |         |          |
///    outbot[-1] outbot[0] outbot[1] outbot[2]
///
/// Row j counts from the top, column i from the left; each row begins with the column to the left of the quad
/// and ends with that to its right. What lies diagonally beyond a corner is read nowhere, but computed, if
/// valences are not 4: there is no such point then.
///
///   Carry     true: of the five rows that a strip becomes, the first three are those which the strip before
///             ended with, and so are the limits of its upper row: every point is computed once,
///             sum (2^l + 3)^2 for levels l = 1 .. m, and (2^m + 1)^2 limits. false: all five and both, as printed. The
///             output has the same bits. The other parameters are those of SlidingWindow.
///
/// Nothing is allocated after construction, unless sides are semi-sharp; the mesh is only read.
template <class N, class Surface = LimitSurface<N>, class Probe = NoProbe, bool Carry = true>
class QuadWindow {
 public:
  using Vertex = typename Surface::Vertex;

  /// Throws data::ArgumentError: max_depth outside 0 .. 20 or max_valence < 0.
  QuadWindow(int max_depth, int max_valence) : max_depth_(max_depth), max_valence_(std::max(max_valence, 4)) {
    if (max_depth < 0 || max_depth > 20 || max_valence < 0)
      throw data::ArgumentError("quad window: depth outside 0..20 or negative valence");
    levels_.resize(static_cast<std::size_t>(max_depth) + 1);
    std::size_t total = 0;
    for (int s = 0; s <= max_depth; ++s) total += 5 * row_length(s) + 4 * ring_length();
    storage_.resize(total);
    Vec3<N>* next = storage_.data();
    for (int s = 0; s <= max_depth; ++s) {
      for (Vec3<N>*& row : levels_[s].rows) row = std::exchange(next, next + row_length(s)) + 1;
      for (Corner& corner : levels_[s].corner) corner.star.ring = std::exchange(next, next + ring_length());
    }
    strip_.resize(2 * ((std::size_t{1} << max_depth) + 1));
  }

  int max_depth() const { return max_depth_; }
  int max_valence() const { return max_valence_; }
  /// 3D vectors held: sum over the levels of 5 (2^l + 3) + 4 (2 n_max + 1), and 2 * 2 (2^m + 1) for the
  /// strip.
  std::size_t allocated_vectors() const { return storage_.size() + 2 * strip_.size(); }
  /// Normals that came from the rule for vanishing tangents, in all runs so far. [D12]
  std::int64_t zero_normals() const { return zero_normals_; }
  Probe& probe() { return probe_; }

  /// Tessellates a quad.
  ///   sink(row, strip)   for row = 0 .. 2^depth - 1: strip[2 i] lies in row `row`, strip[2 i + 1] in the
  ///                      next, i = 0 .. 2^depth; v = 1 - row / 2^depth, u = i / 2^depth. As a triangle strip
  ///                      they turn counter-clockwise seen from outside. The array is overwritten by the next
  ///                      call.
  /// Throws data::ArgumentError: depth outside 0 .. max_depth(), a valence above max_valence().
  template <class Sink>
  void run(const PreparedQuads<N, Surface>& mesh, std::int32_t quad, int depth, Sink&& sink) {
    run_from(mesh, 4 * quad, depth, sink);
  }
  /// The same with corner0 where half-edge h begins and corner1 where it ends.
  template <class Sink>
  void run_from(const PreparedQuads<N, Surface>& mesh, std::int32_t h, int depth, Sink&& sink) {
    const std::int32_t second = QuadAdjacency::next(h), third = QuadAdjacency::next(second);
    fill(mesh, {h, second, third, QuadAdjacency::next(third)}, depth);
    subdivide(depth, 0, sink);
  }

 private:
  using Corner = QuadCorner<N, Vertex>;
  static constexpr std::size_t kOutTop = 0, kTop = 1, kMiddle = 2, kBottom = 3, kOutBottom = 4;  // of rows
  struct Level {
    std::array<Vec3<N>*, 5> rows;  // at level 0 kMiddle is not used
    std::array<Corner, 4> corner;
  };

  static std::size_t row_length(int s) { return (std::size_t{1} << s) + 3; }
  std::size_t ring_length() const { return 2 * static_cast<std::size_t>(max_valence_) + 1; }

  /// h: the half-edges that leave the corners.
  void fill(const PreparedQuads<N, Surface>& mesh, const std::array<std::int32_t, 4>& h, int depth) {
    if (depth < 0 || depth > max_depth_) throw data::ArgumentError("quad window: depth beyond the arrays");
    if (mesh.mesh().adjacency.max_valence() > max_valence_)
      throw data::ArgumentError("quad window: a valence beyond the corner arrays");
    depth_ = depth;
    Level& l = levels_[0];
    for (int k = 0; k < 4; ++k) {
      l.corner[k] = gather_corner(mesh, h[k], l.corner[k].star.ring);
      probe_.add(&WindowCounts::filled, l.corner[k].star.size());
    }
    side_[0].fill(mesh, h[0], depth, false);  // bottom, from the left
    side_[1].fill(mesh, h[1], depth, true);   // right, from the top
    side_[2].fill(mesh, h[2], depth, true);   // top, from the left
    side_[3].fill(mesh, h[3], depth, false);  // left, from the top
    const auto& c = l.corner;
    l.rows[kTop][0] = c[3].star.centre;
    l.rows[kTop][1] = c[2].star.centre;
    l.rows[kBottom][0] = c[0].star.centre;
    l.rows[kBottom][1] = c[1].star.centre;
    put_beyond(l, 0, true);
    put_beyond(l, 0, false);
    // Diagonally beyond: at valence 4 the corner's last face.
    const auto beyond = [](const Corner& corner) {
      return corner.star.open ? corner.star.centre : corner.star.face(corner.sector + 2);
    };
    l.rows[kOutTop][-1] = beyond(c[3]);
    l.rows[kOutTop][2] = beyond(c[2]);
    l.rows[kOutBottom][-1] = beyond(c[0]);
    l.rows[kOutBottom][2] = beyond(c[1]);
  }

  /// The ring's points next to the two upper or lower corners, which rows do not give at every valence.
  void put_beyond(Level& l, int s, bool upper) {
    const int n = 1 << s;
    const Corner &left = l.corner[upper ? 3 : 0], &right = l.corner[upper ? 2 : 1];
    Vec3<N>*line = l.rows[upper ? kTop : kBottom], *out = l.rows[upper ? kOutTop : kOutBottom];
    if (side_[3].inside()) line[-1] = upper ? left.beyond_right() : left.beyond_left();
    if (side_[1].inside()) line[n + 1] = upper ? right.beyond_left() : right.beyond_right();
    if (!side_[upper ? 2 : 0].inside()) return;
    out[0] = upper ? left.beyond_left() : left.beyond_right();
    out[n] = upper ? right.beyond_right() : right.beyond_left();
  }

  /// `row`: which of the 2^s strips of level s = depth - level is in that level's rows.
  template <class Sink>
  void subdivide(int level, int row, Sink& sink) {
    const int s = depth_ - level, n = 1 << s;
    Level& from = levels_[s];
    const std::size_t top = s == 0 ? kTop : first_row(row), bottom = s == 0 ? kBottom : top + 1;
    const bool first = row == 0, last = row == n - 1;
    const Vec3<N>* above = first && !side_[2].inside() ? nullptr : from.rows[top - 1];
    const Vec3<N>* below = last && !side_[0].inside() ? nullptr : from.rows[s == 0 ? kOutBottom : bottom + 1];
    if (level == 0) {
      emit(row, from.rows[top], from.rows[bottom], above, below, sink);
      return;
    }
    Level& to = levels_[static_cast<std::size_t>(s) + 1];
    const RowEnds ends{&side_[3], &side_[1]};
    const Vec3<N>*upper = from.rows[top], *lower = from.rows[bottom];
    int rows = 2;
    if (Carry && !first) {
      std::rotate(to.rows.begin(), to.rows.begin() + 2, to.rows.end());
    } else {
      if (above != nullptr) {
        odd_row(n, above, upper, ends, s, first ? -1 : row - 1, to.rows[kOutTop]);
        ++rows;
      }
      odd_row(n, upper, lower, ends, s, row, to.rows[kMiddle]);
      if (first) step_corners(s, true);
      even_row(n, upper, above, lower, above == nullptr ? nullptr : to.rows[kOutTop], to.rows[kMiddle], ends,
               first ? &side_[2] : nullptr, s, first ? -1 : row, to.rows[kTop]);
      if (first) put_corners(to, s + 1, true);
      rows += 2;
    }
    if (below != nullptr)
      odd_row(n, lower, below, ends, s, last ? -1 : row + 1, to.rows[kOutBottom]);
    else
      --rows;
    if (last) step_corners(s, false);
    even_row(n, lower, upper, below, to.rows[kMiddle], below == nullptr ? nullptr : to.rows[kOutBottom], ends,
             last ? &side_[0] : nullptr, s, last ? -1 : row + 1, to.rows[kBottom]);
    if (last) put_corners(to, s + 1, false);
    probe_.add(&WindowCounts::rows,
               rows * (2 * n + 1 + (side_[3].inside() ? 1 : 0) + (side_[1].inside() ? 1 : 0)));

    subdivide(level - 1, 2 * row, sink);
    subdivide(level - 1, 2 * row + 1, sink);
  }

  /// Where the upper row of a strip stands: it is the upper or the lower half of what its parent became.
  static std::size_t first_row(int row) { return row % 2 == 0 ? kTop : kMiddle; }

  void step_corners(int s, bool upper) {
    for (const int k : upper ? std::array{2, 3} : std::array{0, 1}) {
      subdivide_corner(levels_[s].corner[k], levels_[static_cast<std::size_t>(s) + 1].corner[k]);
      probe_.add(&WindowCounts::corners, levels_[s].corner[k].star.size());
    }
  }
  void put_corners(Level& to, int s, bool upper) {
    Vec3<N>* line = to.rows[upper ? kTop : kBottom];
    line[0] = to.corner[upper ? 3 : 0].star.centre;
    line[1 << s] = to.corner[upper ? 2 : 1].star.centre;
    put_beyond(to, s, upper);
  }

  template <class Sink>
  void emit(int row, const Vec3<N>* upper, const Vec3<N>* lower, const Vec3<N>* above, const Vec3<N>* below,
            Sink& sink) {
    const int n = 1 << depth_;
    const RowEnds ends{&side_[3], &side_[1]};
    const bool first = row == 0, last = row == n - 1;
    const auto& corner = levels_[0].corner;
    if (Carry && !first) {
      for (int i = 0; i <= n; ++i)
        strip_[2 * static_cast<std::size_t>(i)] = strip_[2 * static_cast<std::size_t>(i) + 1];
      probe_.add(&WindowCounts::carried, n + 1);
    } else {
      limit_row<N, Surface>(n, upper, above, lower, ends, first ? &side_[2] : nullptr, depth_,
                            first ? -1 : row, strip_.data(), zero_normals_);
      if (first) strip_[0] = *corner[3].limit, strip_[2 * static_cast<std::size_t>(n)] = *corner[2].limit;
      probe_.add(&WindowCounts::limit_points, n + 1);
    }
    limit_row<N, Surface>(n, lower, upper, below, ends, last ? &side_[0] : nullptr, depth_,
                          last ? -1 : row + 1, strip_.data() + 1, zero_normals_);
    if (last) strip_[1] = *corner[0].limit, strip_[2 * static_cast<std::size_t>(n) + 1] = *corner[1].limit;
    probe_.add(&WindowCounts::limit_points, n + 1);
    probe_.add(&WindowCounts::strips, 1);
    sink(row, strip_.data());
  }

  int max_depth_, max_valence_;
  int depth_ = 0;
  std::array<QuadSide, 4> side_;
  std::vector<Level> levels_;
  std::vector<Vec3<N>> storage_;
  std::vector<Vertex> strip_;
  std::int64_t zero_normals_ = 0;
  [[no_unique_address]] Probe probe_;
};

}  // namespace limitcheck::fast
