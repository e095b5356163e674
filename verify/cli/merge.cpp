// SPDX-License-Identifier: MIT
// limitcheck merge: the parts that --shard has made, as one process would have reported them.
#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/untrusted_json.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/cli/units.h"
#include "verify/hunt/hunt_report.h"
#include "verify/report/coverage.h"
#include "verify/report/json.h"
#include "verify/report/junit.h"
#include "verify/report/overview.h"

namespace limitcheck::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output;
  ReportOptions options;  // --junit, --baseline, and of an audit --require and --waivers
};

// read(text) of a file; what is wrong with it is said with its name.
template <class Read>
auto read_file(const std::string& file, const Read& read) try {
  return read(data::io::whole_content(file));
} catch (const data::ArgumentError& error) {
  throw data::ArgumentError(fmt::format("{}: {}", file, error.what()));
}

std::string program_of(const std::string& text) {
  const nlohmann::json json = data::parse_untrusted(text);
  if (!json.is_object() || !json.contains("program") || !json["program"].is_string())
    throw data::ArgumentError("this is no report of limitcheck");
  return json["program"].get<std::string>();
}

void refuse(const MergeArguments& a, const std::string& program, bool of_hunt) {
  for (const auto& [option, given] : {std::pair{"--require", !a.options.required.empty()},
                                      std::pair{"--require-coverage", a.options.require_coverage},
                                      std::pair{"--waivers", !a.options.waivers.empty()},
                                      std::pair{"--baseline", !a.options.baseline.empty() && !of_hunt},
                                      std::pair{"--junit", !a.options.junit.empty() && !of_hunt}})
    if (given) throw data::ArgumentError(fmt::format("{} is not for parts of {}", option, program));
}

int merge_audit(const verify::PartReport& whole, const MergeArguments& a) {
  const nlohmann::json& plan = whole.plan.what;
  const auto level = plan.at("level").get<std::string>();
  verify::Report report = verify::header_of(plan.at("report"));
  const std::size_t subjects = whole.plan.together;
  for (std::size_t s = 0; s < subjects; ++s)
    for (std::size_t unit = s; unit < whole.plan.units; unit += subjects)
      for (verify::Result& row : verify::rows_of(whole.results.at(unit)))
        report.results.push_back(std::move(row));
  verify::add_coverage(report, verify::coverage_question(plan.at("coverage")));
  report.seconds = whole.seconds;
  report.containment = whole.containment;
  report.printed = whole.printed;
  if (!report.looked()) report.incomplete = nothing_looked_at(plan.at("polygons").get<bool>());

  const bool judged = settle(a.options, report);
  if (!a.options.junit.empty()) verify::write_text(a.options.junit, verify::to_junit(report));
  verify::write_text(a.output, verify::to_json(report, level));
  fmt::print("{}", verify::to_overview(report, verify::causes(report), in_colour(), "", level, ""));
  return exit_code_of(report, judged);
}

int merge_hunt(const MergeArguments& a) {
  std::vector<verify::HuntReport> parts;
  for (const std::string& file : a.parts) parts.push_back(read_file(file, verify::read_hunt_report));
  std::optional<verify::HuntReport> earlier;
  if (!a.options.baseline.empty()) earlier = read_file(a.options.baseline, verify::read_hunt_report);
  const verify::HuntReport* const before = earlier ? &*earlier : nullptr;
  const verify::HuntReport whole = verify::merged(parts);
  verify::write_text(a.output, verify::to_json(whole));
  if (!a.options.junit.empty()) verify::write_text(a.options.junit, verify::to_junit(whole, before));
  fmt::print("{}", verify::to_text(whole, before));
  return verify::new_findings(whole, before).empty() ? kHeld : kFindings;
}

int merge(const MergeArguments& a) {
  refuse_one_file_for_two(
      {{"-o", a.output}, {"--junit", a.options.junit}, {"--baseline", a.options.baseline}});
  const std::string program = read_file(a.parts.at(0), program_of);
  if (program == "limitcheck hunt") {
    refuse(a, program, true);
    return merge_hunt(a);
  }
  std::vector<verify::PartReport> parts;
  for (const std::string& file : a.parts) parts.push_back(read_file(file, verify::read_part));
  const verify::PartReport whole = verify::joined(parts);
  if (program == "limitcheck audit") return merge_audit(whole, a);
  refuse(a, program, false);
  if (program == "limitcheck mutants") return report_mutants(whole, a.output);
  if (program == "limitcheck prove") return report_proofs(whole, a.output, false);
  throw data::ArgumentError(fmt::format("{}: parts of {} are unknown here", a.parts[0], program));
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand(
      "merge",
      "Join what --shard has made: the parts of an audit, a hunt, a table of mutants, a set of proofs");
  command->add_option("PART", a->parts, "The files that --shard K/N --json FILE has written, in any order")
      ->required();
  command->add_option("-o,--output", a->output, "The report of the whole, as one process writes it")
      ->required();
  add_report_options(*command, a->options);
  command->footer(
      "Exit codes: as of the command whose parts they are; 2 if a part is missing, there twice, incomplete "
      "or of another plan.");
  command->callback([a, &exit_code] { exit_code = merge(*a); });
}

}  // namespace limitcheck::cli
