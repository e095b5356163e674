// SPDX-License-Identifier: MIT
// Some faces of a mesh as a mesh of their own.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "data/faces.h"
#include "data/sharpness.h"

namespace limitcheck::data {

/// Splits every vertex whose faces form several fans, so that each fan has a vertex of its own. The fan with
/// the lowest face keeps the number; the others get the numbers from `vertex_count` on, in the order of their
/// lowest corners.                                                                                  O(n)
///   faces      indices in 0 .. vertex_count - 1, no directed edge twice
///   returns    for each new vertex the one that it is a copy of
std::vector<std::int32_t> split_fans(Faces& faces, std::size_t vertex_count);

/// Faces of a mesh, renumbered. Any faces of a valid mesh (validate.h) give a valid mesh: where they touch in
/// a vertex only, they are cut apart.
struct CutOut {
  Faces faces;                         ///< in the order asked for
  std::vector<std::int32_t> vertices;  ///< for each vertex, its number in the whole mesh

  /// Values of the whole mesh's vertices, picked for the vertices of the part.
  template <class T>
  std::vector<T> of(const std::vector<T>& whole) const {
    std::vector<T> part;
    part.reserve(vertices.size());
    for (const std::int32_t v : vertices) part.push_back(whole[v]);
    return part;
  }
  /// What of a whole mesh's sharp edges and vertices the part has.                       O(part + tags)
  Sharpness of(const Sharpness& whole) const;
};

/// The given faces, each at most once, as a mesh of their own.       O(faces), however large the mesh is
CutOut cut_out(const Faces& whole, std::span<const std::int32_t> faces);

}  // namespace limitcheck::data
