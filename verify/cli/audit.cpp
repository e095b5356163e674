// SPDX-License-Identifier: MIT
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "data/bounding_box.h"
#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/audit/default_plan.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/host/host.h"
#include "verify/interrupt/interrupt.h"
#include "verify/relations/relations.h"
#include "verify/report/json.h"
#include "verify/subject/devices.h"
#include "verify/subject/registry.h"

namespace limitcheck::cli {
namespace {

bool on_a_device(const verify::AuditSubject& subject) {
  return std::string_view(subject.subject->name).ends_with("-gl");
}

// "all", "name" or "name:key=value,key=value". `all` takes OpenSubdiv's approximate patches twice: at two
// levels of isolation (Bfr's default), and isolated as deep as they are sampled.
std::vector<verify::AuditSubject> subjects(const Job& a, SubjectLoader& loader) {
  std::vector<verify::AuditSubject> list;
  for (const std::string& again : a.again.subjects) list.push_back(loader.open(again));
  if (!list.empty()) return list;
  if (a.subject == "all") {
    if (!a.options.empty()) throw data::ArgumentError("--option needs one subject, not all");
    for (const lc_subject* s : verify::built_in_subjects()) {
      const verify::AuditSubject plain = loader.built_in(*s);
      if (on_a_device(plain)) try {
          (void)verify::capabilities(*plain.subject, "");
        } catch (const verify::SubjectDied&) {         // the audit reports it
        } catch (const verify::SubjectError& error) {  // the libraries are there, and no driver
          say(stderr, "limitcheck: left out: {}\n", error.what());
          continue;
        }
      list.push_back(plain);
      const auto with = [&](std::string given) {
        list.push_back({plain.subject, std::move(given), plain.in_turns});
      };
      if (std::string_view(s->name) == "opensubdiv-bfr")
        with(fmt::format("approx-level={}", std::max(a.depth, 1)));
      if (std::string_view(s->name) == "opensubdiv-far-patches")
        with(fmt::format("level={}", std::clamp(a.depth, 1, 10)));
    }
    for (const verify::MissingSubject& m : verify::missing_subjects())
      say(stderr, "limitcheck: left out: {}\n", m.why);
    return list;
  }
  return {loader.open(a.subject, a.options)};
}

// For --help.
std::string built_in_names() {
  std::string names;
  for (const lc_subject* s : verify::built_in_subjects())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", s->name);
  for (const verify::MissingSubject& m : verify::missing_subjects()) names += fmt::format("; {}", m.why);
  return names;
}

void check_json(const std::string& json) {
  if (!json.empty() && json != "-" && !json.ends_with(".json"))
    throw data::ArgumentError(
        fmt::format("--json {0}: the file must end in .json, or be - for standard output (--json without a "
                    "file goes last: {0} --json)",
                    json));
}

// The header of the report.
verify::Report begin_report(const Job& a, const std::vector<verify::AuditSubject>& subjects,
                            const std::vector<verify::AuditMesh>& meshes) {
  verify::Report report;
  report.version = LIMITCHECK_VERSION;
  report.depths = a.plan ? "plan" : a.chosen.kind == "file" ? a.chosen.text() : a.chosen.kind;
  report.seed = a.chosen.seed;
  report.left_out = a.left_out;
  report.rerun = a.rerun;
  if (a.sampling) report.sample = fmt::format("{}:{}", a.sampling->faces, a.sampling->seed);
  for (const auto& s : subjects) {
    report.subjects.push_back(s.label());
    if (s.subject->description != nullptr) report.descriptions[s.label()] = s.subject->description;
  }
  for (const verify::AuditMesh& m : meshes) {
    report.depth = std::max(report.depth, m.depth);
    if (std::ranges::find(report.meshes, m.name, &verify::Report::Mesh::name) == report.meshes.end())
      report.meshes.push_back({m.name, static_cast<std::int64_t>(m.mesh.positions.size()),
                               static_cast<std::int64_t>(m.mesh.faces.size()), m.scheme(), m.triangulated,
                               data::box_diagonal(m.mesh)});
  }
  return report;
}

Job job_of(const AuditArguments& given) {
  Job a{given, verify::parse_depths(given.depths), parse_sample(given.sample), left_out_by(given.checks), {}};
  refuse_one_file_for_two({{"--json", a.shard.json}, {"--html", a.output.html}}, a.output);
  if (!a.rerun.empty()) {
    a.again = findings_of(a.rerun);
    a.output.baseline = a.rerun;
    a.output.level = "thorough";  // small or large, what had findings is looked at
  }
  take_program(a.from, a.subject, a.meshes);
  take_mesh(a.from, a.subject, a.meshes);
  const bool all = a.subject.empty() && a.rerun.empty();
  if (all) a.subject = "all";
  if (a.must_refuse && (all || a.meshes.empty()))
    throw data::ArgumentError("--must-refuse needs a subject and the files of broken meshes");
  if (a.threads <= 0) a.threads = tbb::info::default_concurrency();
  if (a.exhaustive > 0 && (a.subject == "all" || !a.meshes.empty() || !a.plan))
    throw data::ArgumentError("--exhaustive takes one subject, and chooses the meshes and depths itself");
  a.plan = a.plan && a.meshes.empty();
  return a;
}

// Why not all was looked at; empty: all was. Of a shard there may be nothing to look at.
std::string incomplete(const verify::Auditor& auditor, const std::vector<verify::AuditMesh>& meshes,
                       const verify::Report& report, int signal, bool whole) {
  if (signal != 0) return fmt::format("interrupted by {}", verify::signal_name(signal));
  if (!auditor.lack().empty()) return auditor.lack();
  if (report.looked() || !whole) return "";
  return nothing_looked_at(
      std::ranges::any_of(meshes, [](const verify::AuditMesh& m) { return !m.mesh.faces.are_triangles(); }));
}

// Whether nothing was judged on a mesh that the user named; says so.
bool named_and_not_judged(const AuditArguments& a, const verify::Report& report) {
  bool any = false;
  for (const std::string& mesh : a.meshes) {
    const verify::Result* row = nullptr;
    bool looked = false;
    for (const verify::Result& r : report.results)
      if (r.mesh == mesh) row = row == nullptr ? &r : row, looked = looked || verify::looked_at(r);
    if (looked || row == nullptr) continue;
    say(stderr, "limitcheck: nothing was judged on {}: {}\n", mesh, row->message);
    any = true;
  }
  return any;
}

int audit(const Job& a) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(a.threads));
  SubjectLoader loader(a.from);
  if (!a.rerun.empty() && a.again.findings.empty()) {
    say("{} has no findings: nothing is looked at again\n", a.rerun);
    return kHeld;
  }
  const std::vector<verify::AuditSubject> audited = subjects(a, loader);
  Progress progress;
  const AuditedMeshes asked = meshes_of(a, audited, progress);
  const std::vector<verify::AuditMesh>& meshes = asked.list;
  verify::Report report = begin_report(a, audited, meshes);
  const auto left_out = [&](std::string_view check) {
    return std::ranges::find(a.left_out, check) != a.left_out.end();
  };
  const bool few = a.subject == "all" && a.plan;
  std::vector<verify::AuditSubject> covering = audited;
  if (few && std::erase_if(covering, on_a_device) > 0)
    say(stderr,
        "limitcheck: opensubdiv-gl and row-stream-gl are audited on a few meshes; limitcheck audit "
        "row-stream-gl "
        "looks at the whole plan, which takes minutes\n");
  if (few && std::erase_if(covering, [](const verify::AuditSubject& s) { return !s.options.empty(); }) > 0)
    say(stderr, "limitcheck: subjects under options are audited on meshes of up to {} faces\n",
        verify::kMostFacesUnderOptions);
  const verify::CoverageQuestion coverage = a.must_refuse || !a.rerun.empty() || left_out("positions")
                                                ? verify::CoverageQuestion{}
                                                : verify::coverage_question(covering, meshes);

  // Look.
  const verify::InterruptGuard guard;
  const verify::Clock clock;
  SubjectOutput output(&progress);
  verify::Auditor auditor(
      a.depth, a.threads,
      [&](const verify::AuditStep& s) {
        progress.show(s.done, s.total, fmt::format("{} on {}: {}", s.subject, s.mesh, s.check));
      },
      a.level());
  if (!a.rerun.empty() || !a.left_out.empty() || few)
    auditor.judge_only(
        [&](const verify::AuditSubject& s, const verify::AuditMesh& m, std::string_view check) {
          if (few && !verify::is_looked_at_beside_all(s, on_a_device(s), m)) return false;
          return a.rerun.empty() ? !left_out(check) : a.again.has(s.label(), m, check);
        });
  auditor.leave_what_is_interrupted();
  ShardArguments kept = a.shard;
  if (kept.json.empty()) kept.json = report_file(a, "json");
  kept.check();
  const bool reports = !kept.json.empty(), keeps = reports && !a.must_refuse && kept.json != "-";
  verify::Plan plan{"limitcheck audit", nlohmann::json::object()};
  if (reports && !a.must_refuse)
    plan = audit_plan(auditor, audited, meshes, report, coverage, a.output.level);
  const auto journal = keeps ? open_journal(kept, plan, false) : nullptr;
  if (journal != nullptr && kept.resume)  // as it is written: other bytes than those of UTF-8 are not
    require_units(data::parse_untrusted(dumped(plan.what, -1)), journal->results());
  const auto receipts = [&loader, before = journal ? journal->receipts_before() : nlohmann::json()] {
    std::vector<verify::Receipt> all = verify::receipts_of(before);
    for (const verify::Receipt& r : loader.receipts()) add(all, r);
    return all;
  };
  if (journal != nullptr) journal->attach([&] { return verify::receipts_json(receipts()); });
  try {
    report.results = a.must_refuse ? verify::must_refuse(audited, meshes, a.threads)
                                   : auditor.run(audited, meshes, journal.get());
  } catch (const verify::Interrupted&) {  // there is no half of an answer whether broken meshes are refused
    (void)output.take();
    say(stderr, "limitcheck: interrupted by {}\n", verify::signal_name(verify::interrupted()));
    return kSignalled + verify::interrupted();
  }
  const auto finish = [&] {
    report.containment = loader.containment();
    report.devices = verify::Devices::noted();
    report.receipts = receipts();
    report.seconds = clock.seconds();
    report.printed = output.take();
    const int signal = auditor.gave_up() ? verify::interrupted() : 0;
    const bool whole = a.shard.of().is_whole();
    report.incomplete = incomplete(auditor, meshes, report, signal, whole);
    if (whole) verify::add_coverage(report, coverage);
    const bool judged = settle(a.output, report);
    const bool done = signal == 0 && auditor.lack().empty();
    const std::string json =
        reports && whole ? attested(verify::to_json(report, a.output.level, a.output.all_rows), plan.what)
                         : "";
    deliver(a, report, json, asked.scheme_line, [&] {
      if (!whole)
        write_part(a.shard, *journal,
                   {{},
                    {},
                    report.seconds,
                    report.containment,
                    report.printed,
                    report.incomplete,
                    report.devices,
                    verify::receipts_json(report.receipts)});
      const Audited all{audited, meshes, report, a.threads};
      write_report(a, all, json, [&](const verify::Result& row) { return shape_of(all, row); });
      if (journal != nullptr && done) journal->remove();  // the report makes it superfluous
    });
    const int later = a.output.shrink_seconds > 0 ? verify::interrupted() : signal;
    if (later != signal)
      say(stderr, "limitcheck: interrupted by {}: not all witnesses are written\n",
          verify::signal_name(later));
    if (later != 0) return kSignalled + later;
    if (!auditor.lack().empty()) return int{kBadInput};
    if (!whole && !report.looked()) return int{kHeld};
    const int code = exit_code_of(report, judged);
    return code == kHeld && named_and_not_judged(a, report) ? int{kBadInput} : code;
  };
  if (!auditor.abandoned()) return finish();
  verify::leave(guarded(finish), kBadInput);
}

}  // namespace

verify::Level Job::level() const {
  const std::string& level = output.level;
  return level == "quick"      ? verify::Level::kQuick
         : level == "thorough" ? verify::Level::kThorough
                               : verify::Level::kStandard;
}

void add_audit(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<AuditArguments>();
  CLI::App* command = app.add_subcommand("audit", "Judge a tessellator against the exact surface");
  command
      ->add_option(
          "SUBJECT", a->subject,
          fmt::format(
              "Built-in subject, NAME or NAME:key=value,..., or all; or a shared library (./libmine.so), "
              "or program:COMMAND, or shader:FILE. Without it: all on the default meshes. Built in: {}",
              built_in_names()))
      ->check(kNotEmpty);
  command
      ->add_option(
          "MESH", a->meshes,
          "Control meshes: files or generator names (default: the worst cases known, unless --level is "
          "quick, "
          "bumpy:800 and the stock shapes; where no depth is given either, at depths 0, 1 and 4, and small "
          "meshes at other depths, at unequal ones and with culled faces)")
      ->check(kNotEmpty);
  add_mesh_options(*command, a->mesh);
  CLI::Option* depth =
      add_number(*command, "--depth", a->depth, 0, 12,
                 "Subdivision depth of every face, or of the deepest one if --depths is not uniform");
  CLI::Option* depths =
      command
          ->add_option(
              "--depths", a->depths,
              "How the depths of the faces are chosen: uniform; random[:SEED[:visible]], from -1 (culled) "
              "or, with visible, 0 to --depth; view, by size on the screen, back faces culled; face0-culled; "
              "all-culled; or file:FILE, one depth for each face, -1 is culled")
          ->capture_default_str();
  CLI::Option* sample = add_value(*command, "--sample", a->sample, "FACES[:SEED]",
                                  "Judge only about so many faces of each mesh, in patches around random "
                                  "vertices, and cull the others: for meshes of millions of faces");
  add_value(*command, "--exhaustive", a->exhaustive, "VALENCE",
            "Audit every tagged neighbourhood up to so many faces around a vertex, of what SUBJECT does, at "
            "depths 0, 1 and 2; 8 takes about half an hour a scheme on one core")
      ->check(CLI::Range(3, 10));
  add_value(*command, "--checks", a->checks, "CHECK,...",
            "Look at these checks alone, or with a minus at all but these: positions,normals or "
            "-determinism,-state. Whether the subject tessellates is looked at always")
      ->expected(1);
  add_value(*command, "--rerun", a->rerun, "REPORT",
            "Look again at what had findings in an earlier audit's --json, and at nothing else, and say how "
            "much of it is gone and still there")
      ->check(CLI::ExistingFile);
  add_subject_settings(*command, a->options);
  command->add_option("--threads", a->threads, "The largest number of threads (default: all)")
      ->check(CLI::Range(1, 4096));
  add_json_option(*command, a->shard);
  add_shard_options(*command, a->shard, "meshes");
  command->add_flag("--details", a->details,
                    "Print a table for each subject and each finding at its worst, not only the overview");
  command->add_flag("--must-refuse", a->must_refuse,
                    "The MESHes are files of broken meshes, which are handed over as they are: the subject "
                    "must refuse them");
  add_value(*command, "--report", a->report, "DIR",
            "Write the report in all its forms to DIR: audit.html, audit.txt and audit.json");
  add_output_options(*command, a->output);
  add_subject_options(*command, a->from);
  auto files = std::make_shared<FilesArguments>();
  add_files_options(*command, *files);
  group(*command, "What is looked at",
        {"--scheme", "--triangulate", "--depth", "--depths", "--sample", "--exhaustive", "--level",
         "--checks", "--rerun", "--must-refuse"});
  group(*command, "The subject", {"--option", "--threads"});
  group(*command, "On the screen", {"--details", "--explain", "--color"});
  group(*command, "Reports",
        {"--report", "--json", "--all-rows", "--html", "--junit", "--sarif", "--markdown", "--witnesses",
         "--shrink"});
  group(*command, "What is required, known and new",
        {"--require", "--require-coverage", "--waivers", "--baseline", "--save-baseline"});
  group(*command, "Long audits", {"--shard", "--resume"});
  command->footer(
      "Exit codes: 0 all held, 1 findings, 2 bad usage or input, or nothing that was asked for or required "
      "is supported. Ctrl-C ends the audit with a report of the results so far, marked as incomplete, and "
      "exit code 130 (SIGTERM 143, SIGHUP 129); a second Ctrl-C ends it at once.");
  command->callback([=, &exit_code] {
    check_json(a->shard.json);
    if (explained(a->output)) return;
    if (a->output.all_rows && a->shard.json.empty() && a->report.empty())
      throw data::ArgumentError("--all-rows has no effect without --json or --report");
    a->plan = depth->count() + depths->count() + sample->count() == 0;
    refuse_what_has_no_effect(*command, *a, !files->tessellations.empty());
    exit_code = files->tessellations.empty() ? audit(job_of(*a)) : audit_files(*files, *a);
  });
}

}  // namespace limitcheck::cli
