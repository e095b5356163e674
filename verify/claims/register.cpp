// SPDX-License-Identifier: MIT
// The claims' tests are GoogleTest programs: asked what they have, run once each with a filter, and read by
// the JSON they write.
#include "verify/claims/register.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <thread>

#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace fs = std::filesystem;

extern const char kClaimRegister[];  // generated from claims.json

const std::vector<Claim>& claim_register() {
  static const std::vector<Claim> claims = [] {
    const auto json = nlohmann::json::parse(kClaimRegister);
    std::vector<Claim> list;
    for (const auto& row : json["claims"]) {
      const auto text = [&](const char* key) { return row.value(key, std::string()); };
      list.push_back(
          {text("id"), text("place"), text("statement"), text("verdict"), text("note"), text("finding"),
           text("why"),
           row["check"].is_null() ? std::vector<std::string>{} : std::vector<std::string>(row["check"])});
    }
    return list;
  }();
  return claims;
}

std::vector<std::pair<std::string, std::int64_t>> count_verdicts(const std::vector<const Claim*>& claims) {
  std::vector<std::pair<std::string, std::int64_t>> counts;
  const auto json = nlohmann::ordered_json::parse(kClaimRegister);
  for (const auto& item : json["verdicts"].items())
    counts.emplace_back(
        item.key(), std::ranges::count_if(claims, [&](const Claim* c) { return c->verdict == item.key(); }));
  return counts;
}

std::string_view word(ClaimOutcome outcome) {
  constexpr std::string_view kWords[]{"held", "not held", "not run", "not checkable"};
  return kWords[static_cast<std::size_t>(outcome)];
}

std::vector<std::filesystem::path> claim_programs(const std::filesystem::path& folder) {
  const fs::path home = folder.empty() ? fs::read_symlink("/proc/self/exe").parent_path() : folder;
  std::vector<fs::path> programs;
  std::ifstream in(home / "claims_programs.txt");
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && fs::exists(home / line)) programs.push_back(home / line);
  return programs;
}

std::string errata() {
  std::string out =
      "# Errata\n\nK. Müller and S. Havemann, \"Subdivision Surface Tessellation on the Fly using a "
      "versatile Mesh Data\nStructure\", 2000. Written by `limitcheck claims --errata` from the register of "
      "claims; each line has tests\nthat re-derive it (`limitcheck claims ID`).\n";
  const struct {
    const char *verdict, *title, *column;
  } sections[]{{"misprint", "Wrong as printed", "correction"},
               {"refuted", "Not true", "what is true"},
               {"admitted by the paper", "No guarantee, as the paper says itself", "what is true"},
               {"depends", "True or not by what is left open", "on what it depends"},
               {"ambiguous", "Left open by the text", "what is missing, and our reading"}};
  const auto cell = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
      text.insert(at, 1, '\\');
    return text;
  };
  for (const auto& section : sections) {
    out += fmt::format("\n## {}\n\n| id | place | claim, in our words | {} |\n|---|---|---|---|\n",
                       section.title, section.column);
    for (const Claim& c : claim_register()) {
      if (c.verdict != section.verdict) continue;
      out += fmt::format("| {} | {} | {} | {} |\n", c.id, cell(c.place), cell(c.statement), cell(c.note));
    }
  }
  return out;
}

namespace {

// A folder of our own that goes away.
class Scratch {
 public:
  Scratch() {
    if (mkdtemp(folder_.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path file(const char* name) const { return fs::path(folder_) / name; }

 private:
  std::string folder_ = (fs::temp_directory_path() / "limitcheck-claims-XXXXXX").string();
};

// Runs a program, whose output nobody reads. Whether it ended by itself, in time. Throws Interrupted.
bool run(const fs::path& program, std::vector<std::string> words) {
  constexpr auto kLimit = std::chrono::minutes(10);
  words.insert(words.begin(), program.string());
  std::vector<char*> argv;
  for (auto& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
    execv(argv[0], argv.data());
    _exit(127);
  }
  if (child < 0) return false;
  const auto deadline = std::chrono::steady_clock::now() + kLimit;
  int status = 0;
  for (auto pause = std::chrono::milliseconds(1); waitpid(child, &status, WNOHANG) == 0;) {
    const bool stop = interrupted() != 0;
    if (stop || std::chrono::steady_clock::now() > deadline) {
      kill(-child, SIGKILL);  // and what it has started
      waitpid(child, &status, 0);
      if (stop) throw Interrupted();
      return false;
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(50));
  }
  return WIFEXITED(status);
}

// "Prefix/Suite/0", "Name/3": the names in the sources are Suite and Name.
std::string plain(const std::string& suite, const std::string& name) {
  std::string s = suite;
  if (const auto last = s.rfind('/');
      last != std::string::npos && s.find_first_not_of("0123456789", last + 1) == std::string::npos)
    s.resize(last);
  if (const auto slash = s.rfind('/'); slash != std::string::npos) s.erase(0, slash + 1);
  return s + "." + name.substr(0, name.find('/'));
}

// What a program writes about its tests as JSON; nothing if it does not come to that.
std::optional<nlohmann::json> written_by(const fs::path& program, const std::string& flag,
                                         const Scratch& scratch) {
  const fs::path report = scratch.file("report.json");
  fs::remove(report);
  const bool ended = run(program, {flag, "--gtest_output=json:" + report.string()});
  const auto json = nlohmann::json::parse(std::ifstream(report), nullptr, false);
  return ended && !json.is_discarded() ? std::optional(json) : std::nullopt;
}

struct TestResult {
  bool passed = true;
  std::string failure;
  std::vector<std::pair<std::string, std::string>> figures;
};

void take(const nlohmann::json& json, std::map<std::string, TestResult>& results) {
  static const std::set<std::string> own{"name",   "value_param", "type_param", "status",
                                         "result", "file",        "line",       "timestamp",
                                         "time",   "classname",   "claim",      "failures"};
  for (const auto& suite : json["testsuites"])
    for (const auto& test : suite["testsuite"]) {
      if (test.value("status", "") != "RUN") continue;
      TestResult& r = results[plain(test["classname"], test["name"])];
      if (test.contains("failures")) {
        r.passed = false;
        if (r.failure.empty()) r.failure = test["failures"][0].value("failure", "failed");
      }
      for (const auto& [key, value] : test.items())
        if (!own.contains(key))
          r.figures.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    }
}

// Puts the figures into the claim's finding. A name that no test recorded is a mistake in the register, and
// red.
void tell_finding(ClaimResult& r) {
  const std::string& words = r.claim->finding;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t open = words.find('{', at), close = words.find('}', std::min(open, words.size()));
    r.finding += words.substr(at, open - at);
    if (open == std::string::npos || close == std::string::npos) return;
    const std::string name = words.substr(open + 1, close - open - 1);
    const auto figure =
        std::ranges::find_if(r.figures, [&](const auto& recorded) { return recorded.first == name; });
    r.finding += figure != r.figures.end() ? figure->second : "?";
    if (figure == r.figures.end() && r.outcome == ClaimOutcome::kHeld) {
      r.outcome = ClaimOutcome::kNotHeld;
      r.message = fmt::format("no test records the figure '{}' that the finding names", name);
    }
    at = close + 1;
  }
}

}  // namespace

std::vector<ClaimResult> run_claims(
    const std::vector<const Claim*>& claims, const std::vector<fs::path>& programs,
    const std::function<void(const std::string&, std::size_t, std::size_t)>& on_program) {
  std::set<std::string> wanted;
  for (const Claim* c : claims) wanted.insert(c->check.begin(), c->check.end());

  const Scratch scratch;
  std::map<std::string, TestResult> results;
  std::map<std::string, std::string> broken;  // test: program that did not live to report on it
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const std::string name = programs[k].filename().string();
    if (on_program) on_program(name, k, programs.size());
    const auto listed = written_by(programs[k], "--gtest_list_tests", scratch);
    if (!listed) continue;
    std::string filter;
    std::vector<std::string> asked;
    for (const auto& suite : (*listed)["testsuites"])
      for (const auto& test : suite["testsuite"]) {
        const std::string in = suite["name"], called = test["name"];
        if (!wanted.contains(plain(in, called))) continue;
        filter += fmt::format("{}{}.{}", filter.empty() ? "" : ":", in, called);
        asked.push_back(plain(in, called));
      }
    if (asked.empty()) continue;
    if (const auto json = written_by(programs[k], "--gtest_filter=" + filter, scratch))
      take(*json, results);
    else
      for (const auto& t : asked) broken[t] = name;
  }

  std::vector<ClaimResult> out;
  for (const Claim* c : claims) {
    ClaimResult r{c, c->check.empty() ? ClaimOutcome::kNotCheckable : ClaimOutcome::kHeld, c->why, {}, {}};
    for (const std::string& test : c->check) {
      const auto found = results.find(test);
      if (found == results.end()) {
        if (r.outcome == ClaimOutcome::kNotHeld) continue;
        r.outcome = ClaimOutcome::kNotRun;
        r.message =
            broken.contains(test)
                ? fmt::format("{} broke down before {} had ended", broken[test], test)
                : fmt::format("the program with {} is not here (it is part of a build with tests)", test);
        continue;
      }
      if (!found->second.passed && r.outcome != ClaimOutcome::kNotHeld) {
        r.outcome = ClaimOutcome::kNotHeld;
        r.message = fmt::format("{}: {}", test, found->second.failure);
      }
      r.figures.insert(r.figures.end(), found->second.figures.begin(), found->second.figures.end());
    }
    if (r.outcome == ClaimOutcome::kHeld || r.outcome == ClaimOutcome::kNotHeld) tell_finding(r);
    out.push_back(std::move(r));
  }
  return out;
}

}  // namespace limitcheck::verify
