// SPDX-License-Identifier: MIT
// What `limitcheck eval` prints about a point.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/surface/certified.h"
#include "verify/cli/mesh_options.h"

namespace limitcheck::cli {

/// Which point was evaluated, as the user meant it.
struct EvaluatedPoint {
  std::string mesh, scheme_line;
  MeshScheme chosen;
  std::string weights;  // "loop", "warren"
  std::int64_t face = 0;
  std::optional<int> corner;            // Catmull-Clark, of a face that is no quad
  std::vector<std::string> parameters;  // exact: l0, l1, l2 of Loop's scheme, u, v of Catmull-Clark's
  int digits = 16;
};

void print_json(const EvaluatedPoint& at, const reference::CertifiedPoint& point);
void print_text(const EvaluatedPoint& at, const reference::CertifiedPoint& point);

}  // namespace limitcheck::cli
