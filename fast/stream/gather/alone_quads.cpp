// SPDX-License-Identifier: MIT
#include <cstddef>

#include "fast/stream/gather/alone_impl.h"

namespace limitcheck::fast::row_stream {

namespace {

std::vector<Vec3<double>> points_of(const QuadMesh& mesh) {
  std::vector<Vec3<double>> points;
  points.reserve(mesh.positions.size());
  for (const auto& p : mesh.positions) points.push_back(to_point(p));
  return points;
}

}  // namespace

GridEdges::GridEdges(std::int32_t quad, Order order) : from_a(order == Order::kFromA), of{} {
  of.back() = -1;
  for (std::int32_t k = 0; k < 4; ++k)
    of[static_cast<std::size_t>(k)] = 4 * quad + (k + static_cast<int>(order)) % 4;
}

SemiSharpQuads::SemiSharpQuads(const QuadMesh& mesh) : prepared_(mesh, points_of(mesh)) {}

// The window's rows come from its top, where its third and fourth corners are.
template <class Put>
void SemiSharpQuads::rows(Window& window, std::int32_t quad, int depth, Order order, Put&& put) const {
  using Double = SurfaceVertex<double>;
  const int size = 1 << depth;
  window.run_from(prepared_, 4 * quad + (static_cast<int>(order) + 2) % 4, depth,
                  [&](int row, const Double* strip) {
                    for (int j = row == 0 ? 0 : row + 1; j <= row + 1; ++j)
                      put(j, [&](int i) -> const Double& { return strip[2 * (size - i) + (j - row)]; });
                  });
}

template class AloneEvaluator<SemiSharpQuads>;

}  // namespace limitcheck::fast::row_stream
