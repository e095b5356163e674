// SPDX-License-Identifier: MIT
// Small valid control meshes on which tessellators are known to fail. Every coordinate is exact in float.
#pragma once

#include "data/control_mesh.h"

namespace limitcheck::data {

/// A block of unit cubes with 1 to 1000 holes through it: closed, of that genus, irregular, bumpy.
/// 36 genus + 28 faces. Throws InputError NAME_BAD_PARAMETER.
ControlMesh handles(int genus);

ControlMesh three_components();     ///< a tetrahedron, a wheel of valence 5 and an octahedron, apart
ControlMesh touching_components();  ///< two octahedra: a vertex of each lies at the same place
ControlMesh flat();                 ///< a wheel of valence 5 in a plane
ControlMesh needles();              ///< a bumpy sheet whose triangles are 2^14 times as long as wide
ControlMesh far_box();              ///< a cube some 100 times its side away from the origin
ControlMesh zero_edge();            ///< an icosahedron; vertices 0 and 1, an edge, lie at the same place
ControlMesh stellated();            ///< an octahedron with a vertex of valence 3 above each face
ControlMesh tiny_box();             ///< a cube times 2^-83, about 1e-25
ControlMesh huge_box();             ///< a cube times 2^66, about 1e20

/// `count` tetrahedra, or cubes of quads, in a grid, 1 to 1.5 million: 4 vertices and 4 faces each, or 8 and
/// 6. With more than 16 384, or 8192, of them indices need more than 16 bits. Throws InputError
/// NAME_BAD_PARAMETER.
ControlMesh crowd(int count, bool quads = false);

}  // namespace limitcheck::data
