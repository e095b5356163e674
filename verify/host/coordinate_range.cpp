// SPDX-License-Identifier: MIT
#include "verify/host/coordinate_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "data/error.h"

namespace limitcheck::verify {

std::string out_of_range(const data::ControlMesh& mesh, bool double_precision) {
  const double most = std::ldexp(1.0, double_precision ? 240 : 100);
  double largest = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  if (largest == 0 || (largest >= 1 / most && largest <= most)) return {};
  return fmt::format(
      "the largest coordinate is {:.2g}: with {} it has to be between {:.2g} and {:.2g}; scale the mesh",
      largest, double_precision ? "double precision" : "single precision", 1 / most, most);
}

void require_range(const std::string& name, const data::ControlMesh& mesh, bool double_precision) {
  const std::string reason = out_of_range(mesh, double_precision);
  if (!reason.empty()) throw data::ArgumentError(name + ": " + reason);
}

}  // namespace limitcheck::verify
