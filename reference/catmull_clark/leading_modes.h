// SPDX-License-Identifier: MIT
// The table of modes that decide which derivatives Catmull-Clark's surface has at a vertex
// (derivative_limits.h).
#pragma once

#include <cmath>

#include "reference/catmull_clark/dart.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/point/derivative_limits.h"

namespace limitcheck::reference::catmull_clark {

/// Whether a bicubic patch describes the surface at a vertex of so many faces.
inline bool is_regular_vertex(int faces, bool on_boundary, VertexState state) {
  if (state == VertexState::kHeld) return on_boundary && faces == 1;
  return state == VertexState::kOrdinary && faces == (on_boundary ? 2 : 4);
}

/// Of a vertex in a mesh that is cut along its sharp edges; `faces` are those of its sector. lambda as in
/// masks.h.
///   inside         lambda of 2 pi / n
///   boundary       of one face the curve's 1/2 is linear, u - v; 1/4 is there twice, uv and the curve's,
///                  which drifts along uv. From three faces on lambda of pi / K
///   held           of two faces 1/2 is linear for the ends, the inner neighbour drifts along a third mode of
///                  1/2; from three faces on as on the boundary
///   tip of a cone  the mean
///   dart           the larger of lambda across the sharp edge and the tangent along it. At n = 4 both are
///                  1/2 and linear; the next is even
inline LeadingModes leading_modes(int faces, bool on_boundary, VertexState state) {
  const auto lambda = [](long q) { return (four_lambda_minus_one<double>(q) + 1) / 4; };
  if (is_regular_vertex(faces, on_boundary, state)) return kRegularModes;
  if (state == VertexState::kDart) {
    constexpr double kNextOfFour = .3196817213423;
    if (faces == 4) return {{{.5, 1}, {kNextOfFour}}};
    if (faces > 4) return {{{lambda(faces)}}};
    const double c = std::cos(dart_angle<double>(faces, DartTangentRule{faces}));
    return {{{(5 + c + std::sqrt((1 + c) * (9 + c))) / 16}}};
  }
  if (!on_boundary) return {{{state == VertexState::kHeld ? cone_eigenvalue<double>() : lambda(faces)}}};
  if (faces == 1) return {{{.5, 1}, {.25}}};
  if (faces == 2) return {{{.5, 1}, {.5}}};
  return {{{lambda(2 * faces)}}};
}

}  // namespace limitcheck::reference::catmull_clark
