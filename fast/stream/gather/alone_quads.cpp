// SPDX-License-Identifier: MIT
#include "fast/stream/gather/alone.h"

namespace limitcheck::fast::row_stream {

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
