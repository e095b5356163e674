// SPDX-License-Identifier: MIT
// Some faces of a mesh as a mesh of their own.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limitcheck::data {

/// Faces around one vertex that no edge holds together there get a vertex each, so that every vertex has its
/// faces in one fan. The fan with the lowest face keeps the number; the others get `vertex_count` and on, in
/// the order of their lowest corners.                                                               O(n)
///   triangles  indices in 0 .. vertex_count - 1, no directed edge twice
///   returns    for each new vertex the one that it is a copy of
std::vector<std::int32_t> split_fans(std::vector<std::array<std::int32_t, 3>>& triangles,
                                     std::size_t vertex_count);

/// Faces of a mesh, renumbered. Of a valid mesh (validate.h) any faces are a valid mesh: where they touch in
/// a vertex only, they are cut apart.
struct CutOut {
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< of the faces, in their order
  std::vector<std::int32_t> vertices;                  ///< for each vertex, that of the whole

  /// What the whole has for its vertices, for those of the part.
  template <class T>
  std::vector<T> of(const std::vector<T>& whole) const {
    std::vector<T> part;
    part.reserve(vertices.size());
    for (const std::int32_t v : vertices) part.push_back(whole[v]);
    return part;
  }
};

/// The given faces, each at most once.                                            O(faces), whatever the
/// whole
CutOut cut_out(std::span<const std::array<std::int32_t, 3>> whole, std::span<const std::int32_t> faces);

}  // namespace limitcheck::data
