// SPDX-License-Identifier: MIT
// Diagonals of faces that join the same control vertices as another edge does.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "verify/evidence/evidence.h"

namespace limitcheck::verify {

/// Triangles of points, and the triangle of the tessellation that each is, or is part of.
struct OriginOfTriangles {
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> origin;
  std::int64_t points = 0;
};

/// At depth 0 a face of four corners and more is cut along diagonals, and another edge of the mesh, or
/// another face's diagonal, may join the same two vertices: as a set of indices three triangles and more then
/// meet in one edge, though no surface does. Such a diagonal, which two triangles of its face have in
/// opposite directions, gets a point of its own in its middle; all else stays as it is.
///   triangles   three points for each triangle of the tessellation, 0 .. points - 1, or -1
OriginOfTriangles tell_diagonals_apart(const Evidence& e, std::vector<std::array<std::int32_t, 3>> triangles,
                                       std::int64_t points);

}  // namespace limitcheck::verify
