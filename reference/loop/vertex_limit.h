// SPDX-License-Identifier: MIT
// The limit of a vertex: position, tangents, and a normal that is never NaN.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reference/loop/dart.h"
#include "reference/loop/leading_modes.h"
#include "reference/loop/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/point/normal.h"

namespace limitcheck::reference {

/// Where a vertex goes in a step.
template <class N>
Vec3<N> vertex_point(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary, VertexState state,
                     Weights weights) {
  if (state == VertexState::kHeld) return v;
  if (state == VertexState::kDart) return interior_vertex_point<N>(v, ring.first(ring.size() - 1), weights);
  return on_boundary ? boundary_vertex_point(v, ring.front(), ring.back())
                     : interior_vertex_point<N>(v, ring, weights);
}

/// One subdivision step of a vertex and its ring, in place. [C29]
template <class N>
void subdivide_ring(Vec3<N>& v, std::vector<Vec3<N>>& ring, bool on_boundary,
                    Weights weights = Weights::kLoop, VertexState state = VertexState::kOrdinary) {
  const std::vector<Vec3<N>> old = ring;
  const Vec3<N> centre = v;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    ring[i] = on_boundary && (i == 0 || i + 1 == n)
                  ? boundary_edge_point(centre, old[i])
                  : interior_edge_point(centre, old[i], old[(i + n - 1) % n], old[(i + 1) % n]);
  v = vertex_point<N>(centre, old, on_boundary, state, weights);
}

/// Where the limit of a control vertex lies and which way it faces.
template <class N>
struct VertexLimit {
  Vec3<N> position;
  Tangents<N> tangents;
  Normal<N> normal;
};

/// Limit of a vertex from its ring (masks.h); D12 decides about normals that fail: the area-weighted normal
/// of the ring after one to three steps, else of the control ring, else (0, 0, 1).
///   error    in double a few ulp of the ring's largest coordinate for the position (see stam.h)
template <class N>
VertexLimit<N> vertex_limit(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary,
                            Weights weights = Weights::kLoop, VertexState state = VertexState::kOrdinary) {
  VertexLimit<N> result;
  if (state == VertexState::kDart) {
    result.position =
        v + weighted(dart_limit_weights<N>(static_cast<int>(ring.size()) - 1, weights), v, ring);
    result.tangents = dart_tangents<N>(v, ring, weights);
  } else if (state == VertexState::kHeld) {
    result.position = v;
    if (on_boundary) {  // the two edges
      result.tangents = {};
      add_difference(result.tangents.first, result.tangents.first_terms, N(1), ring.front(), v);
      add_difference(result.tangents.second, result.tangents.second_terms, N(1), ring.back(), v);
    } else {
      result.tangents = interior_tangents(v, ring);
    }
  } else {
    result.position =
        on_boundary ? boundary_limit(v, ring.front(), ring.back()) : interior_limit(v, ring, weights);
    result.tangents = on_boundary ? boundary_tangents(v, ring) : interior_tangents(v, ring);
  }
  result.normal = unit_normal(result.tangents, Vec3<N>{});
  if (result.normal.kind == NormalKind::kRegular) {
    // None at ordinary K >= 6 [D5], held K >= 3 (K = 3 takes it on like 1 / k), and the tip of a cone.
    const bool has_plane = state == VertexState::kHeld       ? on_boundary && ring.size() <= 3
                           : state == VertexState::kOrdinary ? !on_boundary || ring.size() <= 6
                                                             : true;
    if (!has_plane) result.normal.kind = NormalKind::kNoTangentPlane;
    return result;
  }
  // The tangents fail: facet normals may still tell where the surface faces.
  Vec3<N> centre = v, largest = area_normal(v, ring, on_boundary);
  std::vector<Vec3<N>> moving(ring.begin(), ring.end());
  for (int step = 0; step < 3; ++step) {
    subdivide_ring(centre, moving, on_boundary, weights, state);
    const Vec3<N> sum = area_normal<N>(centre, moving, on_boundary);
    N size{};
    for (const Vec3<N>& r : moving) size += dot(r - centre, r - centre);
    const N threshold = N(NumberTraits<N>::kNormalThreshold);
    if (dot(sum, sum) > size * size * threshold * threshold) {
      result.normal = {unit(sum), NormalKind::kFallback, {}};
      return result;
    }
  }
  result.normal = unit_normal(Tangents<N>{}, largest);
  return result;
}

}  // namespace limitcheck::reference
