// SPDX-License-Identifier: MIT
// How the model cuts a control face into triangles. Private to it.
#pragma once

#include <array>
#include <vector>

namespace limitcheck::verify {

/// l1 = i / 2^depth, l2 = j / 2^depth.
struct TilePoint {
  int i, j, depth;
  friend auto operator<=>(const TilePoint&, const TilePoint&) = default;
};
using Tile = std::array<TilePoint, 3>;

/// The 4^depth triangles of the lattice, counter-clockwise, row by row in l2.
std::vector<Tile> even_tiles(int depth);

/// A face of depth >= 2 with deeper edges: every lattice point of its own depth inside, and on the edge from
/// corner k to corner k + 1 those of edge[k] >= depth.
///
///     o---o---o---o---o      edge[2]: the points of the deeper neighbour
///      \ / \ /   / \ /       inside: the face's own points
///       o---o---o---o
///
///   every  takes each so-manieth point of the inner rows only: with 2, the triangles along the edges leave
///          out points that those inside have
std::vector<Tile> stitched_tiles(int depth, const std::array<int, 3>& edge, int every = 1);

/// A face of any depth with deeper edges: the triangles of its own lattice, cut from the opposite corner to
/// every point of the deeper neighbour.
std::vector<Tile> cut_tiles(int depth, const std::array<int, 3>& edge);

}  // namespace limitcheck::verify
