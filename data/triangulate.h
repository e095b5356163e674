// SPDX-License-Identifier: MIT
// Polygons cut into triangles, for those who ask: the result has another limit surface than the polygons.
// [C09]
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// What becomes of a face of more than three corners.
enum class Triangulation {
  kKeep,             ///< it stays what it is
  kFan,              ///< from its first corner: (0, 1, 2), (0, 2, 3), ...
  kShortestDiagonal  ///< quads along the shorter diagonal, 0-2 if equal; larger faces as kFan
};

/// The faces of a mesh after triangulation.
struct Triangulated {
  Faces faces;                     ///< the triangles of a polygon follow one another
  std::vector<std::int64_t> face;  ///< for each triangle the face of the mesh that it was cut from
  std::int64_t cut = 0;            ///< so many faces were cut
  std::vector<Channel> channels;   ///< of the mesh, at the corners of the triangles
};

/// Takes any faces, and channels of as many corners; a quad that names a vertex which does not exist is cut as kFan. The triangles of a
/// manifold may be none: two polygons that share two opposite corners may both be cut between them.
Triangulated triangulate(const ControlMesh& mesh, Triangulation rule);

}  // namespace limitcheck::data
