// SPDX-License-Identifier: MIT
// How far the limit surface can be from flat triangles with their corners on it: proved bounds.
//
// Loop's. Over one triangle of a refined control mesh whose corners are all regular, the surface is a box
// spline patch of twelve control points. Its second derivative in the direction of an edge e is a convex combination
// of the second differences P(k + e) - 2 P(k) + P(k - e) of these points (the box spline M_222 differentiated
// twice along e leaves M_022, which is positive and sums to 1). A function with zero corners and |second
// derivative| <= M_ij along edge i-j is, by convexity along these three directions, at most
//     1/2 sum_{i<j} l_i l_j M_ij  <=  max M_ij / 6
// in size. So the distance between the surface and the flat triangle, point by point at the same parameters,
// is at most a sixth of the largest second difference.
//
// At an extraordinary corner the second differences say nothing. There the corner is subdivided again and
// again: the outer three of the four sub-triangles are regular, and the last corner piece lies in the convex
// hull of its control points, which shrinks like (5/8)^steps at worst.
//
// Catmull-Clark's. Over one quad of a refined control mesh whose corners are all regular, the surface is a
// bicubic patch of sixteen control points, taken by uniform B-splines. Its second derivative along u is a convex
// combination of the eight second differences of these points along u (the spline differentiated twice has
// positive weights that sum to 1), that along v likewise, and the mixed one of the nine mixed differences. Let
// M_u, M_v and M_uv be the largest lengths of these. Along either diagonal the second derivative is
// |S_uu +- 2 S_uv + S_vv| <= M_u + 2 M_uv + M_vv.
//
// The quad is cut along a diagonal. As above, a function with zero corners is over a triangle at most
// 1/2 sum_{i<j} l_i l_j M_ij. Two edges have M_u and M_v, and the third has at least their sum: then the sum is
// largest in the middle of that edge, the diagonal, where it is an eighth of the third. So the distance between
// the surface and the flat triangle, point by point at the same parameters, is at most
//     (M_u + 2 M_uv + M_v) / 8,
// and over each of the four triangles into which the middles of the edges cut it, a quarter of that.
//
// At an extraordinary corner the quads are cut along the diagonal through that corner, and are subdivided
// again and again: the outer three of the four sub-triangles lie in regular quads, and the last piece at the
// corner lies in the convex hull of its control points, which shrinks like 0.6546^steps at worst.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "data/scheme.h"
#include "reference/loop/refine.h"

namespace limitcheck::reference {
class Sharpness;
}

namespace limitcheck::verify {

/// What is sharp at a vertex for which bounds are wanted, in a mesh that has no semi-sharp tags around it.
struct SharpVertexOf {
  const reference::Sharpness* sharpness = nullptr;  // of the mesh; none if it has no tags
  bool held = false;                                // the vertex stays where it is
};

/// The bound for one face of a refined mesh: a triangle, or the two triangles of a quad. Nothing if a corner is not
/// regular (interior: valence 6 or 4; boundary: 3 faces or 2).
///   first    the corner at which u and v of a quad begin
///   states   of the vertices of a mesh that is cut along its sharp edges: held ones and darts are not regular
std::optional<double> regular_bound(const reference::Topology& topology,
                                    std::span<const reference::Vec3<double>> positions, std::size_t face,
                                    std::size_t first = 0,
                                    std::span<const reference::VertexState> states = {});

/// The pieces around one extraordinary vertex, the largest over its sectors. Level 0 is the lattice triangle
/// at the vertex itself.
struct CornerBounds {
  std::vector<double> corner;  // of the piece at the vertex, after so many steps
  std::vector<double> outer;   // of the other three pieces that a step leaves; [0] is not used
};

/// Bounds for the triangles at a vertex of a refined mesh that was a vertex of the control mesh: of a mesh of
/// triangles of depth >= 2, of one of quads of depth >= 1. With sharp edges the mesh is not cut.
CornerBounds corner_bounds(data::Scheme scheme, const reference::Topology& topology,
                           std::span<const reference::Vec3<double>> positions, std::int32_t vertex,
                           const SharpVertexOf& sharp = {});

}  // namespace limitcheck::verify
