// SPDX-License-Identifier: MIT
// The kill table, held to what the project promises of it.
#include "verify/mutants/mutants.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace limitcheck::verify {
namespace {

TEST(Mutants, AreAtLeastAHundredAndSixtyEachWithAnotherNameAndACheckMeantForIt) {
  std::set<std::string> names;
  for (const Mutant& m : mutants()) {
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    EXPECT_FALSE(m.check.empty()) << m.name << " is meant for no check";
  }
  EXPECT_GE(names.size(), 160U);
}

TEST(Mutants, AreAllKilledByTheCheckMeantForThemAndNoCheckIsIdle) {
  Journal journal(mutants_plan(""));
  run_mutants(journal);
  const KillTable table = kill_table(journal.results());
  // A shard, of mutants and of meshes for right subjects, says the same of its units.
  Plan plan = mutants_plan("");
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
}

}  // namespace
}  // namespace limitcheck::verify
