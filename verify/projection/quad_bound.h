// SPDX-License-Identifier: MIT
// How far Catmull-Clark's limit surface can be from flat triangles with their corners on it: proved bounds.
//
// Over one quad of a refined control mesh whose corners are all regular, the surface is a bicubic patch of
// sixteen control points, taken by uniform B-splines. Its second derivative along u is a convex combination
// of the eight second differences of these points along u (the spline differentiated twice has positive
// weights that sum to 1), that along v likewise, and the mixed one of the nine mixed differences. Let M_u,
// M_v and M_uv be the largest lengths of these. Along either diagonal the second derivative is |S_uu +- 2
// S_uv + S_vv| <= M_u + 2 M_uv + M_vv.
//
// The quad is cut along a diagonal. As for Loop's patches (patch_bound.h), a function with zero corners is
// over a triangle at most 1/2 sum_{i<j} l_i l_j M_ij. Two edges have M_u and M_v, and the third has at least
// their sum: then the sum is largest in the middle of that edge, the diagonal, where it is an eighth of the
// third. So the distance between the surface and the flat triangle, point by point at the same parameters, is
// at most
//     (M_u + 2 M_uv + M_v) / 8,
// and over each of the four triangles into which the middles of the edges cut it, a quarter of that.
//
// At an extraordinary corner the quads are cut along the diagonal through that corner, and are subdivided
// again and again: the outer three of the four sub-triangles lie in regular quads, and the last piece at the
// corner lies in the convex hull of its control points, which shrinks like 0.6546^steps at worst.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "verify/projection/patch_bound.h"

namespace limitcheck::verify {

/// Vertex indices, counter-clockwise.
using Quad = std::array<std::int32_t, 4>;

/// The bound for the two triangles of one quad of a refined mesh, or nothing if a corner is not regular
/// (interior: valence 4, boundary: 2 faces).
///   states   as for triangles
std::optional<double> regular_bound(const reference::Topology& topology,
                                    std::span<const reference::Vec3<double>> positions, const Quad& quad,
                                    std::span<const reference::VertexState> states = {});

/// Bounds for the triangles at a vertex of a mesh of quads, refined once or more, that was a vertex before.
/// With sharp edges the mesh is not cut.
CornerBounds quad_corner_bounds(const reference::Topology& topology,
                                std::span<const reference::Vec3<double>> positions, std::int32_t vertex,
                                const SharpVertexOf& sharp = {});

}  // namespace limitcheck::verify
