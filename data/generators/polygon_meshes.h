// SPDX-License-Identifier: MIT
// Meshes of quads and other polygons, for any valence and boundary. Every coordinate is exact in float. All
// throw InputError NAME_BAD_PARAMETER where a number is out of range.
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
/// The dual of a closed mesh: a vertex in the middle of each face, a face of n corners around each vertex of
/// valence n. The vertices around a face become the faces around a vertex, so the dual of triangles has the
/// valence 3 everywhere.
///   throws   ArgumentError: an edge that has not two faces in opposite directions
ControlMesh dual(const ControlMesh& mesh);

/// A chess pawn, which a modeller would turn on a lathe: 2n columns of quads, and at each pole n quads around
/// a vertex of valence n; n >= 3. Every second vertex of the ring around a pole has no edge to it, and the
/// valence 3.
ControlMesh pawn(int n);
/// The same with n columns: at the head n triangles around a vertex of valence n, at the foot one n-gon.
ControlMesh mixed_pawn(int n);

}  // namespace limitcheck::data
