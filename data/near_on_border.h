// SPDX-License-Identifier: MIT
// Border vertices that all but coincide, as programs leave them that compute the last column of a sphere anew.
#pragma once

#include <cstdint>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// For each vertex the one that it becomes where ends of boundary edges that lie at most `distance` diagonals of the
/// bounding box apart are joined: the first of all that are so connected, also over others between them. Vertices
/// inside, and those without such a neighbour, stay themselves. Coordinates are finite.
///   distance   at least 0; the time grows with the square of how many border vertices lie so close together
std::vector<std::int32_t> joined_on_border(const ControlMesh& mesh, double distance);

}  // namespace limitcheck::data
