// SPDX-License-Identifier: MIT
#pragma once

#include "data/control_mesh.h"
#include "verify/audit/result.h"

namespace limitcheck::verify {

/// Fills in the witness of a finding in positions or normals of limit points: the exact value to 40
/// significant digits, certified (reference/certified.h), and the command that repeats the finding.
///   mesh   rounded to the subject's precision
void add_digits(Result& result, const data::ControlMesh& mesh);

}  // namespace limitcheck::verify
