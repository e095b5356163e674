// SPDX-License-Identifier: MIT
#include "verify/mutants/mutants.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "verify/cli/commands.h"
#include "verify/cli/progress.h"

namespace limitcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Kill;
using verify::KillTable;

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
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
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

void add_mutants(CLI::App& app, int& exit_code) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("mutants", "Let the audit loose on faulty tessellators: what each check catches");
  command->add_flag("--json", *json, "One JSON document instead of the table");
  command->footer(
      "Exit codes: 0 every mutant is killed by the check meant for it, every check kills one, and correct "
      "subjects have no finding; 1 otherwise.");
  command->callback([json, &exit_code] {
    Progress progress;
    const KillTable table = verify::run_mutants([&](const std::string& what, std::size_t done,
                                                    std::size_t total) { progress.show(done, total, what); });
    progress.clear();
    fmt::print("{}", *json ? to_json(table) : to_table(table));
    exit_code = table.held() ? kHeld : kFindings;
  });
}

}  // namespace limitcheck::cli
