// SPDX-License-Identifier: MIT
// Findings that are known and accepted for a while.
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

}  // namespace limitcheck::verify
