// SPDX-License-Identifier: MIT
// Small control meshes with a purpose. Every coordinate is exact in float, so that a subject of either
// precision gets the same mesh; flat shapes carry a small fixed bumpiness, so that no derivative vanishes by
// symmetry.
#pragma once

#include "data/control_mesh.h"

namespace limitcheck::data {

// All throw InputError (NAME_BAD_PARAMETER) for a parameter outside the stated range or beyond
// 10 million faces.

// Closed.

ControlMesh tetrahedron();  ///< 4 vertices of valence 3; the one of the known answers
ControlMesh octahedron();   ///< 6 vertices of valence 4
ControlMesh icosahedron();  ///< 12 vertices of valence 5

/// All vertices regular (valence 6). around >= 3 steps of the large circle (radius 1), along >= 3 of the tube
/// (radius 0.4).
ControlMesh torus(int around, int along);

/// Two apices of valence n >= 3 over an equator of n vertices of valence 4; n = 4 is an octahedron.
ControlMesh bipyramid(int n);

/// A cube with each side cut into 2 triangles: two corners of valence 6, six of valence 4.
ControlMesh cube();

// With boundary.

/// A hub (vertex 0) of valence n >= 3 in the middle of `rings` >= 1 rings: n sectors of the regular lattice,
/// n * rings^2 faces. Inside, all vertices but the hub are regular; with rings >= 3 the hub's neighbours do
/// not touch the boundary.
ControlMesh wheel(int n, int rings = 3);

/// Half of a wheel: a boundary vertex (vertex 0) with k >= 1 faces, k sectors of `rings` >= 1 rings.
/// [D1, D2, D5]
ControlMesh fan(int k, int rings = 3);

/// A regular sheet of nx x ny squares, each cut along the same diagonal: all interior vertices regular.
ControlMesh sheet(int nx, int ny);

/// A sheet of 8 x 8 squares with two holes of 2 x 2 squares: three boundaries.
ControlMesh holes();

/// n >= 1 triangles in a row; all vertices on the boundary, with 1, 2 and 3 faces.
ControlMesh strip(int n);

/// A disc around a hub of valence 7 whose boundary vertices have 1, 2, ... 8 faces.
ControlMesh ragged_disc();

ControlMesh triangle();        ///< one triangle, three boundary edges
ControlMesh triangle_pair();   ///< two triangles sharing an edge
ControlMesh two_components();  ///< a tetrahedron and, apart from it, a wheel of valence 5

}  // namespace limitcheck::data
