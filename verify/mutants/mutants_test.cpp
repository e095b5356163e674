// SPDX-License-Identifier: MIT
// The kill table, held to what the project promises of it.
#include "verify/mutants/mutants.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "data/error.h"

namespace limitcheck::verify {
namespace {

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
