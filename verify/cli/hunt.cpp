// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "verify/checks/check_oracle.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

struct HuntArguments {
  std::string subject, shard = "1/1", json, junit, baseline;
  std::string witnesses = "limitcheck-hunt";
  std::vector<std::string> options, vary;
  std::optional<data::Scheme> scheme;
  std::uint64_t cases = 1000, seed = 1;
  int jobs = 0, attempts = verify::HuntOptions().attempts;
  double seconds = 0;  // in place of cases; 0: cases
  bool in_process = false, resume = false;
  SubjectArguments from;
};
constexpr std::uint64_t kMostCases = 1'000'000'000;

std::vector<data::Scheme> schemes_asked(const HuntArguments& a) {
  if (a.scheme) return {*a.scheme};
  return {data::Scheme::kLoop, data::Scheme::kCatmullClark};
}

// The subject, and what is to be asked of it.
struct Hunted {
  SubjectLoader loader;
  verify::AuditSubject subject;
  std::vector<verify::Does> does;
  std::vector<verify::Way> ways;

  explicit Hunted(const HuntArguments& a)
      : loader(a.from),
        subject(loader.open(a.subject, a.options)),
        does(verify::schemes_of(subject, schemes_asked(a))),
        ways(verify::ways_of(subject, schemes_asked(a), a.vary)) {}
  verify::HuntPlan plan(std::uint64_t seed) const { return {seed, does, ways, verify::is_oracle(subject)}; }
  // A report before the first case.
  verify::HuntReport report(const HuntArguments& a) const {
    verify::HuntReport report;
    report.version = LIMITCHECK_VERSION, report.subject = subject.label();
    report.seed = a.seed, report.asked = a.seconds == 0 ? a.cases : 0;
    report.varied = a.vary;
    for (const verify::Does& d : does) report.schemes.emplace_back(data::name_of(d.scheme));
    return report;
  }
};

// Each case is a unit. One behind them, for each process, is the small meshes of what it has found.
verify::Plan plan_of(const verify::HuntReport& report, const verify::Shard& shard) {
  const std::uint64_t cases = report.asked == 0 ? kMostCases : report.asked;
  return {"limitcheck hunt",
          {{"version", report.version},
           {"subject", report.subject},
           {"seed", report.seed},
           {"asked", report.asked},
           {"schemes", report.schemes},
           {"varied", report.varied}},
          cases + verify::HuntPlan::kBlock * (shard.count + 1),
          verify::HuntPlan::kBlock,
          shard};
}
std::uint64_t small_unit(const verify::HuntReport& report, const verify::Plan& plan) {
  std::uint64_t unit = report.asked == 0 ? kMostCases : report.asked + verify::HuntPlan::kBlock;
  while (!plan.has(unit)) unit += verify::HuntPlan::kBlock;
  return unit;
}

// The report of a part, as its journal has it.
verify::HuntReport part_of(verify::HuntReport report, const verify::Journal& journal) {
  report.shard = journal.plan().shard;
  const std::uint64_t last = small_unit(report, journal.plan());
  for (const auto& [unit, added] : journal.results()) {
    report.add_again(added);
    if (unit != last) report.next = unit + 1;
  }
  return report;
}

// Goes on where the journal ends, until all cases of its part are looked at or the time is over.
void hunt_part(const HuntArguments& a, verify::Journal& journal, JobCounters& counters,
               const verify::Clock& clock) {
  const Hunted hunted(a);
  verify::HuntReport report = part_of(hunted.report(a), journal);
  verify::Hunt hunt(hunted.subject, hunted.plan(a.seed), {a.attempts, a.witnesses});
  std::uint64_t shown = report.findings.size();
  counters.cases += report.cases, counters.findings += shown;
  for (std::uint64_t n = 0; a.seconds == 0 ? n < a.cases : clock.seconds() < a.seconds; ++n) {
    if (!journal.plan().has(n)) {
      n += verify::HuntPlan::kBlock - 1;
      continue;
    }
    if (journal.recall(n) != nullptr) continue;
    const std::optional<verify::HuntReport> found = hunt.look(n);
    if (!found) break;
    journal.keep(n, report.add(*found));
    ++counters.cases;
    counters.findings += report.findings.size() - shown;
    shown = report.findings.size();
  }
  const verify::Clock shrinking;
  hunt.shrink_findings(report);
  const std::uint64_t last = small_unit(report, journal.plan());
  nlohmann::json small = report.small_meshes();
  small["seconds"] = shrinking.seconds();
  if (verify::interrupted() == 0 && journal.recall(last) == nullptr) journal.keep(last, std::move(small));
}

// The journals of the processes: beside the report, or in a folder that vanishes.
class PartFiles {
 public:
  PartFiles(const HuntArguments& a, const verify::HuntReport& report, const verify::Shard& whole) {
    std::string stem = a.json;
    if (a.json.empty() || a.json == "-") {
      folder_ = std::filesystem::temp_directory_path() / fmt::format("limitcheck-hunt-{}", getpid());
      std::filesystem::create_directories(folder_);
      stem = (folder_ / "hunt").string();
    }
    for (int job = 0; job < a.jobs; ++job) {
      const std::string file = fmt::format("{}.part{}", stem, job + 1);
      const verify::Shard shard{whole.index + whole.count * static_cast<std::uint64_t>(job),
                                whole.count * static_cast<std::uint64_t>(a.jobs)};
      journals.push_back(std::make_unique<verify::Journal>(plan_of(report, shard), file,
                                                           a.resume && std::filesystem::exists(file)));
      journals.back()->reload();
    }
  }
  ~PartFiles() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }
  PartFiles(const PartFiles&) = delete;
  PartFiles& operator=(const PartFiles&) = delete;

  std::vector<std::unique_ptr<verify::Journal>> journals;

 private:
  std::filesystem::path folder_;
};

int hunt(HuntArguments a) {
  std::vector<std::string> meshes;
  take_program(a.from, a.subject, meshes);
  if (!meshes.empty())
    throw data::ArgumentError(fmt::format("--program takes the place of SUBJECT {}", meshes[0]));
  if (a.subject.empty() || a.subject == "all")
    throw data::ArgumentError("a hunt needs one subject: limitcheck hunt SUBJECT");
  refuse_one_file_for_two({{"--json", a.json}, {"--junit", a.junit}, {"--baseline", a.baseline}});
  if (a.resume && (a.json.empty() || a.json == "-"))
    throw data::ArgumentError("--resume needs --json FILE: what was done is beside it, in FILE.part1 ..");
  const verify::Shard shard = verify::parse_shard(a.shard);
  std::optional<verify::HuntReport> earlier;
  if (!a.baseline.empty()) earlier = read_file(a.baseline, verify::read_hunt_report);
  const verify::HuntReport* const before = earlier ? &*earlier : nullptr;
  if (a.jobs <= 0) a.jobs = tbb::info::default_concurrency();
  a.from.isolate = !a.in_process;
  const verify::HuntReport header = [&] {
    HuntArguments asked = a;  // that all is well with them is found out here, and said once
    asked.from.isolate = false;
    const Hunted hunted(asked);
    (void)hunted.plan(a.seed);
    verify::HuntReport report = hunted.report(a);
    report.attested = {{"program", file_digest("/proc/self/exe")},
                       {"plan", verify::digest(dumped(plan_of(report, {}).what, -1))},
                       {"subject", subject_digest(*hunted.subject.subject)}};
    return report;
  }();

  const verify::InterruptGuard guard;
  const verify::Clock clock;
  PartFiles files(a, header, shard);
  Progress progress;
  const int code = run_jobs(
      a.jobs,
      [&](int job, JobCounters& counters) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        const SubjectOutput silent;
        hunt_part(a, *files.journals[static_cast<std::size_t>(job)], counters, clock);
        return kHeld;
      },
      [&](const JobCounters& c) {
        const double since = clock.seconds();
        const auto done =
            static_cast<std::size_t>(a.seconds == 0 ? c.cases.load() : static_cast<std::uint64_t>(since));
        const auto total = static_cast<std::size_t>(a.seconds == 0 ? a.cases / shard.count
                                                                   : static_cast<std::uint64_t>(a.seconds));
        progress.show(done, total,
                      fmt::format("{} cases, {:.1f} a second, {} findings", c.cases.load(),
                                  static_cast<double>(c.cases) / std::max(since, 1e-3), c.findings.load()));
      });
  progress.clear();

  std::vector<verify::HuntReport> parts;
  for (const auto& journal : files.journals) {
    journal->reload();  // the processes have written it
    parts.push_back(part_of(header, *journal));
  }
  verify::HuntReport report = verify::combined(parts);
  report.shard = shard;
  if (report.cases == 0 && code == kBadInput) return kBadInput;  // it has been said
  const int signal = verify::interrupted();
  if (signal != 0)
    report.incomplete = fmt::format("interrupted by {}", verify::signal_name(signal));
  else if (code != 0)
    report.incomplete = code > kSignalled
                            ? fmt::format("a process of the hunt was ended by signal {}", code - kSignalled)
                            : "a process of the hunt failed";
  if (report.incomplete.empty() && report.asked != 0) report.next = report.asked;
  if (!a.json.empty() && a.json != "-") verify::write_text(a.json, verify::to_json(report));
  if (!a.junit.empty()) verify::write_text(a.junit, verify::to_junit(report, before));
  if (report.incomplete.empty())
    for (const auto& journal : files.journals) journal->remove();
  if (a.json == "-")
    say("{}", verify::to_json(report));
  else
    say_lines(verify::to_text(report, before));
  if (signal != 0) return kSignalled + signal;
  if (!report.incomplete.empty() || report.judged == 0) return kBadInput;
  return verify::new_findings(report, before).empty() ? kHeld : kFindings;
}

}  // namespace

void add_hunt(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<HuntArguments>();
  CLI::App* command =
      app.add_subcommand("hunt", "Search for anything wrong with a tessellator on meshes without end");
  command
      ->add_option("SUBJECT", a->subject,
                   "As for limitcheck audit: built-in, ./libmine.so, or program:COMMAND")
      ->check(kNotEmpty);
  CLI::Option* cases =
      add_number<std::uint64_t>(*command, "--cases", a->cases, 1, kMostCases, "How many cases");
  const std::map<std::string, double> units{{"s", 1}, {"m", 60}, {"h", 3600}};
  add_value(*command, "--time", a->seconds, "TEXT", "How long, in place of --cases: 90s, 15m, 1h")
      ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_SENSITIVE).description(""))
      ->check(CLI::Range(1e-9, 1e9).description(""))
      ->excludes(cases);
  command->add_option("--seed", a->seed, "Another seed makes other cases; the same one the same")
      ->check(kSeed)
      ->capture_default_str();
  add_scheme(*command, a->scheme, "Only meshes of this scheme (default: both, if the subject does both)");
  add_value(*command, "--shard", a->shard, "K/N",
            "Only part K of N of the cases; limitcheck merge joins the reports of all parts")
      ->capture_default_str();
  command->add_option("--jobs", a->jobs, "Processes at once (default: as many as there are processors)")
      ->check(CLI::Range(1, 1024));
  add_subject_settings(*command, a->options);
  command
      ->add_option("--vary", a->vary,
                   "Keys of the subject's options (target,precision, or all): every second case takes other "
                   "values of one or two of them, which the subject's help text names")
      ->delimiter(',')
      ->type_name("KEY,...");
  command->add_option("--witnesses", a->witnesses, "Folder for the small mesh of each finding")
      ->capture_default_str();
  add_number(*command, "--attempts", a->attempts, 0, 1'000'000,
             "How often a smaller mesh is tried for each finding; 0: none is");
  add_value(*command, "--json", a->json, "FILE", "Write the report to FILE; '-': to standard output");
  add_value(*command, "--junit", a->junit, "FILE", "Write the findings as JUnit XML");
  add_value(*command, "--baseline", a->baseline, "FILE",
            "Report of an earlier hunt: only findings that it has not are new")
      ->check(CLI::ExistingFile);
  command->add_flag("--resume", a->resume,
                    "Go on where a hunt with the same arguments was ended; needs --json FILE");
  command->add_flag("--in-process", a->in_process,
                    "Run a built-in subject in the processes of the hunt: faster, and a crash ends the hunt");
  add_subject_options(*command, a->from);
  command->remove_option(command->get_option("--isolate"));  // that is so unless --in-process is given
  command->footer(
      "A finding is what was seen at one check in one kind of neighbourhood, however often, unless it was "
      "seen in a simpler neighbourhood; one for each kind of vertex is shrunk to few faces. Exit codes: 0 "
      "nothing new was found, 1 findings, 2 bad usage or input, or nothing was judged; 130 and the like "
      "after a signal, with a report of the cases so far.");
  command->callback([a, &exit_code] { exit_code = hunt(*a); });
}

}  // namespace limitcheck::cli
