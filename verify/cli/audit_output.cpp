// SPDX-License-Identifier: MIT
// `limitcheck audit`: the options for how much is checked, what is waived, and where the results go besides the table.
#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "verify/audit/shrink.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/json.h"
#include "verify/report/known.h"
#include "verify/row/rows.h"
#include "verify/row/visible_text.h"

namespace limitcheck::cli {

void add_report_options(CLI::App& command, ReportOptions& a) {
  std::vector<std::string> checks;
  for (const auto& e : verify::row_kinds()) checks.emplace_back(e.check);
  command
      .add_option("--require", a.required,
                  "Checks, separated by commas, that must have judged something of each subject; otherwise "
                  "nothing is confirmed (exit code 2)")
      ->delimiter(',')
      ->check(CLI::IsMember(checks).description(""))  // --explain all lists them
      ->transform([](const std::string& check) { return std::string(verify::current_name(check)); })
      ->type_name("CHECK,...");
  command.add_flag("--require-coverage", a.require_coverage,
                   "Each subject must have been judged at every kind of neighbourhood that it declares to "
                   "do; otherwise nothing is confirmed (exit code 2)");
  command.add_flag("--all-rows", a.all_rows,
                   fmt::format("Write every row to the JSON report; without it a report of more than {} rows "
                               "has of each subject and check the {} that say most, and the others in short",
                               verify::kMostInFull, verify::kInFull));
  add_choice(command, "--color,--colour", a.colour, {"auto", "always", "never"},
             "Colours on the screen: auto is where it is a terminal");
  add_value(command, "--junit", a.junit, "FILE", "Write the results as JUnit XML to FILE");
  add_value(command, "--sarif", a.sarif, "FILE", "Write the root causes to FILE as a log of SARIF 2.1.0");
  add_value(command, "--markdown", a.markdown, "FILE", "Write overview and root causes to FILE as Markdown");
  add_value(command, "--waivers", a.waivers, "FILE",
            "JSON file of findings that are known and accepted until a date")
      ->check(CLI::ExistingFile);
  add_value(command, "--baseline", a.baseline, "FILE",
            "Report of an earlier audit, of --json or --save-baseline: say what is new, worse and gone "
            "since, and exit with 1 only for what is new or worse")
      ->check(CLI::ExistingFile);
  add_value(command, "--save-baseline", a.save_baseline, "FILE",
            "Write what is wrong to FILE, as a small text for --baseline: a line for each subject and check");
}

void add_output_options(CLI::App& command, OutputArguments& a) {
  add_choice(command, "--level", a.level, {"quick", "standard", "thorough"},
             "quick: one tessellation of each mesh; standard: also tessellations of the mesh written in "
             "another order, moved and scaled, for meshes of at most 200 faces; thorough: for all meshes");
  add_report_options(command, a);
  add_value(command, "--html", a.html, "FILE",
            "Write the report as one page for a browser to FILE: overview, root causes, histogram of errors, "
            "and the meshes in three dimensions with their errors");
  add_value(command, "--witnesses", a.witnesses, "DIR",
            "Write each finding to a folder of its own in DIR: the control mesh, and a JSON file with the "
            "place, the exact value to 40 digits, the value delivered, and the commands that reproduce both");
  add_value(command, "--shrink", a.shrink_seconds, "SECONDS",
            "Search for a small mesh with the same finding, SECONDS (20) for each subject and check, and "
            "write it as --witnesses does (default folder: limitcheck-witness)")
      ->check(CLI::Range(0.01, 86400.0))
      ->check(kFinite)
      ->expected(0, 1)
      ->default_str("20");
  add_value(command, "--explain", a.explain, "CHECK",
            "Explain a check, or all of them: its meaning, its bound and where the bound comes from");
}

void say_report(const ReportOptions& options, const verify::Report& report,
                const std::function<std::string(const verify::Report&, const verify::Screen&)>& text) {
  const std::size_t width = screen_width(STDOUT_FILENO);
  if (options.colour == "never" ||
      (options.colour == "auto" && (!takes_escapes(STDOUT_FILENO) || std::getenv("NO_COLOR") != nullptr)))
    return say_text(stdout, text(report, {false, width}));
  verify::Report shown = report;  // with no escape sequences but ours
  const auto show = [](std::string& words) { words = verify::visible_text(words); };
  for (std::string* words : {&shown.printed, &shown.incomplete, &shown.containment}) show(*words);
  for (std::string& subject : shown.subjects) show(subject);
  for (auto& mesh : shown.meshes) show(mesh.name);
  for (verify::Result& r : shown.results)
    for (std::string* words : {&r.subject, &r.mesh, &r.depths, &r.message}) show(*words);
  std::fputs(text(shown, {true, width}).c_str(), stdout);
}

std::string report_file(const AuditArguments& a, const char* form) {
  return a.report.empty() ? "" : a.report + "/audit." + form;
}

namespace {

// Below the overview.
std::string where_the_rest_is(const AuditArguments& a) {
  if (!a.report.empty())
    return fmt::format(
        "{} shows the causes in a browser; {} has all tables, and each cause with the command that shows it; "
        "{} is for programs.\n",
        report_file(a, "html"), report_file(a, "txt"), report_file(a, "json"));
  return "--details prints all tables. --explain CHECK says what a check means.\n";
}

}  // namespace

void deliver(const AuditArguments& a, const verify::Report& report, const std::string& json,
             const std::string& about, const std::function<void()>& write_files) {
  std::exception_ptr not_written;
  try {
    write_files();
  } catch (const std::exception&) {
    not_written = std::current_exception();
  }
  if (a.shard.json == "-")
    say_text(stdout, json);
  else
    say_report(a.output, report, [&](const verify::Report& shown, const verify::Screen& screen) {
      const std::string top = verify::visible_text(about);
      return a.details ? top + "\n" + verify::to_table(shown, screen)
                       : verify::to_overview(shown, verify::causes(shown), screen, top, a.output.level,
                                             where_the_rest_is(a));
    });
  if (not_written) std::rethrow_exception(not_written);
}

bool explained(const OutputArguments& a) {
  if (a.explain.empty()) return false;
  bool found = false;
  std::string known = "all";
  for (const auto& e : verify::row_kinds()) {
    known += fmt::format(", {}", e.check);
    if (a.explain != "all" && verify::current_name(a.explain) != e.check) continue;
    say_lines(fmt::format("{}{}\n  meaning  {}\n  bound    {}\n  from     {}\n", found ? "\n" : "", e.check,
                          e.meaning, e.bound, e.source));
    found = true;
  }
  if (found) say_lines(fmt::format("\n{}\n{}", "In tables", verify::words_of_tables()));
  if (!found)
    throw data::ArgumentError(fmt::format("there is no check '{}'; there are: {}", a.explain, known));
  return true;
}

namespace {

void waive(const ReportOptions& a, verify::Report& report) {
  if (a.waivers.empty()) return;
  std::map<std::string, std::string> versions;
  for (const auto& [subject, description] : report.descriptions)
    versions[subject] = verify::version_in(description);
  const auto today = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  verify::apply_waivers(report, read_file(a.waivers, verify::parse_waivers), versions,
                        fmt::format("{:%Y-%m-%d}", fmt::gmtime(today)));
}

bool judged_as_required(const ReportOptions& a, verify::Report& report) {
  std::string missing;
  for (const verify::Unjudged& none : verify::unjudged(report, a.required))
    missing += (missing.empty() ? "" : "; ") + none.text();
  for (const verify::Coverage& c : report.coverage)
    if (a.require_coverage && !c.never.empty())
      missing += fmt::format("{}{} never looked at {} of {} kinds of neighbourhood that it declares ({})",
                             missing.empty() ? "" : "; ", c.subject, c.never.size(), c.declared(),
                             data::name_of(c.scheme));
  if (!missing.empty() && report.incomplete.empty()) report.incomplete = missing;
  return missing.empty();
}

// The mesh that a result is about; nullptr if it is none of these.
const verify::AuditMesh* mesh_of(const verify::Result& r, const std::vector<verify::AuditMesh>& meshes) {
  const auto at = std::ranges::find_if(
      meshes, [&](const verify::AuditMesh& m) { return verify::case_of(m) == verify::case_of(r); });
  return at == meshes.end() ? nullptr : &*at;
}

// The subject that it is about; nullptr if it is none of these.
const verify::AuditSubject* subject_of(const verify::Result& r, const Audited& audited) {
  const auto& labels = audited.report.subjects;
  const auto number = static_cast<std::size_t>(std::ranges::find(labels, r.subject) - labels.begin());
  return number < audited.subjects.size() ? &audited.subjects[number] : nullptr;
}

// One finding of each subject and check: the one on the smallest mesh.
std::vector<const verify::Result*> smallest(const std::vector<verify::AuditMesh>& meshes,
                                            const std::vector<const verify::Result*>& findings) {
  const auto faces = [&](const verify::Result* r) {
    const verify::AuditMesh* m = mesh_of(*r, meshes);
    return m == nullptr ? 0 : m->mesh.faces.size();
  };
  std::vector<const verify::Result*> chosen;
  for (const verify::Result* r : findings) {
    const auto same = std::ranges::find_if(
        chosen, [&](const verify::Result* c) { return c->subject == r->subject && c->check == r->check; });
    if (same == chosen.end())
      chosen.push_back(r);
    else if (faces(r) < faces(*same))
      *same = r;
  }
  return chosen;
}

// Writes each finding of the report as files (verify/report/forms.h), if --witnesses or --shrink says so; with --shrink
// one for each subject and check, on a smaller mesh.
void write_witnesses(const OutputArguments& a, const Audited& audited) {
  if (a.witnesses.empty() && a.shrink_seconds <= 0) return;
  const auto& [subjects, meshes, report, threads] = audited;
  const std::string folder = a.witnesses.empty() ? "limitcheck-witness" : a.witnesses;
  std::vector<const verify::Result*> findings;
  for (const verify::Result& r : report.results)
    if (verify::is_bad(r)) findings.push_back(&r);
  if (a.shrink_seconds > 0) findings = smallest(meshes, findings);
  for (const verify::Result* finding : findings) {
    if (verify::interrupted() != 0 && a.shrink_seconds > 0) return;
    const verify::AuditMesh* mesh = mesh_of(*finding, meshes);
    if (mesh == nullptr) continue;
    if (a.shrink_seconds <= 0) {
      verify::write_witness(folder, report, *finding, *mesh, a.level);
      continue;
    }
    const verify::AuditSubject* subject = subject_of(*finding, audited);
    if (subject == nullptr) continue;
    const auto [small, row, relation] =
        verify::shrink(*subject, *mesh, threads, *finding, {.seconds = a.shrink_seconds});
    if (!row) continue;
    const auto place =
        verify::write_witness(folder, report, *row, small.mesh, relation ? "thorough" : "quick");
    say(stderr, "{} / {}: {} faces at depth {} shrunk to {} at depth {} ({} attempts): {}\n", row->subject,
        row->check, mesh->mesh.faces.size(), finding->depth, small.mesh.mesh.faces.size(), small.depth,
        small.attempts, place.string());
  }
  if (a.shrink_seconds <= 0 && !findings.empty())
    say(stderr, "{} witnesses in {}\n", findings.size(), folder);
}

}  // namespace

std::optional<verify::ErrorShape> shape_of(const Audited& audited, const verify::Result& row) {
  const verify::AuditMesh* mesh = mesh_of(row, audited.meshes);
  const verify::AuditSubject* subject = subject_of(row, audited);
  // After an interrupt no subject is asked again: it may be the one that does not answer.
  if (mesh == nullptr || subject == nullptr || !audited.report.incomplete.empty()) return std::nullopt;
  const SubjectOutput output;  // the report has it already
  return verify::error_shape(*subject, *mesh, row, audited.threads);
}

void write_report(const AuditArguments& a, const Audited& audited, const std::string& json,
                  const std::function<std::optional<verify::ErrorShape>(const verify::Result& row)>& shape) {
  const verify::Report& report = audited.report;
  const std::string& level = a.output.level;
  write_forms(a.output, report, level);
  if (!json.empty())
    for (const std::string& file : {a.shard.json, report_file(a, "json")})
      if (!file.empty() && file != "-") verify::write_text(file, json);
  std::vector<std::string> pages{a.output.html, report_file(a, "html")};
  std::erase(pages, "");
  if (!pages.empty()) {
    const std::vector<verify::Cause> causes = verify::causes(report);
    std::vector<std::optional<verify::ErrorShape>> shapes;
    for (const verify::Cause& c : causes) shapes.push_back(shape(report.results[c.example]));
    for (const std::string& page : pages)
      verify::write_text(page, verify::to_html(report, causes, shapes, level));
    if (!a.report.empty())
      verify::write_text(report_file(a, "txt"), "Root causes\n\n" +
                                                    verify::causes_in_full(report, causes, level) +
                                                    "Tables\n\n" + verify::to_table(report, {}));
  }
  write_witnesses(a.output, audited);
}

bool settle(const ReportOptions& a, verify::Report& report) {
  const bool judged = judged_as_required(a, report);
  waive(a, report);
  if (!a.baseline.empty())
    verify::compare_with_baseline(report, data::io::whole_content(a.baseline), a.baseline);
  if (!a.save_baseline.empty()) verify::write_text(a.save_baseline, verify::to_baseline(report));
  return judged;
}

void write_forms(const ReportOptions& a, const verify::Report& report, const std::string& level) {
  if (!a.junit.empty()) verify::write_text(a.junit, verify::to_junit(report));
  if (!a.sarif.empty()) verify::write_text(a.sarif, verify::to_sarif(report, verify::causes(report), level));
  if (!a.markdown.empty())
    verify::write_text(a.markdown, verify::to_markdown(report, verify::causes(report), level));
}

void refuse_one_file_for_two(std::vector<std::pair<std::string, std::string>> outputs,
                             const ReportOptions& a) {
  outputs.insert(outputs.end(), {{"--junit", a.junit},
                                 {"--sarif", a.sarif},
                                 {"--markdown", a.markdown},
                                 {"--save-baseline", a.save_baseline}});
  std::error_code ignored;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    for (std::size_t j = 0; j < k; ++j) {
      const auto& [option, file] = outputs[k];
      const auto& [other, other_file] = outputs[j];
      if (file.empty() || file == "-" || other_file.empty()) continue;
      if (std::filesystem::weakly_canonical(file, ignored) ==
              std::filesystem::weakly_canonical(other_file, ignored) ||
          std::filesystem::equivalent(file, other_file, ignored))
        throw data::ArgumentError(fmt::format("{} and {} name the same file: {}", other, option, file));
    }
}

std::string nothing_looked_at(bool polygons) {
  return std::string("nothing was looked at: nothing that was asked for is supported") +
         (polygons
              ? "; a subject that does Loop's scheme only needs --triangulate for meshes with larger faces"
              : "");
}

int exit_code_of(const verify::Report& report, bool judged) {
  if (!report.looked()) return kBadInput;
  if ((!judged || !report.host_sufficed()) && std::ranges::none_of(report.results, verify::is_bad))
    return kBadInput;
  return report.held() ? kHeld : kFindings;
}

}  // namespace limitcheck::cli
