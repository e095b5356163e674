// SPDX-License-Identifier: MIT
#include "fast/stream/rings.h"

#include <algorithm>
#include <cmath>

#include "fast/mesh/box.h"
#include "fast/stream/local_origin.h"
#include "fast/stream/rings_impl.h"

namespace limitcheck::fast::row_stream {

template <class T>
PlacedPoints<T> place_points(std::span<const std::array<double, 3>> positions) {
  PlacedPoints<T> placed{{}, KernelPlacement<T>{}};
  if (positions.empty()) return placed;
  const Box box(positions);
  const double extent = box.size();
  std::array<double, 3> centre{};
  for (std::size_t c = 0; c < 3; ++c)
    if (std::abs(box.middle(c)) > extent / 4) centre[c] = static_cast<float>(box.middle(c));
  double unit = 1;
  if (extent > 0 && std::isfinite(extent)) unit = std::ldexp(1., std::clamp(std::ilogb(extent), -120, 120));

  const double inverse = 1 / unit;
  placed.points.reserve(positions.size());
  for (const auto& p : positions) {
    placed.points.push_back({static_cast<T>((p[0] - centre[0]) * inverse),
                             static_cast<T>((p[1] - centre[1]) * inverse),
                             static_cast<T>((p[2] - centre[2]) * inverse), T(0)});
  }
  placed.placement = {{{static_cast<T>(centre[0]), static_cast<T>(centre[1]), static_cast<T>(centre[2])},
                       static_cast<T>(unit)},
                      kLocalFrom};
  return placed;
}

template <class T>
PlacedPoints<T> place(const data::ControlMesh& mesh) {
  PlacedPoints<T> placed = place_points<T>(mesh.positions);
  const data::Triangles triangles = triangles_of(mesh);
  placed.placement.local_from = local_origins_from(mesh.positions, triangles.size(), [&](std::size_t t) {
    const auto vertex = [&](std::size_t k) {
      const auto& p = mesh.positions[triangles[t][k]];
      return Vec3<double>{p[0], p[1], p[2]};
    };
    return std::array{vertex(0), vertex(1), vertex(2)};
  });
  return placed;
}

template PlacedPoints<float> place_points(std::span<const std::array<double, 3>>);
template PlacedPoints<double> place_points(std::span<const std::array<double, 3>>);
template PlacedPoints<float> place(const data::ControlMesh&);
template PlacedPoints<double> place(const data::ControlMesh&);
template class BasicRings<ScalarNumber<float>>;
template class BasicRings<ScalarNumber<double>>;

}  // namespace limitcheck::fast::row_stream
