// SPDX-License-Identifier: MIT
// The kill table, held to what the project promises of it.
// Subjects that are right and unlike others: the default audit blames none of them.
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/audit/default_plan.h"
#include "verify/host/isolation/remote_subject.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/mutants/mutants.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// The options that give `subject`, run under `options`, the habit.
std::string unusual_options(std::string_view habit, std::string_view subject, std::string_view options = {}) {
  return fmt::format("habit={},of={}{}{}", habit, subject, options.empty() ? "" : ",", options);
}

// Of a journal or a part in which results have changed places.
TEST(Mutants, AResultIsThatOfTheMutantItNames) {
  std::map<std::size_t, nlohmann::json> results;
  for (std::size_t k = 0; k < mutants().size(); ++k)
    results[k] = {{"mutant", mutants()[k].name}, {"killed_by", nlohmann::json::array()}, {"on", "cube"}};
  EXPECT_EQ(kill_table(results).kills.size(), mutants().size());
  std::swap(results.at(3), results.at(4));
  EXPECT_THROW(kill_table(results), data::ArgumentError);
  results.erase(3);
  EXPECT_THROW(kill_table(results), data::ArgumentError);
}

TEST(Mutants, AreAtLeastAHundredAndSixtyEachWithAnotherNameAndACheckMeantForIt) {
  std::set<std::string> names;
  for (const Mutant& m : mutants()) {
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    EXPECT_FALSE(m.check.empty()) << m.name << " is meant for no check";
  }
  EXPECT_GE(names.size(), 160U);
}

TEST(Mutants, DoWhatEachLineOfTheListTells) {
  const std::string list = contents_of(LIMITCHECK_SOURCE_DIR "/verify/mutants/faults.txt");
  const std::string lines = list.substr(list.find("[faults and habits]"));
  static const std::regex line("\n[^ #\n]+ \\| ");
  const std::size_t done = all_faults().size() + habits().size() - 1;  // `none` is one of both
  EXPECT_EQ(std::distance(std::sregex_iterator(lines.begin(), lines.end(), line), std::sregex_iterator()),
            static_cast<std::ptrdiff_t>(done));
}

TEST(Mutants, AreAllKilledByTheCheckMeantForThemAndNoCheckIsIdle) {
  Journal journal(mutants_plan("", true));
  run_mutants(journal);
  const KillTable table = kill_table(journal.results());
  // A shard, of mutants and of meshes for right subjects, says the same of its units.
  Plan plan = mutants_plan("", true);
  plan.shard = {5, 89};
  Journal shard(plan);
  run_mutants(shard);
  EXPECT_GT(shard.results().size(), 3U);
  for (const auto& [unit, result] : shard.results()) EXPECT_EQ(result, journal.results().at(unit)) << unit;
  for (const Kill& k : table.kills)
    EXPECT_TRUE(k.by_its_check()) << k.mutant->name << " (" << k.mutant->description << ") is meant for "
                                  << k.mutant->check << ", killed by "
                                  << fmt::format("{}", fmt::join(k.killed_by, ", "));
  EXPECT_EQ(fmt::format("{}", fmt::join(table.idle, ", ")), "")
      << "a check without a mutant it kills is none";
  EXPECT_EQ(fmt::format("{}", fmt::join(table.red_on_correct, "\n")), "");

  int killed = 0, by_others = 0, unseen = 0;
  for (const Kill& k : table.kills)
    ++(k.bare_killed_by.contains(k.mutant->check) ? killed : k.bare_killed_by.empty() ? unseen : by_others);
  const std::string page =
      std::regex_replace(contents_of(LIMITCHECK_SOURCE_DIR "/verify/METHOD.md"), std::regex("\n *"), " ");
  const std::string words = fmt::format(
      "Of {} mutants {} are still killed by the check meant for them, {} by another check, and {} are not "
      "seen",
      table.kills.size(), killed, by_others, unseen);
  EXPECT_TRUE(says(page, words)) << words;
}

std::string options_of(const std::string& habit) {
  // Rounded to float where it computes in double; else the fast engine.
  if (habit == "rounded_double")
    return unusual_options(habit, "sliding-window", "precision=double,repair=stitch");
  return unusual_options(habit, "row-stream", "repair=stitch");
}

// The cases of the default plan with no more triangles than that at the deepest level.
// LIMITCHECK_WHOLE_PLAN=1: all of them.
std::vector<AuditMesh> cases(double triangles) {
  std::vector<AuditMesh> plan = default_plan(Level::kStandard);
  if (std::getenv("LIMITCHECK_WHOLE_PLAN") == nullptr)
    std::erase_if(plan, [&](const AuditMesh& m) {
      return std::ldexp(static_cast<double>(m.mesh.faces.size()), 2 * m.depth) > triangles;
    });
  return plan;
}

void expect_no_finding(const std::vector<AuditSubject>& subjects, const std::vector<AuditMesh>& plan) {
  Auditor auditor(0, 2, {}, Level::kStandard);
  for (const AuditMesh& m : plan)
    for (const AuditSubject& s : subjects)
      for (const Result& r : auditor.run(s, m))
        EXPECT_FALSE(is_bad(r)) << fmt::format("{} on {} (depth {}, {}) / {}: {}", r.subject, m.name, m.depth,
                                               m.depths, r.check, r.message);
}

TEST(UnusualSubjects, AreTwentyAtLeast) {
  EXPECT_GE(habits().size(), 1 + 20U);
}

TEST(UnusualSubjects, AreNotBlamed) {
  std::vector<AuditSubject> subjects;
  for (const Habit& habit : habits())
    if (!habit.of_the_process) subjects.push_back({lc_subject_unusual(), options_of(habit.name)});
  expect_no_finding(subjects, cases(1000));
}

// Those that do something to their process, each in a worker of its own.
std::vector<std::string> habits_of_the_process() {
  std::vector<std::string> names;
  for (const Habit& habit : habits())
    if (habit.of_the_process) names.push_back(habit.name);
  return names;
}

[[maybe_unused]] const bool kKept = (use_keeper(LIMITCHECK_KEEPER), true);

class UnusualSubject : public testing::TestWithParam<std::string> {};

TEST_P(UnusualSubject, IsNotBlamedForWhatItDoesToItsProcess) {
  IsolationSettings settings{.worker = LIMITCHECK_PROGRAM};
  const RemoteSubject remote(RemoteSubject::Kind::kBuiltIn, "unusual", settings);
  expect_no_finding({{&remote.subject(), options_of(GetParam())}}, cases(40));
}

INSTANTIATE_TEST_SUITE_P(OfAHabit, UnusualSubject, testing::ValuesIn(habits_of_the_process()),
                         [](const auto& of) { return of.param; });

// Between other meshes, in a worker of its own, too.
TEST(UnusualSubjects, KeepTheMeshThatTheyWereLentIfTheyLike) {
  IsolationSettings settings{.worker = LIMITCHECK_PROGRAM};
  const RemoteSubject plain(RemoteSubject::Kind::kBuiltIn, "unusual", settings);
  settings.in_turns = true;
  const RemoteSubject turns(RemoteSubject::Kind::kBuiltIn, "unusual", settings);
  const std::string options = unusual_options("keeps_the_mesh", "row-stream");
  expect_no_finding({{lc_subject_unusual(), options}, {&plain.subject(), options, &turns.subject()}},
                    {{"octahedron", data::named_mesh("octahedron")}});
}

}  // namespace
}  // namespace limitcheck::verify
