// SPDX-License-Identifier: MIT
// `limitcheck prove` as a user meets it. That a fault is found is the business of
// verify/proof/maps/fault_test.cpp.
// `limitcheck claims` as a user meets it.
#include <gtest/gtest.h>
#include <unistd.h>

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
  const auto json =
      json_of("prove --scheme catmull-clark --depth 0 --valences 3,5 --kernel sliding-window --json", 0);
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
  expect_refused("prove", {"--valences 2:4", "--valences 6:3", "--valences 6,x", "--valences 21", "--depth 9",
                           "--kernel naive", "--set all", "--scheme doo-sabin"});
}

class ClaimsCommand : public CommandTest {};

TEST_F(ClaimsCommand, WithoutItsTestProgramsNothingIsConfirmed) {
  const Outcome o = run("claims --json --programs .");  // as where only the program is installed
  EXPECT_EQ(o.code, 1);
  EXPECT_TRUE(says(o.err, "What follows is the register alone."));
  const auto json = nlohmann::json::parse(o.out);
  ASSERT_EQ(json["claims"].size(), 86U);
  for (const auto& claim : json["claims"]) {
    EXPECT_EQ(claim["held"], false) << claim;
    EXPECT_EQ(claim["ran"], false) << claim;
    EXPECT_EQ(claim["outcome"], claim["check"].is_null() ? "not checkable" : "not run") << claim;
    EXPECT_FALSE(claim["message"].is_null()) << claim;
  }
  EXPECT_EQ(json["coverage"]["held"], 0);
  EXPECT_EQ(json["verdicts"]["not checkable"], 4) << "what we conclude does not depend on what is installed";
}

TEST_F(ClaimsCommand, ACommandThatAnInstallationLacksSaysWhereItIs) {
  for (const std::string command : {"bench", "reproduce"}) {
    const Outcome o = shell("cp '" LIMITCHECK_PROGRAM "' alone && ./alone " + command);
    EXPECT_EQ(o.code, 2) << command;
    EXPECT_TRUE(says(o.err, "`bash verify/run.sh " + command + "` makes it"));
  }
}

TEST_F(ClaimsCommand, SaysWhatIsConcludedAndWhetherTheTestsAreGreenInColumnsOfTheirOwn) {
  const Outcome o = run("claims C31 C80 --programs .");
  EXPECT_TRUE(says(o.out, "we conclude    our tests"));
  EXPECT_TRUE(says(o.out, "refuted        not run "));
  EXPECT_TRUE(says(o.out, "not checkable  none"));
  EXPECT_TRUE(says(o.out, "2 claims of the paper: refuted 1, not checkable 1"));
  EXPECT_TRUE(says(o.out, "our tests: green 0, red 0, not run 1, none 1"));
}

// Neither the test program, nor what that has started, nor the folder for their output.
TEST_F(ClaimsCommand, ASignalLeavesNothingBehind) {
  write("claims_programs.txt", "hangs\n");
  const std::string unique = std::to_string(getpid()) + "002";
  write("hangs", "#!/bin/sh\nsleep " + unique + " &\ntouch up\nwait\n");
  std::filesystem::permissions(folder_ / "hangs", std::filesystem::perms::owner_all);
  for (const auto& [signal, code] : {std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 129}}) {
    std::filesystem::remove(folder_ / "up");
    const Outcome o = signalled("claims C14 --programs .", "[ -e up ]", signal, unique);
    EXPECT_EQ(o.code, code) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_EQ(o.err, "limitcheck: interrupted by SIG" + std::string(signal) + "\n");
  }
}

TEST_F(ClaimsCommand, AnUnknownClaimIsBadUsage) {
  const Outcome o = run("claims C87");
  EXPECT_EQ(o.code, 2);
  EXPECT_TRUE(says(o.err, "C01 to C86"));
}

TEST_F(ClaimsCommand, WritesTheErrata) {
  const Outcome o = run("claims --errata");
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(says(o.out, "| C69 | Appendix A |"));
}

}  // namespace
}  // namespace limitcheck::cli
