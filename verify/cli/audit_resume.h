// SPDX-License-Identifier: MIT
// `limitcheck audit --resume`: the journal beside the report.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "verify/audit/audit_case.h"
#include "verify/audit/journal.h"
#include "verify/audit/result.h"

namespace limitcheck::cli {

/// The journal of an audit whose report is `json`: the same name with an l behind it. None if the report is
/// no file. Throws data::ArgumentError: `resume`, but there is nothing to resume, or it is of another
/// audit.
std::unique_ptr<verify::Journal> open_journal(const std::string& json, bool resume,
                                              const std::vector<verify::AuditSubject>& subjects,
                                              const std::vector<verify::AuditMesh>& meshes,
                                              const verify::Report& report, const std::string& level);

}  // namespace limitcheck::cli
