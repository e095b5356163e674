// SPDX-License-Identifier: MIT
#include "verify/causes/causes.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <tuple>

#include "verify/causes/cause_sorting.h"
#include "verify/causes/cause_words.h"
#include "verify/row/reproduce.h"

namespace limitcheck::verify {
namespace {

// Pairs of subject and case among rows.
std::int64_t count_cases(const Report& report, const std::vector<std::size_t>& rows) {
  std::set<std::tuple<std::string, std::string, int, std::string, std::string>> cases;
  for (const std::size_t k : rows) {
    const Result& r = report.results[k];
    cases.emplace(r.subject, r.mesh, r.depth, r.depths, r.sample);
  }
  return static_cast<std::int64_t>(cases.size());
}

std::int64_t faces_of(const Report& report, const Result& r) {
  for (const auto& m : report.meshes)
    if (m.name == r.mesh) return m.faces;
  return 0;
}

void complete(const Report& report, Cause& cause) {
  std::set<std::string> subjects, checks, consequences;
  for (const std::size_t k : cause.rows) subjects.insert(report.results[k].subject);
  for (const std::size_t k : cause.direct) checks.insert(report.results[k].check);
  for (const std::size_t k : cause.rows)
    if (!checks.contains(report.results[k].check)) consequences.insert(report.results[k].check);
  for (const std::string& s : report.subjects)
    if (subjects.contains(s)) cause.subjects.push_back(s);
  cause.consequences.assign(consequences.begin(), consequences.end());
  if (cause.direct.empty()) cause.direct = cause.rows;

  // The smallest mesh; a row whose point can be shown rather than another one.
  const auto rank = [&](std::size_t k) {
    const Result& r = report.results[k];
    return std::tuple(!r.sample.empty(), difference_command(r).empty(), faces_of(report, r), r.depth, k);
  };
  cause.example = *std::min_element(cause.direct.begin(), cause.direct.end(),
                                    [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });

  cause.cases = count_cases(report, cause.direct);
  std::vector<std::size_t> looked;
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const Result& r = report.results[k];
    if (subjects.contains(r.subject) && (checks.empty() || checks.contains(r.check)) &&
        r.status != Status::kNotRun && r.status != Status::kNotSupported)
      looked.push_back(k);
  }
  cause.of = count_cases(report, looked);
  cause.share = 2 * cause.cases >= cause.of ? 3 : 10 * cause.cases >= cause.of ? 2 : 1;
}

}  // namespace

std::string_view word(CauseKind kind) {
  switch (kind) {
    case CauseKind::kBreakdown:
      return "breakdown";
    case CauseKind::kRefuses:
      return "refuses";
    case CauseKind::kUnwritten:
      return "unwritten";
    case CauseKind::kNotFinite:
      return "not-finite";
    case CauseKind::kSurface:
      return "surface";
    case CauseKind::kTiling:
      return "tiling";
    case CauseKind::kSeams:
      return "seams";
    case CauseKind::kOrder:
      return "order";
    case CauseKind::kAccepts:
      return "accepts";
    case CauseKind::kOther:
      return "other";
  }
  return "other";
}

std::string_view Cause::severity() const {
  const int product = size * share;
  return product >= 6 ? "high" : product >= 3 ? "medium" : "low";
}

std::vector<Cause> causes(const Report& report) {
  std::vector<Cause> all = sorted_into_causes(report);
  for (Cause& cause : all) {
    complete(report, cause);
    put_in_words(report, cause);
  }
  const auto rank = [](const Cause& c) { return std::tuple(c.size * c.share, c.size, c.cases); };
  std::stable_sort(all.begin(), all.end(), [&](const Cause& a, const Cause& b) { return rank(a) > rank(b); });
  return all;
}

std::string command_for(const Report& report, const Cause& cause, const std::string& level) {
  const Result& r = report.results[cause.example];
  if (report.depths == "file") return "";
  if (const std::string command = difference_command(r); !command.empty()) return command;
  return audit_command(r, level) + " --details";
}

}  // namespace limitcheck::verify
