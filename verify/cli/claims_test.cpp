// SPDX-License-Identifier: MIT
// `limitcheck claims` as a user meets it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class ClaimsCommand : public CommandTest {};

TEST_F(ClaimsCommand, WithoutItsTestProgramsNothingIsConfirmed) {
  const Outcome o = run("claims --json --programs .");  // as where only the program is installed
  EXPECT_EQ(o.code, 1);
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

TEST_F(ClaimsCommand, SaysWhatIsConcludedAndWhetherTheTestsAreGreenInColumnsOfTheirOwn) {
  const Outcome o = run("claims C31 C80 --programs .");
  EXPECT_NE(o.out.find("we conclude    our tests"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("refuted        not run "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("not checkable  none"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("2 claims of the paper: refuted 1, not checkable 1"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("our tests: green 0, red 0, not run 1, none 1"), std::string::npos) << o.out;
}

// Neither the test program, nor what that has started, nor the folder for their output.
TEST_F(ClaimsCommand, ASignalLeavesNothingBehind) {
  write("claims_programs.txt", "hangs\n");
  const std::string unique = std::to_string(getpid()) + "002";
  write("hangs", "#!/bin/sh\nsleep " + unique + " &\ntouch up\nwait\n");
  std::filesystem::permissions(folder_ / "hangs", std::filesystem::perms::owner_all);
  for (const auto& [signal, code] : {std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 129}}) {
    write("script.sh", "mkdir -p tmp; rm -f up\nTMPDIR=$PWD/tmp env --default-signal '" LIMITCHECK_PROGRAM
                       "' claims C14 --programs . &\nwhile [ ! -e up ]; do sleep 0.05; done\nkill -" +
                           std::string(signal) +
                           " $!\nwait $!\ncode=$?\nls tmp\nfor k in {1..100}; do grep -aqs 'sle[e]p." +
                           unique + "' /proc/[0-9]*/cmdline || exit $code; sleep 0.05; done\nexit 9\n");
    const int status =
        std::system(("cd '" + folder_.string() + "' && bash script.sh > .stdout 2> .stderr").c_str());
    EXPECT_EQ(WEXITSTATUS(status), code) << read(".stderr");
    EXPECT_EQ(read(".stdout"), "");
    EXPECT_EQ(read(".stderr"), "limitcheck: interrupted by SIG" + std::string(signal) + "\n");
  }
}

TEST_F(ClaimsCommand, AnUnknownClaimIsBadUsage) {
  const Outcome o = run("claims C87");
  EXPECT_EQ(o.code, 2);
  EXPECT_NE(o.err.find("C01 to C86"), std::string::npos) << o.err;
}

TEST_F(ClaimsCommand, WritesTheErrata) {
  const Outcome o = run("claims --errata");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.out.find("| C69 | Appendix A |"), std::string::npos);
}

}  // namespace
}  // namespace limitcheck::cli
