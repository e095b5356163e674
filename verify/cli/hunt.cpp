// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt.h"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "verify/checks/check_oracle.h"
#include "verify/cli/audit.h"
#include "verify/cli/commands.h"
#include "verify/cli/hunt_jobs.h"
#include "verify/cli/mesh_options.h"
#include "verify/cli/screen.h"
#include "verify/cli/subject_loader.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kSaved = std::chrono::seconds(10);  // between two times that a part is saved

struct Arguments {
  std::string subject, time, shard = "1/1", json, junit, baseline;
  std::string witnesses = "limitcheck-hunt";
  std::vector<std::string> options, vary;
  std::optional<data::Scheme> scheme;
  std::uint64_t cases = 1000, seed = 1;
  int jobs = 0, attempts = 2000;
  bool in_process = false, resume = false;
  SubjectArguments from;
};

// "90", "90s", "15m", "1h"; in seconds.
double seconds_of(const std::string& text) {
  double seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, seconds);
  const std::string unit(at, end);
  const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (error != std::errc() || !(seconds * factor > 0 && seconds < 1e9))
    throw data::ArgumentError(
        fmt::format("--time {}: a number of seconds, or of minutes or hours as 15m, 1h", text));
  return seconds * factor;
}

std::vector<data::Scheme> schemes_asked(const Arguments& a) {
  if (a.scheme) return {*a.scheme};
  return {data::Scheme::kLoop, data::Scheme::kCatmullClark};
}

// A part of the hunt, by one process.
struct Part {
  verify::Shard shard;
  std::string file;  // its report so far; empty: it is kept nowhere
};

// A report that is the beginning of this part, to go on with.
std::optional<verify::HuntReport> begun(const Part& part, const verify::HuntReport& fresh) {
  if (part.file.empty() || !std::filesystem::exists(part.file)) return std::nullopt;
  verify::HuntReport old = verify::read_hunt_report(data::io::whole_content(part.file));
  if (old.subject != fresh.subject || old.seed != fresh.seed || old.asked != fresh.asked ||
      old.schemes != fresh.schemes || old.varied != fresh.varied || old.shard.index != fresh.shard.index ||
      old.shard.count != fresh.shard.count || old.version != fresh.version)
    throw data::ArgumentError(fmt::format("--resume: {} is of another hunt", part.file));
  return old;
}

verify::HuntReport hunt_part(const Arguments& a, const Part& part, JobCounters& counters,
                             Clock::time_point end) {
  SubjectLoader loader(a.from);
  const verify::AuditSubject subject = loader.open(a.subject, a.options);
  std::vector<verify::Does> does = verify::schemes_of(subject, schemes_asked(a));
  std::vector<verify::Way> ways = verify::ways_of(subject, schemes_asked(a), a.vary);
  verify::HuntReport report;
  report.version = LIMITCHECK_VERSION;
  report.subject = subject.label();
  report.seed = a.seed, report.asked = a.time.empty() ? a.cases : 0, report.shard = part.shard;
  report.varied = a.vary;
  for (const verify::Does& d : does) report.schemes.emplace_back(data::name_of(d.scheme));
  if (a.resume)
    if (auto old = begun(part, report)) report = std::move(*old);
  report.incomplete.clear();
  const double before = report.seconds;

  const auto start = Clock::now();
  auto saved = start;
  std::uint64_t next = report.next;
  verify::Hunt hunt(subject,
                    verify::HuntPlan(a.seed, std::move(does), std::move(ways), verify::is_oracle(subject)),
                    {1, a.attempts, a.witnesses}, std::move(report));
  const auto now = [&] {
    verify::HuntReport r = hunt.report();
    r.next = next;
    r.seconds = before + std::chrono::duration<double>(Clock::now() - start).count();
    if (verify::interrupted() != 0)
      r.incomplete = fmt::format("interrupted by {}", verify::signal_name(verify::interrupted()));
    return r;
  };
  const auto save = [&] {
    if (!part.file.empty()) verify::write_text(part.file, verify::to_json(now(), true));
    saved = Clock::now();
  };
  const std::uint64_t findings = hunt.report().findings.size();
  counters.cases += hunt.report().cases, counters.findings += findings;
  std::uint64_t shown = findings;
  for (; a.time.empty() ? next < a.cases : Clock::now() < end; ++next) {
    if (!part.shard.has(next / verify::HuntPlan::kBlock)) {
      next = (next / verify::HuntPlan::kBlock + 1) * verify::HuntPlan::kBlock - 1;
      continue;
    }
    if (!hunt.look(next)) break;
    ++counters.cases;
    counters.findings += hunt.report().findings.size() - shown;
    shown = hunt.report().findings.size();
    if (Clock::now() - saved > kSaved) save();
  }
  if (verify::interrupted() == 0 && a.time.empty()) next = std::max(next, a.cases);
  save();
  hunt.shrink_findings();
  save();
  return now();
}

// Where the parts of a hunt in several processes are kept: beside the report, or in a folder that vanishes.
class PartFiles {
 public:
  PartFiles(const Arguments& a, const verify::Shard& whole, int jobs)
      : keep_(!a.json.empty() && a.json != "-") {
    std::string stem = a.json;
    if (!keep_) {
      folder_ = std::filesystem::temp_directory_path() / fmt::format("limitcheck-hunt-{}", getpid());
      std::filesystem::create_directories(folder_);
      stem = (folder_ / "hunt").string();
    }
    for (int job = 0; job < jobs; ++job) {
      const verify::Shard shard{whole.index + whole.count * static_cast<std::uint64_t>(job),
                                whole.count * static_cast<std::uint64_t>(jobs)};
      parts.push_back({shard, fmt::format("{}.part{}", stem, job + 1)});
    }
  }
  ~PartFiles() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }
  PartFiles(const PartFiles&) = delete;
  PartFiles& operator=(const PartFiles&) = delete;
  void remove() const {
    std::error_code ignored;
    for (const Part& p : parts) std::filesystem::remove(p.file, ignored);
  }

  std::vector<Part> parts;

 private:
  bool keep_;
  std::filesystem::path folder_;
};

verify::HuntReport baseline(const std::string& file) try {
  return verify::read_hunt_report(data::io::whole_content(file));
} catch (const data::ArgumentError& error) {
  throw data::ArgumentError(fmt::format("--baseline {}: {}", file, error.what()));
}

int hunt(Arguments a) {
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
  const double seconds = a.time.empty() ? 0 : seconds_of(a.time);
  std::optional<verify::HuntReport> earlier;
  if (!a.baseline.empty()) earlier = baseline(a.baseline);
  const verify::HuntReport* const before = earlier ? &*earlier : nullptr;
  if (a.jobs <= 0) a.jobs = tbb::info::default_concurrency();
  a.from.isolate = !a.in_process;
  {  // that all is well with the arguments is found out here, and said once
    Arguments copy = a;
    copy.from.isolate = false;
    SubjectLoader loader(copy.from);
    const verify::AuditSubject subject = loader.open(a.subject, a.options);
    verify::HuntPlan(a.seed, verify::schemes_of(subject, schemes_asked(a)));
    (void)verify::ways_of(subject, schemes_asked(a), a.vary);
  }

  const verify::InterruptGuard guard;
  const auto start = Clock::now();
  const auto end =
      start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  const PartFiles files(a, shard, a.jobs);
  if (!a.resume) files.remove();  // those of a hunt that was killed
  Progress progress;
  const int code = run_jobs(
      a.jobs,
      [&](int job, JobCounters& counters) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        const SubjectOutput silent;
        (void)hunt_part(a, files.parts[static_cast<std::size_t>(job)], counters, end);
        return kHeld;
      },
      [&](const JobCounters& c) {
        const double since = std::chrono::duration<double>(Clock::now() - start).count();
        const auto done =
            static_cast<std::size_t>(a.time.empty() ? c.cases.load() : static_cast<std::uint64_t>(since));
        const auto total = static_cast<std::size_t>(a.time.empty() ? a.cases / shard.count
                                                                   : static_cast<std::uint64_t>(seconds));
        progress.show(done, total,
                      fmt::format("{} cases, {:.1f} a second, {} findings", c.cases.load(),
                                  static_cast<double>(c.cases) / std::max(since, 1e-3), c.findings.load()));
      });
  progress.clear();

  std::vector<verify::HuntReport> parts;
  for (const Part& p : files.parts)
    if (std::filesystem::exists(p.file))
      parts.push_back(verify::read_hunt_report(data::io::whole_content(p.file)));
  if (parts.empty()) return kBadInput;  // it has been said
  verify::HuntReport report = verify::combined(parts);
  report.shard = shard;
  if (code != 0 && report.incomplete.empty())
    report.incomplete = code > kSignalled
                            ? fmt::format("a process of the hunt was ended by signal {}", code - kSignalled)
                            : "a process of the hunt failed";
  if (!a.json.empty() && a.json != "-") verify::write_text(a.json, verify::to_json(report));
  if (!a.junit.empty()) verify::write_text(a.junit, verify::to_junit(report, before));
  if (report.incomplete.empty()) files.remove();
  fmt::print("{}", a.json == "-" ? verify::to_json(report) : verify::to_text(report, before));
  if (const int signal = verify::interrupted(); signal != 0) return kSignalled + signal;
  if (!report.incomplete.empty() || report.judged == 0) return kBadInput;
  return verify::new_findings(report, before).empty() ? kHeld : kFindings;
}

}  // namespace

void add_hunt(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("hunt", "Search for anything wrong with a tessellator on meshes without end");
  command->add_option("SUBJECT", a->subject,
                      "As for limitcheck audit: built-in, ./libmine.so, or program:COMMAND");
  CLI::Option* cases =
      add_number<std::uint64_t>(*command, "--cases", a->cases, 1, 1'000'000'000, "How many cases");
  command->add_option("--time", a->time, "How long, in place of --cases: 90s, 15m, 1h")->excludes(cases);
  command->add_option("--seed", a->seed, "Another seed makes other cases; the same one the same")
      ->capture_default_str();
  add_scheme(*command, a->scheme, "Only meshes of this scheme (default: both, if the subject does both)");
  command
      ->add_option("--shard", a->shard,
                   "Only part K of N of the cases; limitcheck merge joins the reports of all parts")
      ->type_name("K/N")
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
  command->add_option("--json", a->json, "Write the report to FILE; '-': to standard output")
      ->type_name("FILE");
  command->add_option("--junit", a->junit, "Write the findings as JUnit XML")->type_name("FILE");
  command
      ->add_option("--baseline", a->baseline,
                   "Report of an earlier hunt: only findings that it has not are new")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->add_flag("--resume", a->resume,
                    "Go on where a hunt with the same arguments was ended; needs --json FILE");
  command->add_flag("--in-process", a->in_process,
                    "Run a built-in subject in the processes of the hunt: faster, and a crash ends the hunt");
  add_subject_options(*command, a->from);
  command->remove_option(command->get_option("--isolate"));  // that is so unless --in-process is given
  command->footer(
      "A finding is what was seen at one check in one kind of neighbourhood, however often, unless the same "
      "was seen where there is less; one for each kind of vertex is shrunk to few faces. Exit codes: 0 "
      "nothing new was found, 1 findings, 2 bad usage or input, or nothing was judged; 130 and the like "
      "after a signal, with a report of the cases so far.");
  command->callback([a, &exit_code] { exit_code = hunt(*a); });
}

}  // namespace limitcheck::cli
