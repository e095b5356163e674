// SPDX-License-Identifier: MIT
#include "fast/stream/local_origin.h"
#include "fast/stream/quad_rings_impl.h"

namespace limitcheck::fast::row_stream {

template <class T>
PlacedPoints<T> place(const QuadMesh& mesh) {
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  const QuadAdjacency& adjacency = mesh.adjacency;
  const auto halves = 2 * static_cast<std::size_t>(adjacency.face_count());
  placed.placement.local_from = local_origins_from(mesh.positions, halves, [&](std::size_t t) {
    const auto vertex = [&](std::int32_t v) {
      const auto& p = mesh.positions[v];
      return Vec3<double>{p[0], p[1], p[2]};
    };
    const auto h = static_cast<std::int32_t>(2 * t);  // at corners 0 and 2
    return std::array{vertex(adjacency.origin(h)), vertex(adjacency.target(h)),
                      vertex(adjacency.origin(QuadAdjacency::prev(h)))};
  });
  return placed;
}

template PlacedPoints<float> place(const QuadMesh&);
template PlacedPoints<double> place(const QuadMesh&);
template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
