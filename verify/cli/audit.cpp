// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <optional>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/audit/json.h"
#include "verify/audit/table.h"
#include "verify/cli/commands.h"
#include "verify/cli/progress.h"
#include "verify/subject/host.h"
#include "verify/subject/registry.h"

namespace limitcheck::cli {
namespace {

constexpr const char* kReportFile = "build/report/audit.json";

struct Arguments {
  std::string subject;
  std::vector<std::string> meshes, options;
  int depth = 4;
  int threads = 0;
  std::string json;
  bool each_mesh = false;
};

// "all", "name" or "name:key=value,key=value". `all` takes OpenSubdiv's approximate patches twice: as they
// come, and isolated as deep as they are sampled.
std::vector<verify::AuditSubject> subjects(const Arguments& a) {
  std::string options;
  for (const std::string& o : a.options) options += (options.empty() ? "" : ",") + o;
  std::vector<verify::AuditSubject> list;
  if (a.subject == "all") {
    if (!options.empty()) throw std::invalid_argument("--option needs one subject, not all");
    for (const lc_subject* s : verify::built_in_subjects()) {
      list.push_back({s, ""});
      if (std::string_view(s->name) == "opensubdiv-bfr")
        list.push_back({s, fmt::format("approx-level={}", std::max(a.depth, 1))});
    }
    return list;
  }
  const std::size_t colon = a.subject.find(':');
  const std::string name = a.subject.substr(0, colon);
  if (colon != std::string::npos)
    options = a.subject.substr(colon + 1) + (options.empty() ? "" : ",") + options;
  const lc_subject* subject = verify::find_subject(name);
  if (subject == nullptr) {
    std::string known = "all";
    for (const lc_subject* s : verify::built_in_subjects()) known += fmt::format(", {}", s->name);
    throw std::invalid_argument(fmt::format("there is no subject '{}'; there are: {}", name, known));
  }
  try {
    (void)verify::capabilities(*subject, options);
  } catch (
      const verify::SubjectError& error) {  // not the subject's fault: nobody has asked it for anything yet
    throw std::invalid_argument(fmt::format("{}{}{}", error.what(), subject->options ? "; options: " : "",
                                            subject->options ? subject->options : ""));
  }
  return {{subject, options}};
}

int audit(Arguments a) {
  const bool main_job = a.subject.empty();
  if (main_job) a.subject = "all";
  if (!a.json.empty() && a.json != "-" && !a.json.ends_with(".json"))
    throw std::invalid_argument(
        fmt::format("--json {}: the file must end in .json, or be - for standard output", a.json));
  if (a.meshes.empty()) {
    a.meshes = {"bumpy:800"};
    for (std::string& shape : data::stock_shapes()) a.meshes.push_back(std::move(shape));
  }
  if (a.threads <= 0) a.threads = tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(a.threads));

  const std::vector<verify::AuditSubject> audited = subjects(a);
  Progress progress;
  std::vector<verify::AuditMesh> meshes;
  verify::Report report;
  for (const std::string& name : a.meshes) {
    progress.show(0, 1, "mesh " + name);
    meshes.push_back({name, data::open_mesh(name)});
    report.meshes.push_back({name, static_cast<std::int64_t>(meshes.back().mesh.positions.size()),
                             static_cast<std::int64_t>(meshes.back().mesh.triangles.size())});
  }
  report.version = LIMITCHECK_VERSION;
  report.depth = a.depth;
  for (const auto& s : audited)
    report.subjects.push_back(s.options.empty() ? s.subject->name
                                                : fmt::format("{}:{}", s.subject->name, s.options));

  const auto start = std::chrono::steady_clock::now();
  verify::Auditor auditor(a.depth, a.threads, [&](const verify::AuditStep& s) {
    progress.show(s.done, s.total, fmt::format("{} on {}: {}", s.subject, s.mesh, s.check));
  });
  report.results = auditor.run(audited, meshes);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  progress.clear();

  if (a.json == "-") {
    fmt::print("{}", verify::to_json(report));
  } else {
    const bool colour = isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
    fmt::print("{}", verify::to_table(report, colour, a.each_mesh));
    if (!a.json.empty()) verify::write_text(a.json, verify::to_json(report));
  }
  if (main_job) {
    verify::write_text(kReportFile, verify::to_json(report));
    fmt::print(stderr, "report: {}\n", kReportFile);
  }
  return report.held() ? kHeld : kFindings;
}

}  // namespace

void add_audit(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("audit", "Judge a tessellator against the exact surface");
  command->add_option(
      "SUBJECT", a->subject,
      "Built-in subject, NAME or NAME:key=value,..., or all. Without it: all on the default meshes, and "
      "the report in " +
          std::string(kReportFile));
  command->add_option("MESH", a->meshes,
                      "Control meshes: files or generator names (default: bumpy:800 and the stock shapes)");
  command->add_option("--depth", a->depth, "Subdivision depth of every face")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  command->add_option("--option", a->options, "key=value for the subject; may be repeated")
      ->take_all()
      ->expected(1);
  command->add_option("--threads", a->threads, "At most so many (default: all)")->check(CLI::Range(1, 4096));
  command
      ->add_option("--json", a->json,
                   "Write the results as JSON to FILE.json; '-' or nothing: standard output, and no table")
      ->type_name("FILE")
      ->expected(0, 1)
      ->default_str("-");
  command->add_flag("--each-mesh", a->each_mesh,
                    "A line for every mesh in the table, not only for the worst");
  command->footer("Exit codes: 0 all held, 1 findings, 2 bad usage or input.");
  command->callback([a, &exit_code] { exit_code = audit(*a); });
}

}  // namespace limitcheck::cli
