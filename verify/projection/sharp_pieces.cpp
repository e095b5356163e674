// SPDX-License-Identifier: MIT
#include "verify/projection/sharp_pieces.h"

#include <algorithm>
#include <cmath>

namespace limitcheck::verify {

bool SharpPieces::is_irregular(std::int32_t v, std::size_t inside, std::size_t boundary) const {
  const auto& sector = topology.sector(v).faces;
  for (const std::int32_t f : sector)
    for (const std::int32_t near : topology.faces()[f])
      if (near != v || sector.size() < 3)
        for (const std::int32_t other : topology.sector(near).faces)
          if (rough[other]) return false;
  if (cut.states[v] != reference::VertexState::kOrdinary) return true;
  return std::any_of(sector.begin(), sector.end(), [&](std::int32_t f) {
    const auto corners = cut.topology.faces()[f];
    const std::int32_t copy =
        *std::find_if(corners.begin(), corners.end(), [&](std::int32_t c) { return cut.origin[c] == v; });
    const reference::Sector its = cut.topology.sector(copy);
    return its.faces.size() != (its.closed ? inside : boundary);
  });
}

double SharpPieces::hull(std::int32_t face) const {
  const auto corners = topology.faces()[face];
  double radius = 0;
  for (const std::int32_t corner : corners)
    for (const std::int32_t f : topology.sector(corner).faces)
      for (const std::int32_t v : topology.faces()[f]) {
        const auto to = positions[v] - positions[corners[0]];
        radius = std::max(radius, std::sqrt(dot(to, to)));
      }
  return 2 * radius;
}

}  // namespace limitcheck::verify
