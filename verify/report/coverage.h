// SPDX-License-Identifier: MIT
// The certificate of an audit: the kinds of neighbourhood that "held" is said of.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "verify/evidence/cells.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// What a subject declares for a scheme: LC_SHARP_.. and kNeeds.. (cells.h).
struct Declared {
  std::string subject;
  data::Scheme scheme = data::Scheme::kLoop;
  std::int32_t abilities = 0;
  int max_depth = 0;
};
struct CoverageQuestion {
  std::vector<CaseCells> cases;
  std::vector<Declared> declared;
};

/// `cases` has one entry for each mesh; a subject that cannot be asked declares nothing.
CoverageQuestion coverage_question(const std::vector<AuditSubject>& subjects,
                                   const std::vector<AuditMesh>& meshes);
/// For the parts of a report that is made in many processes.
nlohmann::json coverage_json(const CoverageQuestion& question);
CoverageQuestion coverage_question(const nlohmann::json& json);

/// Fills in `cases` and `coverage` of a report with all its rows.
void add_coverage(Report& report, CoverageQuestion question);
/// For each subject, and scheme that a case is of: a cell counts as looked at where positions were judged.
std::vector<Coverage> coverage_of(const std::vector<Result>& results, const CoverageQuestion& question);

/// "Loop: 2229 of 2229 kinds of neighbourhood", with what was never looked at and how much is not declared;
/// of several subjects the least. One line for each scheme.
std::string coverage_lines(const Report& report);

}  // namespace limitcheck::verify
