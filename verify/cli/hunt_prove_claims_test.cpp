// SPDX-License-Identifier: MIT
// `limitcheck hunt`, `prove` and `claims` as a user meets them. That a fault is found is the business of
// verify/proof/maps/fault_test.cpp.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>

#include <unistd.h>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class HuntCommand : public CommandTest {
 protected:
  // Without what differs from run to run.
  json report(const std::string& file) const {
    json r = json_in(file);
    r.erase("seconds"), r.erase("digest");  // the digest is of the seconds, too
    return r;
  }
  static constexpr const char* kHunt =
      "hunt faulty --option fault=adjacent_extraordinary,of=sliding-window --scheme loop --cases 32 "
      "--attempts 10 --in-process ";
};

TEST_F(HuntCommand, SmallMeshesAndCommandsShowWhatWasFound) {
  const Outcome o = run(std::string(kHunt) + "--json r.json --junit r.xml --witnesses w", 1);
  EXPECT_TRUE(says(o.out, "beside another extraordinary one"));
  EXPECT_TRUE(says(read("r.xml"), "beside another extraordinary one"));
  const json r = report("r.json");
  int small = 0;
  for (const json& f : r["findings"]) {
    EXPECT_GT(f["cases"], 0);
    if (f["witness"] == "" || f["check"] != "positions" || ++small > 1) continue;
    EXPECT_TRUE(std::filesystem::exists(folder_ / std::string(f["witness"]) / "control.obj"));
    const std::string command = f["command"].get<std::string>().substr(std::string("limitcheck ").size());
    EXPECT_EQ(run(command).code, 1) << command << ": the command shows a difference";
    EXPECT_EQ(run(f["found_on"].get<std::string>().substr(std::string("limitcheck ").size())).code, 1);
  }
  EXPECT_GT(small, 0);
  for (const auto& file : std::filesystem::directory_iterator(folder_))
    EXPECT_FALSE(says(file.path().string(), ".part")) << file.path();
  const Outcome again = run(std::string(kHunt) + "--baseline r.json", 0);
}

TEST_F(HuntCommand, PartsAreMergedToTheWhole) {
  EXPECT_EQ(run(std::string(kHunt) + "--json whole.json --jobs 1").code, 1);
  EXPECT_EQ(run(std::string(kHunt) + "--json jobs.json --jobs 3").code, 1);
  EXPECT_EQ(report("jobs.json"), report("whole.json"));
  for (const char* k : {"1", "2"})
    EXPECT_EQ(run(std::string(kHunt) + "--jobs 2 --shard " + k + "/2 --json part" + k + ".json").code, 1);
  EXPECT_EQ(run("merge part2.json part1.json -o merged.json").code, 1);
  EXPECT_EQ(report("merged.json"), report("whole.json"));
  expect_refused("merge -o wrong.json",
                 {"part1.json", "part1.json part1.json", "part1.json whole.json", "part1.json nothing.json"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.json"));
}

TEST_F(HuntCommand, OneThatWasKilledGoesOnWhereItWas) {
  EXPECT_EQ(run(std::string(kHunt) + "--json whole.json --jobs 2").code, 1);
  (void)signalled(std::string(kHunt) + "--json r.json --jobs 2", "[ -e r.json.part1 ]", "KILL");
  (void)shell("sleep 1");
  const Outcome o = run(std::string(kHunt) + "--json r.json --jobs 2 --resume", 1);
  EXPECT_EQ(report("r.json"), report("whole.json"));
  write("r.json.part1", read("whole.json"));
  EXPECT_EQ(run(std::string(kHunt) + "--json r.json --jobs 2 --resume").code, 2)
      << "the part of another hunt";
}

TEST_F(HuntCommand, ASignalEndsItWithWhatItHas) {
#ifdef LIMITCHECK_SANITIZED
  const std::string later = "[ $k = 400 ]";  // twentieths of a second, until it has begun
#else
  const std::string later = "[ $k = 40 ]";
#endif
  const Outcome o = signalled("hunt sliding-window --time 1h --attempts 0 --json r.json", later, "TERM");
  EXPECT_EQ(o.code, 143) << o.out;
  EXPECT_EQ(report("r.json")["incomplete"], "interrupted by SIGTERM");
  EXPECT_TRUE(says(o.out, "INCOMPLETE"));
}

TEST_F(HuntCommand, ASubjectThatDiesIsAFinding) {
  write("dies.sh", "read -r line\nkill -SEGV $$\n");
  const Outcome o = run("hunt --program 'bash dies.sh' --cases 2 --attempts 4 --json r.json", 1);
  bool crash = false;
  const json r = report("r.json");
  for (const json& f : r["findings"]) crash = crash || f["status"] == "crash";
  EXPECT_TRUE(crash) << o.out;
}

TEST_F(HuntCommand, NonsenseIsRefused) {
  expect_refused("hunt", {"", "nosuch", "row-stream --cases 0", "row-stream --time 0", "row-stream --time 5q",
                          "row-stream --time -3s", "row-stream --shard 3/2", "row-stream --shard 1",
                          "row-stream --resume", "row-stream --cases 3 --time 3s", "all",
                          "openmesh --scheme loop --option a=b", "row-stream --baseline nothing.json",
                          "row-stream --json x --junit x"});
}

class ProveCommand : public CommandTest {};

TEST_F(ProveCommand, PrintsOneJsonDocumentWithARowForEveryTopologyAndKernel) {
  const Outcome o = run("prove --depth 0 --valences 3,4 --kernel sliding-window --json", 0);
  // Where it takes more than ten seconds there are lines of progress, "limitcheck: 31/100, 22 s left: proof 161 of 932, ...",
  // and nothing else.
  std::istringstream lines(o.err);
  for (std::string line; std::getline(lines, line);) {
    int done = 0, of = 0;
    EXPECT_EQ(std::sscanf(line.c_str(), "limitcheck: %d/%d,", &done, &of), 2) << line;
    EXPECT_TRUE(says(line, " s left: proof ")) << line;
  }
  const json said = json::parse(o.out);
  EXPECT_TRUE(said["held"].get<bool>());
  EXPECT_EQ(said["impossible"], json({"3 3 4"}));
  bool bounds = false;
  for (const auto& row : said["rows"]) {
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
  const json said =
      json_of("prove --scheme catmull-clark --depth 0 --valences 3,5 --kernel sliding-window --json", 0);
  EXPECT_EQ(said["scheme"], "catmull-clark");
  EXPECT_TRUE(said["held"].get<bool>());
  std::map<std::string, int> groups;
  for (const auto& row : said["rows"]) {
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
  const json said = json::parse(o.out);
  ASSERT_EQ(said["claims"].size(), 92U);
  for (const auto& claim : said["claims"]) {
    EXPECT_EQ(claim["held"], false) << claim;
    EXPECT_EQ(claim["ran"], false) << claim;
    EXPECT_EQ(claim["outcome"], claim["check"].is_null() ? "not checkable" : "not run") << claim;
    EXPECT_FALSE(claim["message"].is_null()) << claim;
  }
  EXPECT_EQ(said["coverage"]["held"], 0);
  EXPECT_EQ(said["verdicts"]["not checkable"], 4) << "what we conclude does not depend on what is installed";
}

TEST_F(ClaimsCommand, ACommandThatAnInstallationLacksSaysWhereItIs) {
  for (const std::string command : {"bench", "prove", "reproduce"}) {
    const Outcome o = shell("cp '" LIMITCHECK_PROGRAM "' alone && ./alone " + command, 2);
    EXPECT_TRUE(says(o.err, "`bash verify/run.sh " + command + "` makes it"));
  }
}

TEST_F(ClaimsCommand, SaysWhatIsConcludedAndWhetherTheTestsAreGreenInColumnsOfTheirOwn) {
  const Outcome o = run("claims C31 C80 --programs .");
  EXPECT_TRUE(says(o.out, "we conclude           our tests"));
  EXPECT_TRUE(says(o.out, "refuted               not run "));
  EXPECT_TRUE(says(o.out, "not checkable         none"));
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
  const Outcome o = run("claims C93", 2);
  EXPECT_TRUE(says(o.err, "C01 to C92"));
}

TEST_F(ClaimsCommand, WritesTheErrata) {
  const Outcome o = run("claims --errata", 0);
  EXPECT_TRUE(says(o.out, "| C69 | Appendix A |"));
}

}  // namespace
}  // namespace limitcheck::cli
