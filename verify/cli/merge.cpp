// SPDX-License-Identifier: MIT
#include "verify/cli/merge.h"

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/untrusted_json.h"
#include "verify/cli/commands.h"
#include "verify/hunt/hunt_report.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

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
  for (const auto& [option, given] : {std::pair{"--require", !a.report.required.empty()},
                                      std::pair{"--require-coverage", a.report.require_coverage},
                                      std::pair{"--waivers", !a.report.waivers.empty()},
                                      std::pair{"--baseline", !a.report.baseline.empty() && !of_hunt},
                                      std::pair{"--junit", !a.report.junit.empty() && !of_hunt}})
    if (given) throw data::ArgumentError(fmt::format("{} is not for parts of {}", option, program));
}

int merge_hunt(const MergeArguments& a) {
  std::vector<verify::HuntReport> parts;
  for (const std::string& file : a.parts) parts.push_back(read_file(file, verify::read_hunt_report));
  std::optional<verify::HuntReport> earlier;
  if (!a.report.baseline.empty()) earlier = read_file(a.report.baseline, verify::read_hunt_report);
  const verify::HuntReport* const before = earlier ? &*earlier : nullptr;
  const verify::HuntReport whole = verify::merged(parts);
  verify::write_text(a.output, verify::to_json(whole));
  if (!a.report.junit.empty()) verify::write_text(a.report.junit, verify::to_junit(whole, before));
  fmt::print("{}", verify::to_text(whole, before));
  return verify::new_findings(whole, before).empty() ? kHeld : kFindings;
}

int merge(const MergeArguments& a) {
  refuse_one_file_for_two({{"-o", a.output}, {"--junit", a.report.junit}, {"--baseline", a.report.baseline}});
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
  if (program == "limitcheck mutants") return merge_mutants(whole, a);
  if (program == "limitcheck prove") return merge_prove(whole, a);
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
  add_report_options(*command, a->report);
  command->footer(
      "Exit codes: as of the command whose parts they are; 2 if a part is missing, there twice, incomplete "
      "or "
      "of another plan.");
  command->callback([a, &exit_code] { exit_code = merge(*a); });
}

}  // namespace limitcheck::cli
