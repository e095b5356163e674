// SPDX-License-Identifier: MIT
// Irregular meshes of triangles, quads and larger faces, for fuzzing Catmull-Clark's scheme.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"
#include "data/generators/random_mesh.h"

namespace limitcheck::data {

/// The mesh random_mesh(seed, options) after about half of its inner edges were dissolved in a random order,
/// so that two faces became one. An edge stays where the new face would name a vertex twice or have more than
/// `most_corners` corners, where an inner vertex would keep fewer than 3 faces, and where a boundary vertex
/// would keep none. Valid for Catmull-Clark's scheme; closed or open as random_mesh(seed) is.
///   throws   InputError NAME_BAD_PARAMETER
ControlMesh mixed_mesh(std::uint64_t seed, const RandomMeshOptions& options = {},
                       std::size_t most_corners = 8);

}  // namespace limitcheck::data
