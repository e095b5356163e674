// SPDX-License-Identifier: MIT
// The table of modes that decide which derivatives Loop's surface has at a vertex (derivative_limits.h).
#pragma once

#include <algorithm>
#include <numbers>

#include "reference/loop/dart.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/point/derivative_limits.h"

namespace limitcheck::reference {

/// Whether box splines describe the surface at a vertex of so many faces.
inline bool is_regular_vertex(std::size_t faces, bool on_boundary, VertexState state) {
  if (state == VertexState::kHeld) return on_boundary && faces == 1;
  return state == VertexState::kOrdinary && faces == (on_boundary ? 3U : 6U);
}

/// Of a vertex in a mesh that is cut along its sharp edges; `faces` are those of its sector.
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
