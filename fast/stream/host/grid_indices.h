// SPDX-License-Identifier: MIT
// One index buffer per depth for all grids, whose vertices lie row by row: vertex (column i, row j) of grid p
// is number base_vertex(p, depth) + j * side + i.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limitcheck::fast::row_stream {

/// Number of the first vertex of grid p where all grids have that depth: the "base vertex" of a draw call.
constexpr std::size_t base_vertex(std::size_t grid, int depth) {
  const std::size_t side = (std::size_t{1} << depth) + 1;
  return grid * side * side;
}

/// Three indices per triangle, counter-clockwise from outside: the 4^depth triangles of face0, then those of
/// face1. A singleton draws the first half. Depth 0..10.
std::vector<std::uint32_t> grid_triangles(int depth);

/// Ends a strip (the restart index of OpenGL, Vulkan, Direct3D).
inline constexpr std::uint32_t kRestart = 0xffffffff;

/// The same triangles as strips, one per row of face0, then one per row of face1, each ended by kRestart; the
/// first strip_indices(depth) / 2 of them are face0's. A third of the indices.
std::vector<std::uint32_t> grid_strips(int depth);

/// Length of grid_strips(depth): of each face, row r = 0 .. N - 1 has 2 r + 3 indices and an end.
constexpr std::size_t strip_indices(int depth) {
  const std::size_t n = std::size_t{1} << depth;
  return 2 * (n * (n + 1) + 2 * n);
}

}  // namespace limitcheck::fast::row_stream
