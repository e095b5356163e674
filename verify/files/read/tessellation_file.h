// SPDX-License-Identifier: MIT
// A finished tessellation as some program wrote it: it is read leniently, because the audit is to report what
// is wrong with it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "data/io/polygon_soup.h"
#include "verify/evidence/vector.h"

namespace limitcheck::verify {

struct FileTessellation {
  struct NormalAt {
    std::int32_t vertex;
    Vector direction;  // as in the file: any length, perhaps not finite
  };
  std::string name;
  std::vector<Vector> positions;  // of the vertices, in file order, perhaps not finite
  std::vector<NormalAt> normals;  // each combination of vertex and normal once; may be empty
  std::vector<std::array<std::int32_t, 3>> triangles;  // larger polygons as fans from their first corner
  /// Of the corners of each triangle, which of `normals` they have, -1: none. Empty if that is the vertex's.
  std::vector<std::array<std::int32_t, 3>> corner_normals;
  /// Texture coordinates, of two components, and of the corners of each triangle which they have, -1: none. Empty: the file
  /// has none.
  std::vector<std::array<double, 2>> texture;
  std::vector<std::array<std::int32_t, 3>> corner_texture;
  std::vector<std::int64_t> polygon;                 // of each triangle: its number in the file, from 0
  std::vector<bool> used;                            // vertices that a triangle names; all, if there are none
  std::int64_t polygons = 0, quads = 0, larger = 0;  // read; of four corners; of more
  std::int64_t left_out = 0;                         // fewer than three corners, or an index out of range
};

/// PLY, OBJ, OFF, STL, glTF by extension; normals from PLY, OBJ and glTF. The syntax must be right, the mesh
/// need not: polygons, open, non-manifold or degenerate faces, duplicate vertices, NaN are all taken. Throws
/// data::InputError with a FILE_ code, and MESH_EMPTY for a file without vertices.
FileTessellation read_tessellation(const std::filesystem::path& file);

}  // namespace limitcheck::verify
