// SPDX-License-Identifier: MIT
// The report on one screen, and what it does not say: checks that looked at nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "verify/causes/causes.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// The checks that share a column of the overview.
struct CheckGroup {
  std::string_view title;
  std::vector<std::string_view> checks;
};
/// As the table of rows has them (row/rows.h).
const std::vector<CheckGroup>& check_groups();

/// How the rows of one subject in one group came out.
struct GroupVerdict {
  std::int64_t bad = 0, looked_at = 0;  // cases
  bool waived = false, stale = false, warning = false;

  /// "held", "3/126", "waived", "stale", "-".
  std::string text() const;
};
GroupVerdict verdict_of(const Report& report, const std::string& subject, const CheckGroup& group);

/// What the report is about, in one line: version, depths, meshes.
std::string header(const Report& report);
/// Waivers that were used, are stale, expired or cover nothing: a line each.
std::string waiver_lines(const Report& report);
/// What changed since the baseline, if there is one: counts, and the first of what is new, worse and gone.
std::string changes_line(const Report& report);
/// "38 held, 2 findings, ...": the last line of a report, with what was never judged or is incomplete.
std::string summary(const Report& report);
/// What the words of the tables mean.
std::string legend(bool plan);

/// Header, subjects x groups of checks (of one subject: its checks), root causes, summary. At most
/// kScreen lines as long as there are no more than 25 causes; the commands are left out where they would make
/// it longer.
///   scheme_line   as the commands say which scheme was taken
///   level         of the audit, for the commands
///   full          where the rest is, in one sentence
inline constexpr int kScreen = 50;
std::string to_overview(const Report& report, const std::vector<Cause>& causes, bool colour,
                        const std::string& scheme_line, const std::string& level, const std::string& full);

/// The causes in full: title, where to look, how often, what follows from it, the command.
std::string causes_in_full(const Report& report, const std::vector<Cause>& causes, const std::string& level);

struct Unjudged {
  std::string subject, check;
  std::string reason;      // the first that a row gives; may be empty
  bool not_asked = false;  // the row of the reason says that the subject is not asked

  /// "normals of cgal were never judged: it delivers none".
  std::string text() const;
};

/// For each subject those of `checks` that looked at nothing on any mesh.
std::vector<Unjudged> unjudged(const Report& report, const std::vector<std::string>& checks);

/// The same for positions (of the limit surface or of the refined mesh) and normals, of subjects that have
/// rows of these names, and for broken meshes, of subjects that are not asked because they do not validate;
/// rows of tessellation files have other names.
std::vector<Unjudged> unjudged(const Report& report);

}  // namespace limitcheck::verify
