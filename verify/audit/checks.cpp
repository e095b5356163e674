// SPDX-License-Identifier: MIT
#include "verify/audit/checks.h"

namespace limitcheck::verify {

const std::vector<Check>& checks() {
  static const std::vector<Check> all{
      {"written", {"written"}, check_written, false},
      {"finite", {"finite"}, check_finite, false},
      {"positions", {"positions"}, check_positions, true},
      {"normals", {"normals", "normal-length"}, check_normals, true},
      {"orientation", {"orientation"}, check_orientation, true},
      {"coverage", {"coverage"}, check_coverage, false},
      {"shared", {"shared-positions", "shared-normals"}, check_shared, false},
      {"watertight", {"watertight", "t-vertices"}, check_watertight, false},
  };
  return all;
}

}  // namespace limitcheck::verify
