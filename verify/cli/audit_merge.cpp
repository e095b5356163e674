// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>

#include "verify/cli/merge.h"
#include "verify/report/coverage.h"
#include "verify/report/json.h"
#include "verify/report/overview.h"
#include "verify/report/result_json.h"

namespace limitcheck::cli {

int merge_audit(const verify::PartReport& whole, const MergeArguments& a) {
  const nlohmann::json& plan = whole.plan.what;
  const auto level = plan.at("level").get<std::string>();
  verify::Report report = verify::header_of(plan.at("report"));
  const std::size_t subjects = whole.plan.together;
  for (std::size_t s = 0; s < subjects; ++s)
    for (std::size_t unit = s; unit < whole.plan.units; unit += subjects)
      for (verify::Result& row : verify::rows_of(whole.results.at(unit)))
        report.results.push_back(std::move(row));
  report.coverage = verify::coverage_of(report.results, verify::coverage_question(plan.at("coverage")));
  report.seconds = whole.seconds;
  report.containment = whole.containment;
  report.printed = whole.printed;
  if (!report.looked()) report.incomplete = nothing_looked_at(plan.at("polygons").get<bool>());

  const bool judged = judged_as_required(a.report, report);
  waive(a.report, report);
  compare(a.report, report);
  write_junit(a.report, report);
  verify::write_text(a.output, verify::to_json(report, level));
  const bool colour = isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
  fmt::print("{}", verify::to_overview(report, verify::causes(report), colour, "", level, ""));
  return exit_code_of(report, judged);
}

}  // namespace limitcheck::cli
