// SPDX-License-Identifier: MIT
#include <array>
#include <limits>

#include "fast/stream/gather/local_origin.h"
#include "fast/stream/gather/quad_rings_impl.h"

namespace limitcheck::fast::row_stream {

template <class T>
PlacedPoints<T> place(const QuadMesh& mesh) {
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  const QuadAdjacency& adjacency = mesh.adjacency;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    std::array<Vec3<double>, 4> side;
    for (int k = 0; k < 4; ++k) {
      const auto &p = mesh.positions[adjacency.corner(f, k)],
                 &q = mesh.positions[adjacency.corner(f, (k + 1) % 4)];
      side[k] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    }
    // At every corner: which is the first is a matter of writing.
    for (std::size_t k = 0; k < 4; ++k) least = lesser_squared_height(side[k], side[(k + 1) % 4], 0, least);
  }
  placed.placement.local_from = local_origins_from(mesh.positions, least);
  return placed;
}

template PlacedPoints<float> place(const QuadMesh&);
template PlacedPoints<double> place(const QuadMesh&);
template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
