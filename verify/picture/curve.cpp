// SPDX-License-Identifier: MIT
#include "verify/picture/curve.h"

#include <algorithm>
#include <cmath>

namespace limitcheck::verify {

std::optional<double> on_curve(std::vector<std::pair<double, double>> points, double x) {
  std::sort(points.begin(), points.end());
  for (std::size_t k = 1; k < points.size(); ++k) {
    const auto [x0, y0] = points[k - 1];
    const auto [x1, y1] = points[k];
    if (x < x0 || x > x1) continue;
    const double t = x1 > x0 ? std::log(x / x0) / std::log(x1 / x0) : 0;
    return y0 * std::pow(y1 / y0, t);
  }
  return {};
}

}  // namespace limitcheck::verify
