// SPDX-License-Identifier: MIT
#include "fast/stream/gather/alone.h"

namespace limitcheck::fast::row_stream {

GridEdges::GridEdges(std::int32_t quad, Order order) : from_a(order == Order::kFromA), of{} {
  of.back() = -1;
  for (std::int32_t k = 0; k < 4; ++k)
    of[static_cast<std::size_t>(k)] = 4 * quad + (k + static_cast<int>(order)) % 4;
}

SemiSharpQuads::SemiSharpQuads(const QuadMesh& mesh) : prepared_(mesh, positions_of<double>(mesh)) {}

// The window's rows come from its top, where its third and fourth corners are.
template <class Put>
void SemiSharpQuads::run(Window& window, std::int32_t quad, int depth, Order order, Put&& put) const {
  const int size = 1 << depth;
  window.run_from(prepared_, 4 * quad + (static_cast<int>(order) + 2) % 4, depth,
                  [&](int row, const SurfaceVertex<double>* strip) {
                    const int step = row == 0 ? 1 : 2;
                    for (int q = step - 1; q < 2 * size + 2; q += step)
                      put(row + q % 2, size - q / 2, strip[q]);
                  });
}

template class AloneEvaluator<SemiSharpQuads>;

}  // namespace limitcheck::fast::row_stream
