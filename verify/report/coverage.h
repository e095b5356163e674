// SPDX-License-Identifier: MIT
// The certificate of an audit: the kinds of neighbourhood that "held" is said of.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "verify/evidence/cells.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// What rows of a mesh at its depths are of.
inline Case case_of(const AuditMesh& m) {
  return {m.name, m.depth, m.depths, m.sample ? m.sample->text() : ""};
}

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

// What an audit on every neighbourhood up to a valence (limitcheck audit --exhaustive) has shown.

/// Of a subject and a scheme (data/generators/every_neighbourhood.h).
struct Exhaustive {
  std::string subject;
  data::Scheme scheme = data::Scheme::kLoop;
  int most = 0;                         // faces around a vertex
  std::int64_t neighbourhoods = 0;      // that there are ..
  std::int64_t looked = 0;              // .. in meshes whose points were judged at depths 0, 1 and 2
  std::int64_t cases = 0, wrong = 0;    // meshes at a depth, and those with findings
  std::vector<std::string> examples{};  // "star:3:w=J.e (depth 1, positions)": the shortest first
  bool all_right() const { return wrong == 0 && looked == neighbourhoods; }
};

/// By the names of the meshes that the rows are of; nothing if none is one of "neighbourhoods:..".
std::vector<Exhaustive> exhaustive_of(const std::vector<Result>& results);

/// A line for each: "Loop: right on every neighbourhood up to valence 6: 9120, at depths 0, 1 and 2".
std::string exhaustive_lines(const Report& report);

}  // namespace limitcheck::verify
