// SPDX-License-Identifier: MIT
// What every pair asks about a control vertex, computed once per vertex and in an order that no face decides.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "data/control_mesh.h"
#include "fast/adjacency.h"
#include "fast/row_stream/layout.h"

namespace limitcheck::fast::row_stream {

/// Rings and limits of all control vertices in float, the mesh moved to the origin and scaled to size 1
/// by a power of two.
///
/// Order: an interior ring starts at its lexicographically smallest neighbour (position, then the positions
/// that follow it), a boundary ring at the first boundary edge. So what is computed here depends on positions
/// alone: not on the numbering of vertices and faces nor on the rotation of corners. [claim D14]
///
/// Boundary: the open ring r_0 .. r_K goes on at both ends so that the interior rules, applied to it, give
/// the B-spline boundary curve: r_{-k} = q_k - r_k with q = 2 r_0, v + r_0, v + r_K, 2 r_K, v + r_K, v + r_0
/// (period 6), and likewise from r_K. r_{-1} = v + r_0 - r_1 is the ghost of claim D10; the others follow
/// from its being invariant at every level.
class Rings {
 public:
  using Point = std::array<float, 4>;  // x y z 0

  Rings(const data::ControlMesh& mesh, const Adjacency& adjacency);

  /// Ring of a vertex as indices into points(). Entry k of an interior ring is at (k mod n) of `first`; a
  /// boundary ring has kReach further entries at either end and does not wrap.
  struct Ring {
    std::int32_t first;   // into entries()
    std::int32_t period;  // n; kOpen for a boundary ring
  };
  static constexpr std::int32_t kOpen = std::numeric_limits<std::int32_t>::max();
  static constexpr int kReach = kMaxDepth + 3;

  const std::vector<Point>& points() const { return points_; }
  const std::vector<std::int32_t>& entries() const { return entries_; }
  Ring ring(std::int32_t v) const { return rings_[static_cast<std::size_t>(v)]; }
  /// Index in the ring of its origin of the vertex a half-edge points to.
  std::int32_t slot(std::int32_t h) const { return slot_[static_cast<std::size_t>(h)]; }

  /// k0, k1, c, d, limit position, limit normal: the head of a CornerBlock.
  struct Corner {
    std::array<float, CornerBlock::kWindow> head;
  };
  const Corner& corner(std::int32_t v) const { return corners_[static_cast<std::size_t>(v)]; }

  Placement<float> placement() const { return placement_; }
  /// Vertices whose two limit tangents are parallel or vanish: their normal comes from claim D12's rule.
  std::int64_t degenerate_normals() const { return degenerate_normals_; }

 private:
  std::vector<Point> points_;  // control vertices, then ghosts
  std::vector<std::int32_t> entries_;
  std::vector<Ring> rings_;
  std::vector<std::int32_t> slot_;
  std::vector<Corner> corners_;
  Placement<float> placement_{};
  std::int64_t degenerate_normals_ = 0;
};

}  // namespace limitcheck::fast::row_stream
