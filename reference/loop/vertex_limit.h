// SPDX-License-Identifier: MIT
// The limit of a vertex: position, tangents, and a normal that is never NaN; and which derivatives there are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "reference/loop/dart.h"
#include "reference/loop/masks.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/point/normal.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference {

/// Where a vertex goes in a step.
template <class N>
Vec3<N> vertex_point(const Vec3<N>& v, std::span<const Vec3<N>> ring, bool on_boundary, VertexState state,
                     Weights weights, int valence = 0) {
  if (state == VertexState::kHeld) return v;
  if (state == VertexState::kDart) return interior_vertex_point<N>(v, ring.first(ring.size() - 1), weights);
  return on_boundary ? boundary_vertex_point(v, ring.front(), ring.back())
                     : interior_vertex_point<N>(v, ring, weights, valence);
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

/// Whether box splines describe the surface at a vertex of so many faces.
inline bool is_regular_vertex(std::size_t faces, bool on_boundary, VertexState state) {
  if (state == VertexState::kHeld) return on_boundary && faces == 1;
  return state == VertexState::kOrdinary && faces == (on_boundary ? 3U : 6U);
}

/// The modes that decide which derivatives the surface has at a vertex (surface_point.h), in a mesh that is cut along its sharp edges; `faces` are those of its sector.
///   inside         3/8 + cos(2 pi / n) / 4, the first harmonics. At n = 3 they are quadratic on every face
///   boundary       the curve's 1/2 is linear on every face, slopes +-(r_0 - r_K) / 2 along boundary edges
///                  and 0 along inner ones; from 4 faces on 3/8 + cos(pi / K) / 4 is larger. K = 1: 1/4 is a
///                  multiple of (a + b)^2
///   held           of two faces 1/2 is linear on each: r_1 - c = (r_0 - c) + (r_2 - c). Of three the inner
///                  neighbours drift along a third mode of 1/2; from four on as on the boundary
///   tip of a cone  5/8, the mean
///   dart           the larger of the first harmonic across the sharp edge and the tangent along it. At n = 6
///                  both are 1/2 and linear; the next, 1/4 + sqrt(2) / 16, is even, a root of
///                  x^2 - x / 2 + 7 / 128
inline LeadingModes leading_modes(int faces, bool on_boundary, VertexState state, Weights weights) {
  const auto harmonic = [](long p, long q) { return .375 + NumberTraits<double>::cos_pi(p, q) / 4; };
  if (is_regular_vertex(static_cast<std::size_t>(faces), on_boundary, state)) return kRegularModes;
  if (state == VertexState::kDart) {
    if (faces == 6) return {{{.5, 1}, {.25 + std::numbers::sqrt2 / 16}}};
    const double across = harmonic(2, faces);
    if (faces > 6) return {{{across}}};
    const double along = .375 + std::cos(dart_angle<double>(faces, DartTangentRule{faces, weights})) / 4;
    return {{{std::max(along, across)}}};
  }
  if (!on_boundary) {
    if (state == VertexState::kHeld) return {{{.625}}};
    if (faces == 3) return {{{.25, 2}, {.125}}};
    return {{{harmonic(2, faces)}}};
  }
  if (faces > 3) return {{{harmonic(1, faces)}}};
  if (faces == 3) return {{{.5, 1}, {.5}}};
  if (faces == 2) return {{{.5, 1}, {.375}}};
  return kRegularModes;
}

}  // namespace limitcheck::reference
