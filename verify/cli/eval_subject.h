// SPDX-License-Identifier: MIT
// `limitcheck eval --subject`: what a subject delivers at a point, beside the exact surface there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reference/point/parameter.h"
#include "verify/cli/mesh_options.h"

namespace limitcheck::cli {

struct SubjectAtPoint {
  std::string subject, mesh;
  int depth = 4;
  std::string depths = "uniform";
  std::int64_t face = 0;
  std::optional<int> corner;
  std::string scheme_line;
};

/// Prints both, and how far they are apart. Returns the exit code: 1 if a vertex is beyond its bounds or not
/// finite, or if vertices that should be equal have other bits. Throws data::ArgumentError: there is no such
/// subject, or the point is no lattice point of the depth.
int show_difference(const SubjectAtPoint& request, const OpenedMesh& opened, const reference::Parameter& u,
                    const reference::Parameter& v);

}  // namespace limitcheck::cli
