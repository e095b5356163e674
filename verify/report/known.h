// SPDX-License-Identifier: MIT
// Findings that are known: accepted for a while, or there in an earlier audit.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

struct Waiver {
  std::string subject;          // name or name:options; * and ? as in a shell
  std::string from, before;     // versions from <= version < before, "3.5"; empty: any
  std::string check;            // row; * and ?
  std::string shape;            // mesh; * and ?
  std::optional<double> bound;  // the worst value may not exceed it, in the check's unit
  std::string reason, link;
  std::string expires;  // "2027-01-31": the last day it is good for
};

/// {"waivers": [{"subject", "versions": {"from", "before"}, "check", "shape", "bound", "reason", "link",
/// "expires"}]}; subject, check, reason and expires are required. Throws data::ArgumentError and says which
/// waiver and what.
std::vector<Waiver> parse_waivers(const std::string& json);

/// Turns findings and breakdowns that a waiver covers into kWaived. A waiver all of whose rows hold turns them into
/// kUnexpectedPass. One that is expired, or covers no row, adds a row `waiver` of status kQualityWarning.
///   versions  of each subject of the report, by its label; where there is none, only waivers without a range
///   today     "2026-11-21"
void apply_waivers(Report& report, const std::vector<Waiver>& waivers,
                   const std::map<std::string, std::string>& versions, const std::string& today);

/// The first number with a point in a description: "OpenSubdiv
/// 3.5 Far: ..." gives "3.5"; "" if there is none.
std::string version_in(const std::string& description);

/// A finding is worse if its worst value, or how often it shows, is more than so many times that of the baseline.
inline constexpr double kWorse = 1.1;

/// The rows of a report that --json has written. Throws data::ArgumentError: `text` is none.
///   file   what it is called
std::vector<Result> reported_rows(const std::string& text, const std::string& file);

/// Compares a report with that of an earlier audit, and fills in report.changes. Of the report as --json writes it, row by
/// row of the same subject, mesh, depths and check; of a text by to_baseline(), by subject and check, unless
/// it is of another device (Report::devices):
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
