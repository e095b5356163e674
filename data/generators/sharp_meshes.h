// SPDX-License-Identifier: MIT
// Meshes with sharp edges and vertices, of quads or of triangles. All throw InputError NAME_BAD_PARAMETER
// where a number is out of range.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// The cube of quads with all its edges of one sharpness: 0, 1, .. 9, or infinite from 10 on.
ControlMesh creased_cube(std::uint64_t sharpness);
/// One sharp edge from an interior vertex of valence n to a neighbour: it ends at either. n >= 3.
ControlMesh dart(int n, bool triangles);
/// An interior vertex of valence 2k at which k sharp edges meet, every second one; k >= 2. With k = 2 they
/// are one crease, from 3 on a corner with sectors of two faces.
ControlMesh corner(int k, bool triangles);
/// A torus of quads, 12 x 6, with a closed crease of a sharpness around it, and so many tenths.
ControlMesh crease_ring(std::uint64_t sharpness, std::uint64_t tenths = 0);
/// A mesh with one crease of so many edges that stay sharp, which starts and ends in smooth surroundings:
/// from the vertex farthest along (1, 1, 1), at each vertex on as straight as it can. Throws InputError if it
/// would meet the boundary or itself.
ControlMesh with_open_crease(ControlMesh mesh, int edges);
/// Any mesh with about a tenth of its edges sharp, half of them infinite and half below 4, a few sharp
/// vertices, and the way of creasing drawn by chance.
ControlMesh with_random_sharpness(ControlMesh mesh, std::uint64_t seed);
/// Any mesh with other tags, from few to most of its edges: sharpnesses over the whole range and at its seams
/// (0, the least float, next to 1, 2 and 10), and every option drawn by chance.
ControlMesh with_any_tags(ControlMesh mesh, std::uint64_t seed);
/// As with_random_sharpness, with every sharp edge and vertex sharp for ever.
ControlMesh with_random_creases(ControlMesh mesh, std::uint64_t seed);

}  // namespace limitcheck::data
