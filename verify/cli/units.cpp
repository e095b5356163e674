// SPDX-License-Identifier: MIT
#include "verify/cli/units.h"

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "verify/cli/commands.h"
#include "verify/interrupt/interrupt.h"
#include "verify/proof/proof_set.h"
#include "verify/report/json.h"
#include "verify/row/statistics.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

bool is_file(const std::string& json) {
  std::error_code ignored;
  const auto type = fs::status(json, ignored).type();
  return !json.empty() && json != "-" && (type == fs::file_type::not_found || type == fs::file_type::regular);
}

// As long as this process lives.
JobCounters& shared_counters() {
  void* memory =
      mmap(nullptr, sizeof(JobCounters), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return *new (memory) JobCounters{};
}

// In the new process.
[[noreturn]] void run_job(int job, JobCounters& counters, const std::function<int(int, JobCounters&)>& work) {
  setpgid(0, 0);  // Ctrl-C comes to the first process, which hands it on
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int code = guarded([&] { return work(job, counters); });
  std::fflush(nullptr);
  _exit(code);
}

}  // namespace

void ShardArguments::check() const {
  if (!of().is_whole() && !is_file(json))
    throw data::ArgumentError("--shard needs --json FILE.json, which limitcheck merge reads");
  if (resume && !is_file(json))
    throw data::ArgumentError("--resume needs --json FILE.json: what is done is kept in FILE.jsonl");
}

void add_json_option(CLI::App& command, ShardArguments& a) {
  add_value(command, "--json", a.json, "FILE",
            "Write the results as JSON to FILE; '-' or nothing: standard output, and no table")
      ->expected(0, 1)
      ->default_str("-");
}

void add_shard_options(CLI::App& command, ShardArguments& a, const std::string& units) {
  command
      .add_option("--shard", a.shard,
                  fmt::format("Only part K of N: every N-th of the {}. Needs --json FILE, which then has the "
                              "part; limitcheck merge makes the report of all parts",
                              units))
      ->type_name("K/N")
      ->capture_default_str();
  command.add_flag("--resume", a.resume,
                   "Go on where the same command was ended before its report was complete; what is done is "
                   "in FILE.jsonl beside the report FILE.json");
}

std::unique_ptr<verify::Journal> open_journal(const ShardArguments& a, verify::Plan plan, bool remember) {
  a.check();
  plan.shard = a.of();
  if (!is_file(a.json)) return std::make_unique<verify::Journal>(std::move(plan));
  return std::make_unique<verify::Journal>(std::move(plan), a.json + "l", a.resume,
                                           remember || !a.of().is_whole());
}

void write_part(const ShardArguments& a, const verify::Journal& journal, verify::PartReport part) {
  part.plan = journal.plan();
  part.results = journal.results();
  verify::write_text(a.json, verify::to_json(part));
}

std::string file_digest(const std::string& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) ? verify::digest(data::io::whole_content(file)) : "";
}

std::string attested(std::string report, const nlohmann::json& plan) {
  nlohmann::ordered_json by{{"program", file_digest("/proc/self/exe")},
                            {"plan", verify::digest(dumped(plan, -1))},
                            {"subjects", plan.value("stamps", nlohmann::json::array())},
                            {"meshes", nlohmann::json::array()},
                            {"level", plan.value("level", nlohmann::json())}};
  std::set<std::pair<std::string, std::string>> meshes;  // each is there at several depths
  if (plan.contains("meshes"))
    for (const nlohmann::json& mesh : plan.at("meshes")) meshes.emplace(mesh.at(0), mesh.at(1));
  for (const auto& [name, digest] : meshes) by["meshes"].push_back({name, digest});
  while (report.ends_with('\n')) report.pop_back();
  return verify::sealed("{\n \"attested\": " + dumped(by, -1) + "," + report.substr(1));
}

int run_units(const ShardArguments& a, verify::Plan plan,
              const std::function<void(verify::Journal&, Progress&)>& work,
              const std::function<int(const verify::PartReport&)>& report) {
  const verify::Clock clock;
  const auto journal = open_journal(a, std::move(plan));
  const verify::InterruptGuard guard;
  Progress progress;
  work(*journal, progress);
  progress.clear();
  const int signal = verify::interrupted();
  verify::PartReport done;
  done.seconds = clock.seconds();
  if (signal != 0) done.incomplete = fmt::format("interrupted by {}", verify::signal_name(signal));
  if (!a.of().is_whole()) write_part(a, *journal, done);
  done.plan = journal->plan(), done.results = journal->results();
  const int code = report(done);
  if (signal == 0) journal->remove();
  return code == kHeld && signal != 0 ? kSignalled + signal : code;
}

int run_jobs(int jobs, const std::function<int(int, JobCounters&)>& work,
             const std::function<void(const JobCounters&)>& show) {
  JobCounters& counters = shared_counters();
  std::fflush(nullptr);
  std::vector<pid_t> running;
  int code = 0;
  for (int job = 0; job < jobs; ++job) {
    const pid_t pid = fork();
    if (pid == 0) run_job(job, counters, work);
    if (pid < 0) {
      say(stderr, "limitcheck: a process cannot be started: {}\n", std::strerror(errno));
      code = kBadInput;
      break;
    }
    running.push_back(pid);
  }
  bool told = false;
  while (!running.empty()) {
    if (const int signal = verify::interrupted(); signal != 0 && !told) {
      for (const pid_t pid : running) kill(pid, signal);
      told = true;
    }
    std::erase_if(running, [&](pid_t pid) {
      int status = 0;
      if (waitpid(pid, &status, WNOHANG) != pid) return false;
      code = std::max(code, WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status));
      return true;
    });
    show(counters);
    usleep(50'000);
  }
  return code;
}

void add_prove(CLI::App& app, const std::function<void(const ProveRequest&)>& prove) {
  CLI::App* command = app.add_subcommand(
      "prove",
      "Prove that the kernels compute the exact limit surface, whatever the geometry, topology by topology");
  auto request = std::make_shared<ProveRequest>();
  request->depth = verify::ProofRequest().depth;
  add_choice(*command, "--scheme", request->scheme, {"loop", "catmull-clark"}, "The subdivision scheme");
  command->add_option("--valences", request->valences,
                      "Interior valences: of the triples 3:12 or a list 3,4,6; 3:8 of a quad's four corners");
  add_number(*command, "--depth", request->depth, 0, 8, "Deepest subdivision");
  add_choice(*command, "--kernel", request->kernel, {"sliding-window", "row-stream", "all"}, "The kernel");
  add_choice(*command, "--set", request->set, {"sample", "standard", "full"},
             "How much: standard takes three minutes on two cores, full some twenty; sample, every tenth "
             "topology of the standard set, takes ten seconds");
  command->add_flag("--each", request->each, "A line for every topology, not for every group of them");
  add_json_option(*command, request->shard);
  add_shard_options(*command, request->shard, "topologies");
  command->footer(
      "The table that is printed says what of each topology was proved, and to which depth; "
      "verify/proof/README.md lists both sets.\n"
      "Ctrl-C ends with the table of the proofs so far: exit code 130, or 1 if one of them failed.");
  command->add_option("--parts", request->parts, "Report these parts of --shard")->group("");
  command->callback([request, prove] { prove(*request); });
}

}  // namespace limitcheck::cli
