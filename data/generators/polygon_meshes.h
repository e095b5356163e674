// SPDX-License-Identifier: MIT
// Small meshes of quads and other polygons, for any valence and boundary.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// The cube -1 .. 1 in six quads.
ControlMesh quad_cube();
/// A torus of `around` x `across` quads, 3 or more each; every vertex is regular.
ControlMesh quad_torus(int around, int across);
/// n quads round vertex 0 and one more ring around them, n >= 3; heights and radii vary with the seed.
ControlMesh quad_wheel(int n, std::uint64_t seed);
/// The same on an open sector: `faces` quads round vertex 0, which lies on the boundary; faces >= 1.
ControlMesh quad_fan(int faces, std::uint64_t seed);
/// A prism over an n-gon: two n-gons and n quads, n >= 3.
ControlMesh polygon_prism(int n);
/// The dual of a closed triangle mesh: a vertex in the middle of each triangle, a face of n corners around
/// each vertex of valence n. Faces around a vertex are joined as they lie; every vertex of the dual has
/// valence 3.
///   throws   ArgumentError: an edge that has not two faces in opposite directions
ControlMesh dual(const ControlMesh& mesh);

}  // namespace limitcheck::data
