// SPDX-License-Identifier: MIT
#include "fast/row_stream/rings.h"

#include <algorithm>
#include <cmath>

#include "fast/row_stream/rings_impl.h"

namespace limitcheck::fast::row_stream {

template <class T>
PlacedPoints<T> place(const data::ControlMesh& mesh) {
  PlacedPoints<T> placed{{}, Placement<T>::identity()};
  if (mesh.positions.empty()) return placed;
  std::array<double, 3> low = mesh.positions[0], high = low;
  for (const auto& p : mesh.positions) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  }
  double extent = 0, unit = 1;
  for (std::size_t c = 0; c < 3; ++c) extent = std::max(extent, high[c] - low[c]);
  std::array<double, 3> centre{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double middle = low[c] / 2 + high[c] / 2;
    if (std::abs(middle) > extent / 4) centre[c] = static_cast<float>(middle);
  }
  if (extent > 0 && std::isfinite(extent)) unit = std::ldexp(1., std::clamp(std::ilogb(extent), -120, 120));

  const double inverse = 1 / unit;
  placed.points.reserve(mesh.positions.size());
  for (const auto& p : mesh.positions) {
    placed.points.push_back({static_cast<T>((p[0] - centre[0]) * inverse),
                             static_cast<T>((p[1] - centre[1]) * inverse),
                             static_cast<T>((p[2] - centre[2]) * inverse), T(0)});
  }
  placed.placement = {{static_cast<T>(centre[0]), static_cast<T>(centre[1]), static_cast<T>(centre[2])},
                      static_cast<T>(unit)};
  return placed;
}

template PlacedPoints<float> place(const data::ControlMesh&);
template PlacedPoints<double> place(const data::ControlMesh&);
template class BasicRings<ScalarNumber<float>>;
template class BasicRings<ScalarNumber<double>>;

}  // namespace limitcheck::fast::row_stream
