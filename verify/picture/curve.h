// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace limitcheck::verify {

/// y at x on the curve through points (x, y), both positive: straight lines between neighbours, in
/// logarithms. Nothing where x lies outside the points. Errors against triangles and triangles against errors
/// are read off so: what a strategy needs lies between two of its settings.
std::optional<double> on_curve(std::vector<std::pair<double, double>> points, double x);

}  // namespace limitcheck::verify
