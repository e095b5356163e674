// SPDX-License-Identifier: MIT
// Changes of topology for meshes of any faces. What is sharp stays sharp.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"
#include "data/generators/random_mesh.h"

namespace limitcheck::data {

/// The mesh with up to `count` tubes more, 0 .. 1000: each takes the place of two faces of as many corners,
/// which lie apart. A tube within one component raises its genus by 1, one between two joins them. It has
/// triangles if the mesh has no other faces, else quads; there are fewer where no two faces lie apart.
ControlMesh with_handles(ControlMesh mesh, int count, std::uint64_t seed);

/// The mesh with about a quarter of its inner edges turned: the edge between two faces, which together have n
/// corners, goes between two other corners of these. Of triangles that is a flip; other faces may get another
/// number of corners, 3 .. n - 1. Sharp edges stay, and so do those whose ends would keep fewer than three
/// faces, on the boundary one, and those that would join two neighbours twice.
ControlMesh with_turned_edges(ControlMesh mesh, std::uint64_t seed);

/// An irregular mesh of triangles, quads and larger faces, for fuzzing Catmull-Clark's scheme:
/// random_mesh(seed, options) after about half of its inner edges were dissolved in a random order,
/// so that two faces became one. An edge stays where the new face would name a vertex twice or have more than
/// `most_corners` corners, where an inner vertex would keep fewer than 3 faces, and where a boundary vertex
/// would keep none. Valid for Catmull-Clark's scheme; closed or open as random_mesh(seed) is.
///   throws   InputError NAME_BAD_PARAMETER
ControlMesh mixed_mesh(std::uint64_t seed, const RandomMeshOptions& options = {},
                       std::size_t most_corners = 8);

}  // namespace limitcheck::data
