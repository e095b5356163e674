// SPDX-License-Identifier: MIT
// What is new, worse and gone since an earlier audit.
#pragma once

#include <string>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// A finding is worse if its worst value, or how often it shows, is more than so many times that of the baseline.
inline constexpr double kWorse = 1.1;

/// The rows of a report that --json has written. Throws data::ArgumentError: `text` is none.
///   file   what it is called
std::vector<Result> reported_rows(const std::string& text, const std::string& file);

/// Compares a report with that of an earlier audit, and fills in report.changes. Of the report as --json writes it, row by
/// row of the same subject, mesh, depths and check; of a text by to_baseline(), by subject and check:
///   new     a finding or breakdown now; not one in the baseline, or not looked at there
///   worse   one in both, and now it breaks down, or its worst value or the share that is wrong, of a text the
///           number of cases, is more than kWorse times that of the baseline
///   gone    one in the baseline, and it held now
/// Throws data::ArgumentError: `text` is neither.
///   file   what the baseline is called
void compare_with_baseline(Report& report, const std::string& text, const std::string& file);

/// What is wrong in a report, as a text that is small, and that changes in few lines: for each subject and check in how
/// many cases, and the worst value.
std::string to_baseline(const Report& report);

}  // namespace limitcheck::verify
