// SPDX-License-Identifier: MIT
// --checks and --rerun: what is looked at, what is left out, and what is said of both.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

std::set<std::string> checks_of(const json& report) {
  std::set<std::string> all;
  for (const json& row : report["results"]) all.insert(row["check"]);
  return all;
}

class AuditChoice : public CommandTest {
 protected:
  json report_of(const std::string& arguments, int code) const {
    run("audit " + arguments + " --json r.json", code);
    return json_in("r.json");
  }
};

TEST_F(AuditChoice, NamedChecksAloneAreLookedAtOrAllButThose) {
  const auto all = checks_of(report_of("naive tetrahedron --depth 1", 0));
  const json two = report_of("naive tetrahedron --depth 1 --checks positions,normals", 0);
  EXPECT_EQ(checks_of(two), (std::set<std::string>{"normals", "positions", "tessellates"}));
  const json others = report_of("naive tetrahedron --depth 1 --checks -determinism,-extreme-scale", 0);
  std::set<std::string> expected = all;
  expected.erase("determinism");
  expected.erase("scaling");
  EXPECT_EQ(checks_of(others), expected);
  EXPECT_EQ(others["left_out"], (json{"determinism", "scaling"}));
  EXPECT_EQ(checks_of(report_of("naive tetrahedron --depth 1 --checks -tessellates", 0)), all);

  // Rows that are made of others' evidence, and the row of subjects that deliver refined points.
  EXPECT_EQ(checks_of(report_of("naive octahedron --depth 1 --checks state", 0)),
            (std::set<std::string>{"state", "tessellates"}));
  EXPECT_TRUE(checks_of(report_of("openmesh tetrahedron --depth 1 --checks positions", 0))
                  .contains("refined-positions"));
}

TEST_F(AuditChoice, AnUnknownCheckIsRefusedWithThoseThereAre) {
  const Outcome o = run("audit naive tetrahedron --checks position", 2);
  EXPECT_TRUE(says(o.err, "'position'"));
  EXPECT_TRUE(says(o.err, "positions, "));
  expect_refused("audit naive tetrahedron",
                 {"--checks ''", "--checks positions,,normals", "--checks -", "--checks file-positions",
                  "--checks positions --must-refuse", "--checks normals --require-coverage"});
}

TEST_F(AuditChoice, WhatIsLeftOutIsNotJudged) {
  const std::string bad = "audit faulty:fault=wrong_limit_mask,of=model tetrahedron --depth 1 --level quick ";
  run(bad + "--json old.json", 1);
  const Outcome o = run(bad + "--checks normals --baseline old.json --require positions --json r.json");
  EXPECT_NE(o.code, 0);
  EXPECT_TRUE(says(o.out, "positions of faulty:fault=wrong_limit_mask,of=model were never judged: left out"));
  EXPECT_EQ(json_in("r.json")["changes"]["gone"], 0);
}

TEST_F(AuditChoice, PartsOfChosenChecksAreJoined) {
  const std::string audit = "audit naive tetrahedron octahedron --depth 1 --checks positions,mirror ";
  for (const char* k : {"1", "2"}) run(audit + "--shard " + k + "/2 --json part" + k + ".json", 0);
  const Outcome o = run("merge part1.json part2.json -o whole.json", 0);
  EXPECT_TRUE(says(o.out, "only these checks"));
  EXPECT_EQ(checks_of(json_in("whole.json")), (std::set<std::string>{"mirror", "positions", "tessellates"}));
}

TEST_F(AuditChoice, WhatHadFindingsIsLookedAtAgainAndNothingElse) {
  // Of these meshes and depths fan:1 has findings in relations, too.
  json report = report_of("all fan:1 bumpy:20 --depth 2 --threads 2", 1);
  std::set<std::string> rows;
  const auto name = [](const json& row) {
    return row["subject"].get<std::string>() + row["mesh"].get<std::string>() +
           row["check"].get<std::string>();
  };
  for (const json& row : report["results"])
    if (row["status"] == "finding") rows.insert(name(row));
  ASSERT_GT(rows.size(), 5U);
  const Outcome again = run("audit --rerun r.json --json again.json", 1);
  EXPECT_TRUE(says(again.out, "of " + std::to_string(rows.size()) + " findings in r.json: 0 gone, " +
                                  std::to_string(rows.size()) + " still there\n"));
  const json rerun = json_in("again.json");
  for (const json& row : rerun["results"])
    EXPECT_TRUE(rows.contains(name(row)) || row["check"] == "tessellates" || row["check"] == "recognised")
        << name(row);
  EXPECT_LT(rerun["results"].size(), report["results"].size() / 2);
}

TEST_F(AuditChoice, WhatIsMendedIsSaidToBeGone) {
  json report = report_of("naive tetrahedron octahedron --depth 2 --sample 4:7", 0);
  EXPECT_TRUE(says(run("audit --rerun r.json", 0).out, "no findings"));
  int planted = 0;
  for (json& row : report["results"])
    if (row["mesh"] == "octahedron" && (row["check"] == "positions" || row["check"] == "rotation")) {
      row["status"] = "finding", row["count"] = 1;
      ++planted;
    }
  ASSERT_EQ(planted, 2);
  write("old.json", report.dump());
  const Outcome o = run("audit --rerun old.json --json r.json", 0);
  EXPECT_TRUE(says(o.out, "of 2 findings in old.json: 2 gone, 0 still there\n"));
  const json rerun = json_in("r.json");
  for (const json& row : rerun["results"]) {
    EXPECT_EQ(row["mesh"], "octahedron");
    EXPECT_EQ(row["sample"], "4:7");
  }
  expect_refused("audit --rerun old.json", {"naive", "--depth 3", "--checks positions", "--baseline old.json",
                                            "--shard 1/2", "--level quick", "--require-coverage"});
  expect_refused("audit", {"--rerun none.json", "--rerun script.sh"});
}

}  // namespace
}  // namespace limitcheck::cli
