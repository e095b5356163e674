// SPDX-License-Identifier: MIT
// One limit point of a linear map: what the reference's maps are made of. For .cpp files.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "data/control_mesh.h"
#include "fast/plan/grid.h"
#include "reference/point/surface_point.h"
#include "verify/proof/numbers/coefficient.h"

namespace limitcheck::verify {

/// One limit point: the weights of all control points in its position and its two tangents.
template <class C>
struct MapRow {
  MapRow() = default;
  explicit MapRow(std::size_t n) : position(n), d1(n), d2(n) {}

  /// The point's x, y and z belong to points[first], points[first + 1] and points[first + 2].
  void put(const std::vector<std::size_t>& points, std::size_t first, const reference::SurfacePoint<C>& p) {
    constexpr std::array<C reference::Vec3<C>::*, 3> kCoordinates{
        &reference::Vec3<C>::x, &reference::Vec3<C>::y, &reference::Vec3<C>::z};
    for (std::size_t c = 0; c < 3 && first + c < points.size(); ++c) {
      const std::size_t v = points[first + c];
      position[v] = p.position.*kCoordinates[c];
      d1[v] = p.t1.*kCoordinates[c];
      d2[v] = p.t2.*kCoordinates[c];
    }
  }

  std::vector<C> position, d1, d2;
  bool has_tangents = true;  ///< false where C has no numbers for them
};

inline fast::LatticePoint lowest_terms(fast::LatticePoint p) {
  for (; (p.i | p.j | p.denominator) % 2 == 0; p.i /= 2, p.j /= 2) p.denominator /= 2;
  return p;
}

/// Control points that are zero, but points[first] is (1, 0, 0), the next (0, 1, 0), the one after (0, 0, 1).
template <class C>
std::vector<reference::Vec3<C>> unit_vectors(const data::ControlMesh& mesh,
                                             const std::vector<std::size_t>& points, std::size_t first) {
  std::vector<reference::Vec3<C>> unit(mesh.positions.size());
  unit[points[first]].x = C(1);
  if (first + 1 < points.size()) unit[points[first + 1]].y = C(1);
  if (first + 2 < points.size()) unit[points[first + 2]].z = C(1);
  return unit;
}

}  // namespace limitcheck::verify
