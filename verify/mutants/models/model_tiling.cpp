// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_tiling.h"

#include <algorithm>
#include <cstddef>

namespace limitcheck::verify {
namespace {

// The triangles of a lattice of n steps whose corner lies at (first, first).
void add_lattice(std::vector<Tile>& tiles, int first, int n, int depth) {
  const auto at = [&](int i, int j) { return TilePoint{first + i, first + j, depth}; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      tiles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < n) tiles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
}

// Step s of n from corner k to the next, in a lattice whose corner lies at (first, first).
TilePoint on_side(int k, int s, int n, int first, int depth) {
  const int back = n - s;
  if (k == 0) return {first + s, first, depth};
  if (k == 1) return {first + back, first + s, depth};
  return {first, first + back, depth};
}

}  // namespace

std::vector<Tile> even_tiles(int depth) {
  std::vector<Tile> tiles;
  add_lattice(tiles, 0, 1 << depth, depth);
  return tiles;
}

std::vector<Tile> stitched_tiles(int depth, const std::array<int, 3>& edge, int every) {
  const int n = 1 << depth, inner = n - 3;
  std::vector<Tile> tiles;
  add_lattice(tiles, 1, inner, depth);
  for (int k = 0; k < 3; ++k) {
    // Between the edge and the first inner row: advance on the side that is behind.
    const int steps = 1 << edge[k];
    int outside = 0, inside = 0;
    while (outside < steps || inside < inner) {
      const TilePoint a = on_side(k, outside, steps, 0, edge[k]);
      const TilePoint b = on_side(k, inside, inner, 1, depth);
      // Halves of steps done, as shares of both sides: (2 outside + 1) / steps against (2 inside + 3) / n.
      const bool along_edge =
          inside == inner || (outside < steps && (2 * outside + 1) * n <= (2 * inside + 3) * steps);
      if (along_edge) {
        tiles.push_back({a, on_side(k, ++outside, steps, 0, edge[k]), b});
      } else {
        const int next = inside + every < inner ? inside + every : inner;
        tiles.push_back({a, on_side(k, next, inner, 1, depth), b});
        inside = next;
      }
    }
  }
  return tiles;
}

namespace {

// Steps of 2^depth along side k of the face, or -1 beside it.
int along(const TilePoint& p, int k) {
  const int n = 1 << p.depth;
  if (k == 0) return p.j == 0 ? p.i : -1;
  if (k == 1) return p.i + p.j == n ? p.j : -1;
  return p.i == 0 ? n - p.j : -1;
}

void cut(std::vector<Tile>& tiles, const Tile& tile, const std::array<int, 3>& edge, int depth) {
  for (std::size_t c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) {
      const int n = 1 << depth, step = n >> edge[static_cast<std::size_t>(k)];
      const int from = along(tile[c], k), to = along(tile[(c + 1) % 3], k);
      if (from < 0 || to < 0 || to - from <= step) continue;
      for (int s = from; s < to; s += step)
        cut(tiles, {on_side(k, s, n, 0, depth), on_side(k, s + step, n, 0, depth), tile[(c + 2) % 3]}, edge,
            depth);
      return;
    }
  tiles.push_back(tile);
}

}  // namespace

std::vector<Tile> cut_tiles(int depth, const std::array<int, 3>& edge) {
  const int deepest = std::max({depth, edge[0], edge[1], edge[2]}), times = 1 << (deepest - depth);
  std::vector<Tile> tiles;
  for (Tile tile : even_tiles(depth)) {
    for (TilePoint& p : tile) p = {p.i * times, p.j * times, deepest};
    cut(tiles, tile, edge, deepest);
  }
  return tiles;
}

}  // namespace limitcheck::verify
