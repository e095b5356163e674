// SPDX-License-Identifier: MIT
#include "fast/stream/gather/rings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fast/mesh/box.h"
#include "fast/stream/gather/local_origin.h"
#include "fast/stream/gather/rings_impl.h"

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
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : triangles_of(mesh)) {
    const auto &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    const Vec3<double> e{q[0] - p[0], q[1] - p[1], q[2] - p[2]}, f{r[0] - p[0], r[1] - p[1], r[2] - p[2]},
        g = f - e;
    least = lesser_squared_height(e, f, dot(g, g), least);
  }
  placed.placement.local_from = local_origins_from(mesh.positions, least);
  return placed;
}

template PlacedPoints<float> place_points(std::span<const std::array<double, 3>>);
template PlacedPoints<double> place_points(std::span<const std::array<double, 3>>);
template PlacedPoints<float> place(const data::ControlMesh&);
template PlacedPoints<double> place(const data::ControlMesh&);
template class BasicRings<ScalarNumber<float>>;
template class BasicRings<ScalarNumber<double>>;

}  // namespace limitcheck::fast::row_stream
