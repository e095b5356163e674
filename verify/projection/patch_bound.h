// SPDX-License-Identifier: MIT
// How far the limit surface can be from a flat triangle with its corners on it: proved bounds.
//
// Over one triangle of a refined control mesh whose corners are all regular, the surface is a box spline
// patch of twelve control points. Its second derivative in the direction of an edge e is a convex combination
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
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

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

/// The bound for one triangle of a refined mesh, or nothing if a corner is not regular (interior: valence 6,
/// boundary: 3 faces).
///   states   of the vertices of a mesh that is cut along its sharp edges: held ones and darts are not regular
std::optional<double> regular_bound(const reference::Topology& topology,
                                    std::span<const reference::Vec3<double>> positions,
                                    const reference::Triangle& triangle,
                                    std::span<const reference::VertexState> states = {});

/// The pieces around one extraordinary vertex, the largest over its sectors. Level 0 is the lattice triangle
/// at the vertex itself.
struct CornerBounds {
  std::vector<double> corner;  // of the piece at the vertex, after so many steps
  std::vector<double> outer;   // of the other three pieces that a step leaves; [0] is not used
};

/// Bounds for the triangles at a vertex of a refined mesh
/// of depth >= 2 that was a vertex of the control mesh. With sharp edges the mesh is not cut.
CornerBounds corner_bounds(const reference::Topology& topology,
                           std::span<const reference::Vec3<double>> positions, std::int32_t vertex,
                           const SharpVertexOf& sharp = {});

}  // namespace limitcheck::verify
