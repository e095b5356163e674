// SPDX-License-Identifier: MIT
// Whether an audit fits into the memory of this machine.
#pragma once

#include "verify/evidence/audit_case.h"

namespace limitcheck::cli {

/// Throws data::ArgumentError if the points that the audit looks at take more memory than the machine has:
/// hours of swapping would end without a report.
///   mesh  with a depth of its own
void refuse_too_many_points(const verify::AuditMesh& mesh);

}  // namespace limitcheck::cli
