// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "verify/claims/register.h"
#include "verify/cli/commands.h"
#include "verify/cli/progress.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Claim;
using verify::ClaimOutcome;
using verify::ClaimResult;

struct Arguments {
  std::vector<std::string> ids;
  std::string programs;
  bool json = false, errata = false;
};

std::vector<const Claim*> chosen(const std::vector<std::string>& ids) {
  std::vector<const Claim*> list;
  const auto& all = verify::claim_register();
  for (const std::string& id : ids) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Claim& c) { return c.id == id; });
    if (found == all.end())
      throw std::invalid_argument(
          fmt::format("there is no claim '{}'; there are {} to {}", id, all.front().id, all.back().id));
    list.push_back(&*found);
  }
  if (ids.empty())
    for (const Claim& c : all) list.push_back(&c);
  return list;
}

struct Coverage {
  std::int64_t claims = 0, with_check = 0;
  std::map<ClaimOutcome, std::int64_t> outcomes;
};

Coverage coverage(const std::vector<ClaimResult>& results) {
  Coverage c;
  for (const ClaimResult& r : results) {
    ++c.claims;
    c.with_check += !r.claim->check.empty();
    ++c.outcomes[r.outcome];
  }
  return c;
}

std::string to_json(const std::vector<ClaimResult>& results) {
  Json out{{"program", "limitcheck claims"}, {"version", LIMITCHECK_VERSION}};
  Coverage c = coverage(results);
  out["coverage"] = {{"claims", c.claims},
                     {"with_check", c.with_check},
                     {"held", c.outcomes[ClaimOutcome::kHeld]},
                     {"not_held", c.outcomes[ClaimOutcome::kNotHeld]},
                     {"not_run", c.outcomes[ClaimOutcome::kNotRun]},
                     {"not_checkable", c.outcomes[ClaimOutcome::kNotCheckable]}};
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
                             {"check", r.claim->check.empty() ? Json(nullptr) : Json(r.claim->check)},
                             {"outcome", verify::word(r.outcome)},
                             {"ran", r.outcome == ClaimOutcome::kHeld || r.outcome == ClaimOutcome::kNotHeld},
                             {"held", r.outcome == ClaimOutcome::kHeld},
                             {"message", text(r.message)},
                             {"measured", std::move(figures)}});
  }
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const std::vector<ClaimResult>& results) {
  std::string out =
      fmt::format("{:<4} {:<14} {:<14} {:<14} {}\n", "id", "place", "verdict", "outcome", "claim");
  for (const ClaimResult& r : results) {
    out += fmt::format("{:<4} {:<14} {:<14} {:<14} {}\n", r.claim->id, r.claim->place, r.claim->verdict,
                       verify::word(r.outcome), r.claim->statement);
    if (!r.message.empty()) out += fmt::format("     {}\n", r.message.substr(0, r.message.find('\n')));
  }
  Coverage c = coverage(results);
  out += fmt::format(
      "\n{} claims, {} with a check: {} held, {} not held, {} not run; {} not checkable\n"
      "(held: the tests that re-derive the verdict ran and passed; a misprint that held is a misprint)\n",
      c.claims, c.with_check, c.outcomes[ClaimOutcome::kHeld], c.outcomes[ClaimOutcome::kNotHeld],
      c.outcomes[ClaimOutcome::kNotRun], c.outcomes[ClaimOutcome::kNotCheckable]);
  return out;
}

int claims(const Arguments& a) {
  if (a.errata) {
    fmt::print("{}", verify::errata());
    return kHeld;
  }
  const auto list = chosen(a.ids);
  Progress progress;
  const verify::InterruptGuard guard;
  std::vector<ClaimResult> results;
  try {
    results = verify::run_claims(list, verify::claim_programs(a.programs),
                                 [&](const std::string& program, std::size_t done, std::size_t total) {
                                   progress.show(done, total, program);
                                 });
  } catch (const verify::Interrupted&) {
    progress.clear();
    fmt::print(stderr, "limitcheck: interrupted by {}\n", verify::signal_name(verify::interrupted()));
    return kSignalled + verify::interrupted();
  }
  progress.clear();
  fmt::print("{}", a.json ? to_json(results) : to_table(results));
  const bool held = std::all_of(results.begin(), results.end(), [](const ClaimResult& r) {
    return r.outcome == ClaimOutcome::kHeld || r.outcome == ClaimOutcome::kNotCheckable;
  });
  return held ? kHeld : kFindings;
}

}  // namespace

void add_claims(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("claims", "Rerun the paper's claims and say which verdicts hold");
  command->add_option("ID", a->ids, "Claims, as C14 (default: all)");
  command->add_flag("--json", a->json, "One JSON document instead of the table");
  command->add_flag("--errata", a->errata, "Write the errata of the paper as Markdown instead; runs nothing");
  command
      ->add_option("--programs", a->programs,
                   "The build folder whose test programs are run (default: the folder of this program)")
      ->check(CLI::ExistingDirectory)
      ->type_name("FOLDER");
  command->footer(
      "A claim whose tests are not here is reported as not run, never as held.\n"
      "Exit codes: 0 all held, 1 something did not hold or was not run, 2 bad usage; ended by SIGINT 130, "
      "SIGTERM "
      "143, SIGHUP 129.");
  command->callback([a, &exit_code] { exit_code = claims(*a); });
}

}  // namespace limitcheck::cli
