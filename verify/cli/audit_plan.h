// SPDX-License-Identifier: MIT
// `limitcheck audit`: what is to be done, for --resume and --shard.
#pragma once

#include <string>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/report/coverage.h"
#include "verify/row/result.h"
#include "verify/shard/journal.h"

namespace limitcheck::cli {

/// The plan of an audit: Auditor::run says which unit is what. Its text differs for other subjects, meshes,
/// options and versions; the header of the report is in it. The subjects of a mesh go together.
verify::Plan audit_plan(const std::vector<verify::AuditSubject>& subjects,
                        const std::vector<verify::AuditMesh>& meshes, const verify::Report& report,
                        const verify::CoverageQuestion& coverage, const std::string& level);

}  // namespace limitcheck::cli
