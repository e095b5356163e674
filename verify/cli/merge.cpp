// SPDX-License-Identifier: MIT
// limitcheck merge: the parts that --shard has made, as one process would have reported them.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "data/untrusted_json.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/hunt/hunt_report.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string output, verify;
  ReportOptions options;  // --junit, --baseline, and of an audit --require and --waivers
};

std::string program_of(const std::string& text) {
  const nlohmann::json json = data::parse_untrusted(text);
  if (!json.is_object() || !json.contains("program") || !json["program"].is_string())
    throw data::ArgumentError("this is no report of limitcheck");
  return json["program"].get<std::string>();
}

int merge_audit(const verify::PartReport& whole, const MergeArguments& a) {
  const nlohmann::json& plan = whole.plan.what;
  require_units(plan, whole.results);
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
  report.devices = whole.devices;
  report.receipts = verify::receipts_of(whole.receipts);
  report.printed = whole.printed;
  if (!report.looked()) report.incomplete = nothing_looked_at(plan.at("polygons").get<bool>());

  const bool judged = settle(a.options, report);
  write_forms(a.options, report, level);
  verify::write_text(a.output, attested(verify::to_json(report, level, a.options.all_rows), plan));
  say_report(a.options, report, [&](const verify::Report& shown, const verify::Screen& screen) {
    return verify::to_overview(shown, verify::causes(shown), screen, "", level, "");
  });
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
  say("{}", verify::to_text(whole, before));
  return verify::new_findings(whole, before).empty() ? kHeld : kFindings;
}

// Why a report is not whole or not as it was written; empty: it is both.
std::string why_not(const nlohmann::json& report) try {
  if (report.contains("together")) {
    const verify::PartReport part = verify::read_part(verify::sealed(report));
    if (!part.is_complete() || !part.incomplete.empty()) return "it is a part that is incomplete";
    if (part.plan.program == "limitcheck audit") require_units(part.plan.what, part.results);
    return "";
  }
  const nlohmann::json incomplete = report.value("incomplete", nlohmann::json());
  if (incomplete.is_string() && incomplete != "") return "it is incomplete: " + incomplete.get<std::string>();
  if (report.contains("complete") && report.at("complete") != true) return "it is incomplete";
  if (report.at("program") != "limitcheck audit") return "";
  for (const nlohmann::json& subject : report.at("subjects"))
    if (std::none_of(report.at("results").begin(), report.at("results").end(),
                     [&](const auto& row) { return row.at("subject") == subject; }))
      return fmt::format("it has no row of {}", subject.get<std::string>());
  for (const nlohmann::json& row : report.at("results")) {
    if (!row.at("status").is_string() || !row.at("count").is_number_integer() ||
        !row.at("of").is_number_integer())
      return "it is no report: a row has no status, count or of";
    for (const char* const number : {"worst", "bound"})
      if (const nlohmann::json& x = row.at(number); !x.is_number() && !x.is_string() && !x.is_null())
        return fmt::format("it is no report: {} is no number", number);
    const verify::Result r = verify::reported_row(row);
    if (verify::verdict_of(r) != r.status)
      return fmt::format("{} of {} on {} says {}, and its numbers say {}", r.check, r.subject, r.mesh,
                         verify::word(r.status), verify::word(verify::verdict_of(r)));
  }
  return "";
} catch (const nlohmann::json::exception& error) {
  return fmt::format("it is no report: {}", error.what());
} catch (const data::ArgumentError& error) {
  return error.what();
}

// limitcheck merge --verify REPORT
int verify_report(const std::string& file) {
  const std::string text = data::io::whole_content(file);
  const std::string program = read_file(file, program_of);
  nlohmann::json report = data::parse_untrusted(text);
  if (!report.contains("digest"))
    throw data::ArgumentError(file +
                              ": it carries no digest, as reports do since 0.2: nothing can be said of it");
  std::string why;
  try {
    report = verify::unsealed_object(std::move(report));
    why = why_not(report);
  } catch (const data::ArgumentError& error) {
    why = error.what();
  }
  if (!why.empty()) {
    say("{}: {}\n", file, why);
    return kFindings;
  }
  const nlohmann::json by = report.value("attested", nlohmann::json());
  const std::string by_program = by.is_object() ? by.value("program", "") : "";
  say("{}: whole and as it was written, by {}{}\n", file, program,
      by_program.empty() ? ""
      : by_program == file_digest("/proc/self/exe") || by_program == file_digest(find_program("prove"))
          ? " of this program"
          : fmt::format(" of another program ({})", by_program));
  return kHeld;
}

int merge(const CLI::App& command, const MergeArguments& a) {
  if (!a.verify.empty()) {
    if (!a.parts.empty() || !a.output.empty())
      throw data::ArgumentError("--verify takes a report, and no parts");
    return verify_report(a.verify);
  }
  if (a.parts.empty()) throw CLI::RequiredError("PART");
  if (a.output.empty()) throw CLI::RequiredError("--output");
  refuse_one_file_for_two({{"-o", a.output}, {"--baseline", a.options.baseline}}, a.options);
  const std::string program = read_file(a.parts.at(0), program_of);
  const std::string why = "is not for parts of " + program;
  if (program != "limitcheck audit")
    refuse(command,
           {"--require", "--require-coverage", "--all-rows", "--sarif", "--markdown", "--waivers",
            "--save-baseline"},
           why);
  if (program == "limitcheck hunt") return merge_hunt(a);
  std::vector<verify::PartReport> parts;
  for (const std::string& file : a.parts) parts.push_back(read_file(file, verify::read_part));
  const verify::PartReport whole = verify::joined(parts);
  if (program == "limitcheck audit") return merge_audit(whole, a);
  refuse(command, {"--baseline", "--junit"}, why);
  if (program == "limitcheck mutants") return report_mutants(whole, a.output);
  if (program == "limitcheck prove") {
    std::vector<std::string> words{"prove", "--json", a.output, "--parts"};
    words.insert(words.end(), a.parts.begin(), a.parts.end());
    return hand_over("prove", words);
  }
  throw data::ArgumentError(fmt::format("{}: parts of {} are unknown here", a.parts[0], program));
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand(
      "merge",
      "Join what --shard has made: the parts of an audit, a hunt, a table of mutants, a set of proofs");
  command->add_option("PART", a->parts, "The files that --shard K/N --json FILE has written, in any order");
  command->add_option("-o,--output", a->output, "The report of the whole, as one process writes it");
  add_value(*command, "--verify", a->verify, "REPORT",
            "Say whether this report, or part of one, is whole and as it was written; nothing else is done");
  add_report_options(*command, a->options);
  command->footer(
      "Exit codes: as of the command whose parts they are; 2 if a part is missing, there twice, incomplete "
      "or of another plan.");
  command->callback([=, &exit_code] { exit_code = merge(*command, *a); });
}

}  // namespace limitcheck::cli
