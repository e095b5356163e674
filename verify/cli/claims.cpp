// SPDX-License-Identifier: MIT
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "data/error.h"
#include "verify/claims/register.h"
#include "verify/cli/commands.h"
#include "verify/cli/screen.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/columns.h"

namespace limitcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Claim, verify::ClaimOutcome, verify::ClaimResult;

struct ClaimsArguments {
  std::vector<std::string> ids;
  std::string programs;
  bool json = false, errata = false;
};

std::vector<const Claim*> chosen(const std::vector<std::string>& ids) {
  std::vector<const Claim*> list;
  const auto& all = verify::claim_register();
  for (const std::string& id : ids) {
    const auto found = std::ranges::find_if(all, [&](const Claim& c) { return c.id == id; });
    if (found == all.end())
      throw data::ArgumentError(
          fmt::format("there is no claim '{}'; there are {} to {}", id, all.front().id, all.back().id));
    list.push_back(&*found);
  }
  if (ids.empty())
    for (const Claim& c : all) list.push_back(&c);
  return list;
}

// How many claims have each outcome.
std::map<ClaimOutcome, std::int64_t> outcomes(const std::vector<ClaimResult>& results) {
  std::map<ClaimOutcome, std::int64_t> count;
  for (const ClaimResult& r : results) ++count[r.outcome];
  return count;
}

std::vector<std::pair<std::string, std::int64_t>> verdicts(const std::vector<ClaimResult>& results) {
  std::vector<const Claim*> claims;
  for (const ClaimResult& r : results) claims.push_back(r.claim);
  return verify::count_verdicts(claims);
}

/// Whether our tests of a claim agree with the verdict that the register has.
const Words<ClaimOutcome> kColours{{"green", ClaimOutcome::kHeld},
                                   {"red", ClaimOutcome::kNotHeld},
                                   {"not run", ClaimOutcome::kNotRun},
                                   {"none", ClaimOutcome::kNotCheckable}};

std::string to_json(const std::vector<ClaimResult>& results) {
  Json out{{"program", "limitcheck claims"}, {"version", LIMITCHECK_VERSION}};
  auto count = outcomes(results);
  out["coverage"] = {
      {"claims", results.size()},
      {"with_check", std::ranges::count_if(results, [](const auto& r) { return !r.claim->check.empty(); })},
      {"held", count[ClaimOutcome::kHeld]},
      {"not_held", count[ClaimOutcome::kNotHeld]},
      {"not_run", count[ClaimOutcome::kNotRun]},
      {"not_checkable", count[ClaimOutcome::kNotCheckable]}};
  out["verdicts"] = Json::object();
  for (const auto& [verdict, claims] : verdicts(results)) out["verdicts"][verdict] = claims;
  out["claims"] = Json::array();
  const auto text = [](const std::string& s) { return s.empty() ? Json(nullptr) : Json(s); };
  for (const ClaimResult& r : results) {
    Json figures = Json::object();
    for (const auto& [key, value] : r.figures) figures[key] = value;
    out["claims"].push_back({{"id", r.claim->id},
                             {"place", r.claim->place},
                             {"statement", r.claim->statement},
                             {"verdict", r.claim->verdict},
                             {"note", text(r.claim->note)},
                             {"finding", text(r.finding)},
                             {"check", r.claim->check.empty() ? Json(nullptr) : Json(r.claim->check)},
                             {"outcome", verify::word(r.outcome)},
                             {"ran", r.outcome == ClaimOutcome::kHeld || r.outcome == ClaimOutcome::kNotHeld},
                             {"held", r.outcome == ClaimOutcome::kHeld},
                             {"message", text(r.message)},
                             {"measured", std::move(figures)}});
  }
  return dumped(out, 1);
}

std::string to_table(const std::vector<ClaimResult>& results) {
  const std::size_t width = screen_width(STDOUT_FILENO);
  std::string out = fmt::format("{:<4} {:<13} {:<21} {:<9} {}\n", "id", "place", "we conclude", "our tests",
                                "the paper says");
  for (const ClaimResult& r : results) {
    out += verify::wrapped(fmt::format("{:<4} {:<13} {:<21} {:<9}  {}\n", r.claim->id, r.claim->place,
                                       r.claim->verdict, word_of(kColours, r.outcome), r.claim->statement),
                           width, 6);
    for (const std::string& line : {r.claim->note, r.finding, r.message.substr(0, r.message.find('\n'))})
      if (!line.empty()) out += verify::wrapped(fmt::format("     {}\n", line), width, 5);
  }
  std::vector<std::string> conclusions, tests;
  for (const auto& [verdict, claims] : verdicts(results))
    if (claims > 0) conclusions.push_back(fmt::format("{} {}", verdict, claims));
  auto count = outcomes(results);
  for (const auto& [colour, outcome] : kColours)
    tests.push_back(fmt::format("{} {}", colour, count[outcome]));
  return out + verify::wrapped(fmt::format("\n{} claims of the paper: {}\nour tests: {}\n", results.size(),
                                           fmt::join(conclusions, ", "), fmt::join(tests, ", ")),
                               width, 2);
}

int claims(const ClaimsArguments& a) {
  if (a.errata) {
    say("{}", verify::errata());
    return kHeld;
  }
  const auto list = chosen(a.ids);
  const auto programs =
      verify::claim_programs(a.programs.empty() ? program_folder() : std::filesystem::path(a.programs));
  if (programs.empty())
    say(stderr,
        "limitcheck: the tests behind the claims are not here: they are no part of an installation, but of a "
        "build of the sources, as `bash verify/run.sh claims` makes it. What follows is the register "
        "alone.\n");
  Progress progress;
  const verify::InterruptGuard guard;
  std::vector<ClaimResult> results;
  try {
    results = verify::run_claims(list, programs,
                                 [&](const std::string& program, std::size_t done, std::size_t total) {
                                   progress.show(done, total, program);
                                 });
  } catch (const verify::Interrupted&) {
    progress.clear();
    say(stderr, "limitcheck: interrupted by {}\n", verify::signal_name(verify::interrupted()));
    return kSignalled + verify::interrupted();
  }
  progress.clear();
  if (a.json)
    say("{}", to_json(results));
  else
    say_lines(to_table(results));
  const bool held = std::ranges::all_of(results, [](const ClaimResult& r) {
    return r.outcome == ClaimOutcome::kHeld || r.outcome == ClaimOutcome::kNotCheckable;
  });
  return held ? kHeld : kFindings;
}

}  // namespace

void add_claims(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<ClaimsArguments>();
  CLI::App* command = app.add_subcommand(
      "claims", "Print our verdict on each claim of the paper, and whether its tests pass in this build");
  command->add_option("ID", a->ids, "Claims, as C14 (default: all)");
  command->add_flag("--json", a->json, "One JSON document instead of the table");
  command->add_flag("--errata", a->errata, "Write the errata of the paper as Markdown instead; runs nothing");
  command
      ->add_option("--programs", a->programs,
                   "The build folder whose test programs are run (default: the folder of this program)")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER");
  command->footer(
      "Two columns: our verdict on the paper's sentence, with figures, and whether the tests behind it pass. "
      "A claim whose tests are not built is reported as not run, never as passed.\n"
      "Exit codes: 0 all tests pass, 1 a test fails or was not run, 2 bad usage; ended by SIGINT 130, "
      "SIGTERM 143, SIGHUP 129.");
  command->callback([a, &exit_code] { exit_code = claims(*a); });
}

}  // namespace limitcheck::cli
