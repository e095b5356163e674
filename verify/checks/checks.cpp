// SPDX-License-Identifier: MIT
#include "verify/checks/checks.h"

namespace limitcheck::verify {

const std::vector<Check>& checks() {
  static const std::vector<Check> all{
      {"written", {"written"}, check_written, false},
      {"finite", {"finite"}, check_finite, false},
      {"positions", {"positions"}, check_positions, true},
      {"normals", {"normals", "normal-length"}, check_normals, true},
      {"normals-against-positions", {"normals-against-positions"}, check_normals_against_positions, true},
      {"orientation", {"orientation"}, check_orientation, true},
      {"coverage", {"coverage"}, check_coverage, false},
      {"shared", {"shared-positions", "shared-normals"}, check_shared, false},
      {"continuity", {"continuity"}, check_continuity, true},
      {"watertight", {"watertight", "t-vertices"}, check_watertight, false},
  };
  return all;
}

}  // namespace limitcheck::verify
