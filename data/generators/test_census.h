// SPDX-License-Identifier: MIT
// For the tests of this folder: what can be counted straight from the faces, without the generators' help.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::data {

struct Census {
  std::map<std::size_t, int> sizes;      ///< faces by their corners
  std::map<int, int> interior_valences;  ///< inner vertices by their edges
  std::map<int, int> boundary_faces;     ///< boundary vertices by their faces
  int euler = 0;                         ///< vertices - edges + faces
};

inline Census census(const ControlMesh& mesh) {
  Census c;
  std::map<std::pair<std::int32_t, std::int32_t>, int> faces_of;  // each edge
  std::vector<int> faces_at(mesh.positions.size()), edges_at(mesh.positions.size());
  std::vector<bool> on_boundary(mesh.positions.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    ++c.sizes[face.size()];
    for (std::size_t k = 0; k < face.size(); ++k) {
      ++faces_at[face[k]];
      ++faces_of[std::minmax(face[k], face[(k + 1) % face.size()])];
    }
  }
  for (const auto& [edge, faces] : faces_of) {
    for (const std::int32_t v : {edge.first, edge.second}) {
      ++edges_at[v];
      if (faces == 1) on_boundary[v] = true;
    }
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    ++(on_boundary[v] ? c.boundary_faces[faces_at[v]] : c.interior_valences[edges_at[v]]);
  c.euler = static_cast<int>(mesh.positions.size()) - static_cast<int>(faces_of.size()) +
            static_cast<int>(mesh.faces.size());
  return c;
}

}  // namespace limitcheck::data
