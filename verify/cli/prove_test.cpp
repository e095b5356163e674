// SPDX-License-Identifier: MIT
// `limitcheck prove` as a user meets it. That a fault is found is the business of
// verify/proof/maps/fault_test.cpp.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class ProveCommand : public CommandTest {};

TEST_F(ProveCommand, PrintsOneJsonDocumentWithARowForEveryTopologyAndKernel) {
  const Outcome o = run("prove --depth 0 --valences 3,4 --kernel sliding-window --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_TRUE(json["held"].get<bool>());
  EXPECT_EQ(json["impossible"], nlohmann::json({"3 3 4"}));
  bool bounds = false;
  for (const auto& row : json["rows"]) {
    EXPECT_EQ(row["map"], "equal") << row;
    EXPECT_GT(row["points"].get<int>(), 0) << row;
    if (row["arithmetic"] == "digits" && !row["digits"].is_null()) {
      EXPECT_GE(row["digits"].get<double>(), 45) << row;
    }
    if (!row.contains("bound")) continue;
    bounds = true;
    EXPECT_LE(row["worst"].get<double>(), row["bound"].get<double>()) << row;
  }
  EXPECT_TRUE(bounds);
}

TEST_F(ProveCommand, KnowsCatmullClarksScheme) {
  const Outcome o =
      run("prove --scheme catmull-clark --depth 0 --valences 3,5 --kernel sliding-window --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto json = nlohmann::json::parse(o.out);
  EXPECT_EQ(json["scheme"], "catmull-clark");
  EXPECT_TRUE(json["held"].get<bool>());
  std::map<std::string, int> groups;
  for (const auto& row : json["rows"]) {
    EXPECT_EQ(row["map"], "equal") << row;
    ++groups[row["group"]];
    if (!row.contains("bound")) continue;
    EXPECT_LE(row["worst"].get<double>(), row["bound"].get<double>()) << row;
  }
  for (const char* group : {"quadruples", "deep", "high", "boundary", "cuts", "darts", "semi-sharp"})
    EXPECT_GT(groups[group], 0) << group;
}

TEST_F(ProveCommand, RefusesBadUsageWithExitCodeTwo) {
  for (const char* arguments : {"--valences 2:4", "--valences 6:3", "--valences 6,x", "--valences 21",
                                "--depth 9", "--kernel naive", "--set all", "--scheme doo-sabin"}) {
    const Outcome o = run(std::string("prove ") + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_EQ(o.out, "") << arguments;
    EXPECT_NE(o.err, "") << arguments;
  }
}

}  // namespace
}  // namespace limitcheck::cli
