// SPDX-License-Identifier: MIT
// The limit of a vertex under either family of weights.
#pragma once

#include "reference/normal.h"

namespace limitcheck::reference {

/// As vertex_limit of normal.h, whose tangents and regular normals hold for both families: only the position
/// knows which. The normals that D12 puts where there are none are a convention, the same for both.
template <class N>
VertexLimit<N> vertex_limit(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary,
                            Weights weights) {
  VertexLimit<N> result = vertex_limit(v, ring, on_boundary);
  if (!on_boundary) result.position = interior_limit(v, ring, weights);
  return result;
}

}  // namespace limitcheck::reference
