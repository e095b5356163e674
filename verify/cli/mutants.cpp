// SPDX-License-Identifier: MIT
#include "verify/mutants/mutants.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "verify/cli/commands.h"
#include "verify/cli/units.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Kill, verify::KillTable;

std::string to_json(const KillTable& table) {
  Json out{{"program", "limitcheck mutants"}, {"version", LIMITCHECK_VERSION}, {"held", table.held()}};
  out["mutants"] = Json::array();
  for (const Kill& k : table.kills)
    out["mutants"].push_back({{"name", k.mutant->name},
                              {"description", k.mutant->description},
                              {"subject", fmt::format("{}:{}", k.mutant->subject, k.mutant->options)},
                              {"claim", k.mutant->claim.empty() ? Json(nullptr) : Json(k.mutant->claim)},
                              {"check", k.mutant->check},
                              {"killed", !k.killed_by.empty()},
                              {"killed_by_check", k.by_its_check()},
                              {"killed_by", k.killed_by},
                              {"case", k.on.empty() ? Json(nullptr) : Json(k.on)}});
  out["idle_checks"] = table.idle;
  out["red_on_correct_subjects"] = table.red_on_correct;
  return dumped(out, 1);
}

std::string to_table(const KillTable& table) {
  std::string out = fmt::format("{:<26} {:<5} {:<26} {:<8} {:<28} {}\n", "mutant", "claim", "meant for",
                                "verdict", "on", "also killed by");
  for (const Kill& k : table.kills) {
    auto others = k.killed_by;
    others.erase(k.mutant->check);
    out += fmt::format("{:<26} {:<5} {:<26} {:<8} {:<28} {}\n", k.mutant->name,
                       k.mutant->claim.empty() ? "-" : k.mutant->claim, k.mutant->check,
                       k.by_its_check()      ? "killed"
                       : k.killed_by.empty() ? "SURVIVED"
                                             : "ASTRAY",
                       k.on.empty() ? "-" : k.on, fmt::join(others, ", "));
  }
  const auto killed =
      std::count_if(table.kills.begin(), table.kills.end(), [](const Kill& k) { return k.by_its_check(); });
  out += fmt::format("\n{} mutants, {} killed by the check meant for them; {} checks kill nothing{}\n",
                     table.kills.size(), killed, table.idle.size(),
                     table.idle.empty() ? "" : fmt::format(": {}", fmt::join(table.idle, ", ")));
  for (const std::string& red : table.red_on_correct) out += fmt::format("RED ON A RIGHT SUBJECT: {}\n", red);
  return out;
}

}  // namespace

int report_mutants(const verify::PartReport& done, const std::string& json) {
  if (!done.incomplete.empty()) {
    say(stderr, "limitcheck: {}\n", done.incomplete);
    return kHeld;
  }
  if (!done.plan.shard.is_whole()) {
    say("shard {}: {} of {} units\n", done.plan.shard.text(), done.results.size(), done.plan.units);
    return kHeld;
  }
  const KillTable table = verify::kill_table(done.results);
  const std::string text = json.empty() ? to_table(table) : attested(to_json(table), done.plan.what);
  if (!json.empty() && json != "-") verify::write_text(json, text);
  say_text(stdout, json.empty() || json == "-" ? text : to_table(table));
  return table.held() ? kHeld : kFindings;
}

void add_mutants(CLI::App& app, int& exit_code) {
  auto a = std::make_shared<ShardArguments>();
  CLI::App* command =
      app.add_subcommand("mutants", "Let the audit loose on faulty tessellators: what each check catches");
  add_json_option(*command, *a);
  add_shard_options(*command, *a, "mutants, and of the meshes for right subjects");
  command->footer(
      "Exit codes: 0 every mutant is killed by the check meant for it, every check kills one, and correct "
      "subjects have no finding (of a shard: it is done, and limitcheck merge will say); 1 otherwise; 130 "
      "and the like after a signal.");
  command->callback([a, &exit_code] {
    const auto work = [](verify::Journal& journal, Progress& progress) {
      verify::run_mutants(
          journal,
          [&](const std::string& what, std::size_t done, std::size_t total) {
            progress.show(done, total, what);
          },
          [] { return verify::interrupted() != 0; });
    };
    exit_code = run_units(*a, verify::mutants_plan(LIMITCHECK_VERSION), work,
                          [&](const verify::PartReport& done) { return report_mutants(done, a->json); });
  });
}

}  // namespace limitcheck::cli
