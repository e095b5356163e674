// SPDX-License-Identifier: MIT
#include "verify/mutants/mutants.h"

#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "verify/cli/commands.h"
#include "verify/cli/units.h"
#include "verify/interrupt/interrupt.h"
#include "verify/report/columns.h"
#include "verify/report/json.h"

namespace limitcheck::cli {
namespace {

using Json = nlohmann::ordered_json;
using verify::Kill, verify::KillTable;

std::string to_json(const KillTable& table) {
  Json out{{"program", "limitcheck mutants"}, {"version", LIMITCHECK_VERSION}, {"held", table.held()}};
  out["mutants"] = Json::array();
  for (const Kill& k : table.kills) {
    Json& one = out["mutants"].emplace_back(
        Json{{"name", k.mutant->name},
             {"description", k.mutant->description},
             {"subject", fmt::format("{}:{}", k.mutant->subject, k.mutant->options)},
             {"claim", k.mutant->claim.empty() ? Json(nullptr) : Json(k.mutant->claim)},
             {"check", k.mutant->check},
             {"killed", !k.killed_by.empty()},
             {"killed_by_check", k.by_its_check()},
             {"killed_by", k.killed_by},
             {"case", k.on.empty() ? Json(nullptr) : Json(k.on)}});
    if (k.bare_cases >= 0)
      one["without_provenance"] = {{"cases", k.bare_cases},
                                   {"killed_by_check", k.bare_killed_by.contains(k.mutant->check)},
                                   {"killed_by", k.bare_killed_by}};
  }
  out["idle_checks"] = table.idle;
  out["red_on_correct_subjects"] = table.red_on_correct;
  return dumped(out, 1);
}

// What becomes of a mutant that does not say where its points lie.
std::string without_provenance(const Kill& k) {
  if (k.bare_killed_by.contains(k.mutant->check)) return "killed";
  if (!k.bare_killed_by.empty()) return *k.bare_killed_by.begin();
  return k.bare_cases > 0 ? "NOT SEEN" : "-";
}

std::string to_table(const KillTable& table) {
  const bool bare = std::ranges::any_of(table.kills, [](const Kill& k) { return k.bare_cases >= 0; });
  const verify::Screen screen{false, screen_width(STDOUT_FILENO)};
  std::vector<verify::Column> columns{
      {"mutant", 26}, {.title = "claim", .least = 5, .leaves = 2}, {"meant for", 26}, {"verdict", 8}};
  if (bare) columns.push_back({"without provenance", 26});
  columns.push_back({.title = "on", .least = 28, .leaves = 3});
  columns.push_back({.title = "also killed by", .least = 1, .leaves = 1});
  std::vector<verify::TableRow> rows;
  for (const Kill& k : table.kills) {
    auto others = k.killed_by;
    others.erase(k.mutant->check);
    const char* verdict = k.by_its_check() ? "killed" : k.killed_by.empty() ? "SURVIVED" : "ASTRAY";
    rows.push_back({{{k.mutant->name},
                     {k.mutant->claim.empty() ? "-" : k.mutant->claim},
                     {k.mutant->check},
                     {verdict}}});
    if (bare) rows.back().cells.push_back({without_provenance(k)});
    rows.back().cells.push_back({k.on.empty() ? "-" : k.on});
    rows.back().cells.push_back({fmt::format("{}", fmt::join(others, ", "))});
  }
  std::string out = verify::table(columns, rows, screen, 0);
  const auto killed = std::ranges::count_if(table.kills, [](const Kill& k) { return k.by_its_check(); });
  out += fmt::format("\n{} mutants, {} killed by the check meant for them; {} checks kill nothing{}\n",
                     table.kills.size(), killed, table.idle.size(),
                     table.idle.empty() ? "" : fmt::format(": {}", fmt::join(table.idle, ", ")));
  if (bare) {
    std::map<std::string, int> count;
    for (const Kill& k : table.kills) ++count[without_provenance(k)];
    const int killed_bare = count["killed"], unseen = count["NOT SEEN"], unasked = count["-"];
    out += fmt::format(
        "Without provenance {} are killed by the check meant for them, {} by another (named), {} are not "
        "seen; {} need unequal depths\n",
        killed_bare, static_cast<int>(table.kills.size()) - killed_bare - unseen - unasked, unseen, unasked);
  }
  for (const std::string& red : table.red_on_correct) out += fmt::format("RED ON A RIGHT SUBJECT: {}\n", red);
  return verify::wrapped(out, screen.width);
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
  struct Arguments : ShardArguments {
    bool without_provenance = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("mutants", "Let the audit loose on faulty tessellators: what each check catches");
  add_json_option(*command, *a);
  add_shard_options(*command, *a, "mutants, and of the meshes for right subjects");
  command->add_flag("--without-provenance", a->without_provenance,
                    "Audit each mutant a second time as a tessellator that does not say where its points "
                    "lie, and show both side by side");
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
    exit_code = run_units(*a, verify::mutants_plan(LIMITCHECK_VERSION, a->without_provenance), work,
                          [&](const verify::PartReport& done) { return report_mutants(done, a->json); });
  });
}

}  // namespace limitcheck::cli
