// SPDX-License-Identifier: MIT
// From which depth on a mesh needs origins near its edges.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "fast/mesh/box.h"
#include "fast/mesh/vec3.h"
#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::row_stream {

/// Seen from an origin common to the mesh, normals at depth d lose 2^d s / h roundings or more, where s is the
/// size of the mesh and h the height of a triangle. So many are let pass before depth 4: not a power of two,
/// for meshes in which s / h is one, where rounding would decide differently for each way to write them.
inline constexpr double kMostRoundings = 1023;
/// Meshes of so many vertices have low triangles anyway, and origins of their own cost 40 to 60 % of the time at
/// the least depths. So they have them only if there are needles: triangles lower than this beside the mesh.
inline constexpr std::size_t kManyVertices = 8192;
inline constexpr double kNeedle = 0x1p-11;

/// The square of the height of the triangle between e and f over the longest of these and `third`, if that is
/// less than `least`. 0 is none: a flat triangle has no normal to lose.
inline double lesser_squared_height(const Vec3<double>& e, const Vec3<double>& f, double third,
                                    double least) {
  const Vec3<double> c = cross(e, f);
  const double area = dot(c, c), longest = std::max({dot(e, e), dot(f, f), third});
  return area > 0 && area < least * longest ? area / longest : least;
}

/// A value for KernelPlacement::local_from.
///   least   the square of the least height that is not 0; infinity if there is none. It must not depend on how
///           the mesh is written down, or its bits would.
inline int local_origins_from(std::span<const std::array<double, 3>> positions, double least) {
  if (positions.empty()) return kLocalFrom;
  const double size = Box(positions).size();
  const auto lower_than = [&](double share) { return least < share * share * size * size; };
  if (positions.size() >= kManyVertices) return lower_than(kNeedle) ? 1 : kLocalFrom;
  int depth = 1;
  while (depth < kLocalFrom && !lower_than((1 << depth) / kMostRoundings)) ++depth;
  return depth;
}

}  // namespace limitcheck::fast::row_stream
