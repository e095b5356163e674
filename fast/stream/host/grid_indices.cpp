// SPDX-License-Identifier: MIT
#include "fast/stream/host/grid_indices.h"

#include "data/error.h"
#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::row_stream {

namespace {

int checked(int depth) {
  if (depth < 0 || depth > kMaxDepth) throw data::ArgumentError("grid indices: depth is 0 to 10");
  return depth;
}

// Vertex (column i, row j) seen from face0's corner A: rows r = 0 .. N below D's side, column c = 0 .. r.
// face1 is the same half a turn on.
struct Lattice {
  std::uint32_t size;

  explicit Lattice(int depth) : size(std::uint32_t{1} << checked(depth)) {}
  std::uint32_t at(int face, std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t index = row * (size + 1) + column;
    return face == 0 ? index : (size + 1) * (size + 1) - 1 - index;
  }
};

}  // namespace

std::vector<std::uint32_t> grid_triangles(int depth) {
  const Lattice lattice(depth);
  std::vector<std::uint32_t> out;
  out.reserve(6 * std::size_t{lattice.size} * lattice.size);
  for (int face = 0; face < 2; ++face) {
    for (std::uint32_t j = 0; j < lattice.size; ++j) {
      for (std::uint32_t i = 0; i <= j; ++i) {
        const std::uint32_t a = lattice.at(face, i, j), c = lattice.at(face, i + 1, j + 1),
                            d = lattice.at(face, i, j + 1);
        out.insert(out.end(), {a, c, d});
        if (i < j) out.insert(out.end(), {c, a, lattice.at(face, i + 1, j)});
      }
    }
  }
  return out;
}

// Row j of a face, upper points first: (0, j+1) (0, j) (1, j+1) (1, j) .. (j+1, j+1).
std::vector<std::uint32_t> grid_strips(int depth) {
  const Lattice lattice(depth);
  std::vector<std::uint32_t> out;
  out.reserve(strip_indices(depth));
  for (int face = 0; face < 2; ++face) {
    for (std::uint32_t j = 0; j < lattice.size; ++j) {
      for (std::uint32_t i = 0; i <= j; ++i) {
        out.push_back(lattice.at(face, i, j + 1));
        out.push_back(lattice.at(face, i, j));
      }
      out.push_back(lattice.at(face, j + 1, j + 1));
      out.push_back(kRestart);
    }
  }
  return out;
}

}  // namespace limitcheck::fast::row_stream
