// SPDX-License-Identifier: MIT
// A control mesh in figures: its elements, and properties that cause trouble in tessellation.
#pragma once

#include <cstdint>
#include <map>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// Counted for any mesh whose faces name existing vertices, valid or not.
struct MeshSummary {
  std::int64_t vertices = 0, faces = 0;
  std::int64_t unused_vertices = 0;  ///< that no face names
  std::int64_t components = 0;       ///< of faces, connected by shared vertices
  std::int64_t edges = 0, boundary_edges = 0;
  std::int64_t boundary_loops = 0;  ///< connected groups of boundary edges
  /// Boundary edges whose two ends lie exactly where those of another boundary edge do: seams, as UV maps and
  /// materials leave them. The surface has a gap or a sharp fold along them.
  std::int64_t coincident_boundary_edges = 0;
  std::int64_t coincident_vertices = 0;        ///< vertices that lie exactly where one before them does
  std::int64_t zero_area_faces = 0;            ///< corners coincident or exactly on a line (in double)
  std::int64_t euler = 0;                      ///< vertices in use - edges + faces
  std::map<int, std::int64_t> valence;         ///< how many interior vertices have so many neighbours
  std::map<int, std::int64_t> boundary_faces;  ///< how many boundary vertices have so many faces
  double diagonal = 0;                         ///< of the bounding box
  double largest = 0;                          ///< absolute coordinate
  double shortest_edge = 0;                    ///< that is not zero; 0 if there is none
  /// The spacing of float32 numbers at the largest coordinate. Edges of a few such steps lose their direction
  /// when the mesh is rounded to float.
  double float_step = 0;
  std::int64_t edges_lost_in_float = 0;  ///< edges shorter than 16 float steps
};

/// Time O(n log n), memory O(n), n = vertices + faces. Coordinates are finite.
MeshSummary summarise(const ControlMesh& mesh);

}  // namespace limitcheck::data
