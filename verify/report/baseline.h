// SPDX-License-Identifier: MIT
// What changed since an earlier report: the way to live with findings that are known.
#pragma once

#include <string>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// Compares the rows of a report with those of an earlier one, `json` as --json writes it, row by row of the
/// same subject, mesh, depths and check, and fills in report.changes:
///   new     a finding or breakdown now; not one in the baseline, or not looked at there
///   worse   one in both, and now it breaks down, or its worst value or the share that is wrong is more than
///           kWorse times that of the baseline
///   gone    one in the baseline, and it held now
/// Throws data::ArgumentError: `json` is no report.
///   file   what the baseline is called
inline constexpr double kWorse = 1.1;
void compare_with_baseline(Report& report, const std::string& json, const std::string& file);

}  // namespace limitcheck::verify
