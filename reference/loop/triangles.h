// SPDX-License-Identifier: MIT
// Loop's view of a topology: all faces are triangles.
#pragma once

#include "reference/mesh/topology.h"

namespace limitcheck::reference {

inline Triangle triangle_of(const Topology& topology, std::size_t face) {
  const auto corners = topology.faces()[face];
  return {corners[0], corners[1], corners[2]};
}

/// The vertex of a face that is not on one of its edges; -1 for no face, which is beyond the boundary.
inline std::int32_t opposite(const Topology& topology, const Edge& edge, std::int32_t face) {
  if (face < 0) return -1;
  for (const std::int32_t v : topology.faces()[face])
    if (v != edge.a && v != edge.b) return v;
  return -1;
}

}  // namespace limitcheck::reference
