// SPDX-License-Identifier: MIT
// `limitcheck audit` as one screen: root causes and the commands that show them, the page, what changed; and
// a stranger's first guesses.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class AuditCauses : public CommandTest {};

TEST_F(AuditCauses, EachHasACommandThatShowsTheDifference) {
  const Outcome o =
      run("audit all fan:1 fan:5 prism:3 quad-fan:2 quad-dart:4 wheel:50 --depth 2 --json report.json");
  ASSERT_EQ(o.code, 1) << o.err;
  EXPECT_LE(std::count(o.out.begin(), o.out.end(), '\n'), 50) << o.out;
  const json report = json::parse(read("report.json"));
  ASSERT_GE(report["causes"].size(), 8U);
  std::size_t shown = 0;
  for (const json& cause : report["causes"]) {
    const std::string command = cause["command"];
    ASSERT_TRUE(command.starts_with("limitcheck ")) << cause;
    const Outcome again = run(command.substr(11));
    EXPECT_EQ(again.code, 1) << command << "\n" << again.out << again.err;
    if (!command.starts_with("limitcheck eval ")) continue;
    ++shown;
    EXPECT_NE(again.out.find("<-- wrong"), std::string::npos) << command << "\n" << again.out;
    EXPECT_NE(again.out.find("expected"), std::string::npos) << command;
  }
  EXPECT_GE(shown, 4U);
  for (const json& row : report["results"]) {
    const bool bad = row["status"] == "finding" || row["status"] == "crash" || row["status"] == "error";
    EXPECT_EQ(row["cause"].is_number(), bad) << row;
  }
}

TEST_F(AuditCauses, ThePageHasEverythingInside) {
  ASSERT_EQ(run("audit opensubdiv-bfr quad-fan:1 --depth 2 --html out/page.html").code, 1);
  const std::string page = read("out/page.html");
  EXPECT_NE(page.find("\"positions\":\""), std::string::npos) << "the mesh";
  EXPECT_EQ(page.find("%DATA%"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "opens without a network";
  EXPECT_LT(page.size(), 2000000U);
  EXPECT_EQ(run("audit naive tetrahedron --html same --junit same").code, 2);
}

TEST_F(AuditCauses, AgainstABaselineOnlyWhatIsNewOrWorseIsAFinding) {
  const std::string audit = "audit opensubdiv-bfr bumpy:20 --depth 2 --level quick ";
  ASSERT_EQ(run(audit + "--json old.json").code, 1);
  const Outcome same = run(audit + "--baseline old.json");
  EXPECT_EQ(same.code, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("since old.json: 0 new, 0 worse, 0 gone"), std::string::npos) << same.out;
  const Outcome more = run("audit opensubdiv-bfr bumpy:20 fan:1 --depth 2 --level quick --baseline old.json");
  EXPECT_EQ(more.code, 1) << "another mesh has new ones";
  write("none.json", "{}");
  EXPECT_EQ(run(audit + "--baseline none.json").code, 2);
}

TEST_F(AuditCauses, ACrashCanBeWaived) {
  write("w.json",
        R"({"waivers":[{"subject":"*","check":"tessellates","reason":"known","expires":"2999-12-31"}]})");
  const Outcome o = run("audit --program 'kill -SEGV $$' tetrahedron --waivers w.json");
  EXPECT_NE(o.out.find("waived: "), std::string::npos) << o.out;
  EXPECT_NE(o.code, 1) << "nothing is red, and nothing was confirmed";
}

TEST_F(AuditCauses, WhatASubjectPrintsIsNotOnTheScreen) {
  const Outcome o = run("audit openmesh tetrahedron --depth 1 --json report.json");
  EXPECT_EQ(o.err.find("add_face"), std::string::npos) << o.err;
  EXPECT_NE(json::parse(read("report.json"))["printed"].get<std::string>().find("add_face"),
            std::string::npos);
}

TEST_F(AuditCauses, AStrangersGuessesLeadOn) {
  ASSERT_EQ(run("generate quad-cube -o quad.obj").code, 0);
  EXPECT_NE(run("quad.obj").err.find("limitcheck audit quad.obj"), std::string::npos);
  const Outcome all = run("audit quad.obj --depth 1 --level quick");
  EXPECT_NE(all.err.find("all built-in subjects are audited on it"), std::string::npos) << all.err;
  EXPECT_NE(all.out.find("\nrow-stream "), std::string::npos) << all.out;
  EXPECT_NE(run("audit gone.obj").err.find("there is no file gone.obj"), std::string::npos);
  EXPECT_EQ(run("help").code, 0);
  EXPECT_EQ(run("help repair").out, run("repair --help").out);
  EXPECT_EQ(run("audit row-stream --option target=scalar quad.obj --depth 1 --level quick").code, 0)
      << "the mesh is no option";
}

}  // namespace
}  // namespace limitcheck::cli
