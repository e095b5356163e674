// SPDX-License-Identifier: MIT
// Whether this machine can hold what comes of an audit.
#pragma once

#include "verify/audit/audit_case.h"

namespace limitcheck::cli {

/// Throws std::invalid_argument if the points that the audit looks at take more memory than the machine has:
/// hours of swapping would end without a report.
///   mesh  with a depth of its own
void refuse_too_many_points(const verify::AuditMesh& mesh);

}  // namespace limitcheck::cli
