// SPDX-License-Identifier: MIT
#include "fast/stream/gather/alone.h"

#include <cstddef>

#include "fast/window/triangle_lattice.h"

namespace limitcheck::fast::row_stream {

CutGrids::CutGrids(const TriangleMesh& mesh)
    : prepared_(mesh.adjacency(), positions_of<double>(mesh.points()), mesh.kinds()),
      on_cut_(static_cast<std::size_t>(mesh.adjacency().vertex_count())) {
  for (std::int32_t h = 0; h < 3 * mesh.adjacency().face_count(); ++h)
    if (mesh.is_cut(h)) on_cut_[adjacency().origin(h)] = on_cut_[adjacency().target(h)] = 1;
}

template <class Put>
void CutGrids::run(Window& window, const Grid& grid, int depth, Order order, Put&& put) const {
  using Double = SurfaceVertex<double>;
  const bool from_a = order == Order::kFromA;
  const int size = 1 << depth;
  if (grid.edge0 < 0) {  // a face alone: its points above the diagonal; those below it are never shown
    for (int k = 0; k < (size + 1) * (size + 1); ++k) put(k / (size + 1), k % (size + 1), Double{});
    return TriangleLattice<double>(depth).run(
        prepared_, grid.face0, depth, [&](int row, const Double* strip) {
          for (int q = 0; q < 2 * (size - row) + 1; ++q) {
            const int j = size - row - q % 2, i = q / 2;
            from_a ? put(j, i, strip[q]) : put(size - j, size - i, strip[q]);
          }
        });
  }
  // The window's rows come from its upper right corner, from right to left.
  const std::int32_t ac = 3 * grid.face0 + grid.edge0;
  window.run(prepared_, from_a ? adjacency().twin(ac) : ac, depth, [&](int row, const Double* strip) {
    const int step = row == 0 ? 1 : 2;  // those of the strip before are there
    for (int q = step - 1; q < 2 * size + 2; q += step) put(row + q % 2, size - q / 2, strip[q]);
  });
}

template class AloneEvaluator<CutGrids>;

}  // namespace limitcheck::fast::row_stream
