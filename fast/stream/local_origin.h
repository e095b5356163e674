// SPDX-License-Identifier: MIT
// From which depth on a mesh needs origins near its edges.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "fast/mesh/box.h"
#include "fast/mesh/vec3.h"
#include "fast/stream/layout.h"

namespace limitcheck::fast::row_stream {

/// Seen from an origin common to the mesh, normals at depth d lose 2^d s / h roundings or more, where s is the
/// size of the mesh and h the height of a triangle. So many are let pass before depth 4: not a power of two,
/// for meshes in which s / h is one, where rounding would decide differently for each way to write them.
inline constexpr double kMostRoundings = 1023;
/// Meshes of so many vertices have low triangles anyway, and time to lose: origins of their own cost 40 to
/// 60 % at the least depths. They have them only if there are needles: triangles so low beside the mesh.
inline constexpr std::size_t kManyVertices = 8192;
inline constexpr double kNeedle = 0x1p-11;

/// The square of the least height of the triangles that are not flat; infinity if there is none. `triangle`:
/// three points of number t.
template <class Triangle>
double least_squared_height(std::size_t triangles, const Triangle& triangle) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < triangles; ++t) {
    const std::array<Vec3<double>, 3> p = triangle(t);
    const Vec3<double> e = p[1] - p[0], f = p[2] - p[0], g = f - e, c = cross(e, f);
    const double area = dot(c, c), longest = std::max({dot(e, e), dot(f, f), dot(g, g)});
    if (area > 0 && area < least * longest) least = area / longest;
  }
  return least;
}

/// A value for KernelPlacement::local_from.
template <class Triangle>
int local_origins_from(std::span<const std::array<double, 3>> positions, std::size_t triangles,
                       const Triangle& triangle) {
  if (positions.empty()) return kLocalFrom;
  const double size = Box(positions).size(), least = least_squared_height(triangles, triangle);
  const auto lower_than = [&](double share) { return least < share * share * size * size; };
  if (positions.size() >= kManyVertices) return lower_than(kNeedle) ? 1 : kLocalFrom;
  int depth = 1;
  while (depth < kLocalFrom && !lower_than((1 << depth) / kMostRoundings)) ++depth;
  return depth;
}

}  // namespace limitcheck::fast::row_stream
