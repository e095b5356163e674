// SPDX-License-Identifier: MIT
// The limit of a vertex in a mesh of quads: position, tangents, and a normal that is never NaN; and which
// derivatives there are.
#pragma once

#include <cmath>
#include <vector>

#include "reference/catmull_clark/dart.h"
#include "reference/catmull_clark/ringed_quad.h"
#include "reference/point/normal.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference::catmull_clark {

/// Where a vertex goes.
template <class N>
Vec3<N> limit_position(const RingedCorner<Vec3<N>>& c) {
  if (c.state == VertexState::kHeld) return c.point;
  if (c.state == VertexState::kDart)
    return c.point + weighted(dart_limit_weights<N>(c.face_count()), c.point, c.edge_span(), c.face_span());
  return c.on_boundary ? boundary_limit(c.point, c.edges.front(), c.edges.back())
                       : interior_limit<N>(c.point, c.edge_span(), c.face_span());
}

/// Two directions in the tangent plane, their product outward: of a held corner its ends r_0 - c and r_K - c.
template <class N>
Tangents<N> limit_tangents(const RingedCorner<Vec3<N>>& c) {
  if (c.state == VertexState::kDart) return dart_tangents<N>(c.point, c.edge_span(), c.face_span());
  if (c.state == VertexState::kHeld && c.on_boundary) {
    Tangents<N> t{};
    add_difference(t.first, t.first_terms, N(1), c.edges.front(), c.point);
    add_difference(t.second, t.second_terms, N(1), c.edges.back(), c.point);
    return t;
  }
  return c.on_boundary ? boundary_tangents<N>(c.point, c.edge_span(), c.face_span())
                       : interior_tangents<N>(c.point, c.edge_span(), c.face_span());
}

/// The normal of a vertex from its tangents. Where they fail, that of the faces around after one to three
/// steps, weighted by area, else of the control faces, else (0, 0, 1). [D12] A boundary vertex of four faces
/// and more has no tangent plane, or takes it on like 1/k only; so has a held one of two faces and more, or
/// inside: the masks' direction is given.
template <class N>
Normal<N> limit_normal(const RingedCorner<Vec3<N>>& corner, const Tangents<N>& tangents) {
  Normal<N> normal = unit_normal(tangents, Vec3<N>{});
  if (normal.kind == NormalKind::kRegular) {
    const bool has_plane = corner.state == VertexState::kHeld ? corner.on_boundary && corner.face_count() == 1
                           : corner.state == VertexState::kOrdinary
                               ? !corner.on_boundary || corner.face_count() < 4
                               : true;
    if (!has_plane) normal.kind = NormalKind::kNoTangentPlane;
    return normal;
  }
  const auto sum_of = [](const RingedCorner<Vec3<N>>& c) {
    std::vector<Vec3<N>> ring;
    for (std::size_t i = 0; i < c.edges.size(); ++i) {
      ring.push_back(c.edges[i]);
      if (i < c.faces.size()) ring.push_back(c.faces[i]);
    }
    N size{};
    for (const Vec3<N>& r : ring) size += dot(r - c.point, r - c.point);
    const Vec3<N> sum = area_normal<N>(c.point, ring, c.on_boundary);
    const N threshold = N(NumberTraits<N>::kNormalThreshold);
    return dot(sum, sum) > size * size * threshold * threshold ? sum : Vec3<N>{};
  };
  RingedCorner<Vec3<N>> moving = corner;
  for (int step = 0; step < 3; ++step) {
    moving = subdivide<N>(moving);
    const Vec3<N> sum = sum_of(moving);
    if (dot(sum, sum) > N(0)) return {unit(sum), NormalKind::kFallback, {}};
  }
  return unit_normal(Tangents<N>{}, sum_of(corner));
}

template <class N>
VertexLimit<N> limit_of(const RingedCorner<Vec3<N>>& corner) {
  VertexLimit<N> limit{limit_position(corner), {}, {}};
  if constexpr (kHasNormals<N>) {
    limit.tangents = limit_tangents(corner);
    limit.normal = limit_normal(corner, limit.tangents);
  }
  return limit;
}

/// The modes that decide which derivatives the surface has at a vertex (surface_point.h), in a mesh that is cut along its sharp edges; `faces` are those of its sector. lambda as in
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
