// SPDX-License-Identifier: MIT
// What `limitcheck audit` writes besides the table: schema, JUnit, waivers, explanations, levels.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class AuditOutput : public CommandTest {
 protected:
  int python(const std::string& program) const {
    write("check.py", program);
    return std::system(
        ("cd '" + folder_.string() + "' && /usr/bin/python3 check.py > python.txt 2>&1").c_str());
  }
};

TEST_F(AuditOutput, IsValidByThePublishedSchema) {
  // Everything held; findings with witnesses; NaN; a subject that refuses.
  for (const char* arguments :
       {"audit naive tetrahedron fan:1 --depth 2", "audit opensubdiv-bfr fan:1 bumpy:20 --depth 2",
        "audit null tetrahedron --depth 1", "audit openmesh wheel:50:1 --depth 1 --depths uniform",
        "audit faulty:fault=nan_position,of=model tetrahedron --depth 1 --level quick",
        "audit --program 'kill -SEGV $$' tetrahedron",
        "audit --program 'sleep 1000' tetrahedron --timeout 0.3"}) {
    ASSERT_LE(run(std::string(arguments) + " --json report.json").code, 1) << arguments;
    EXPECT_EQ(python("import json, jsonschema\n"
                     "schema = json.load(open('" LIMITCHECK_SOURCE_DIR
                     "/verify/report/schema/audit.schema.json'))\n"
                     "jsonschema.Draft7Validator.check_schema(schema)\n"
                     "jsonschema.validate(json.load(open('report.json')), schema)\n"),
              0)
        << arguments << "\n"
        << read("python.txt");
  }
}

TEST_F(AuditOutput, AFindingHasFortyDigitsAndTheCommandThatRepeatsIt) {
  ASSERT_EQ(run("audit opensubdiv-bfr bumpy:20 --depth 3 --level quick --json report.json").code, 1);
  const auto report = nlohmann::json::parse(read("report.json"));
  bool looked = false;
  for (const auto& row : report["results"]) {
    if (row["check"] != "positions") continue;
    looked = true;
    const auto& w = row["witness"];
    ASSERT_EQ(w["expected_digits"].size(), 3U);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(std::stod(w["expected_digits"][axis].get<std::string>()), w["expected"][axis].get<double>(),
                  1e-14);
    EXPECT_EQ(w["reproduce"], "limitcheck audit opensubdiv-bfr bumpy:20 --depth 3 --level quick");
    EXPECT_EQ(run(w["reproduce"].get<std::string>().substr(11)).code, 1);
  }
  EXPECT_TRUE(looked);
}

TEST_F(AuditOutput, AJUnitConsumerCanReadIt) {
  ASSERT_EQ(run("audit opensubdiv-bfr bumpy:20 --depth 2 --junit out/junit.xml").code, 1);
  EXPECT_EQ(python("import xml.etree.ElementTree as et\n"
                   "root = et.parse('out/junit.xml').getroot()\n"
                   "assert root.tag == 'testsuites'\n"
                   "for suite in root:\n"
                   "  cases = suite.findall('testcase')\n"
                   "  assert int(suite.get('tests')) == len(cases) > 10\n"
                   "  assert int(suite.get('failures')) == len(suite.findall('testcase/failure')) > 0\n"
                   "  assert int(suite.get('skipped')) == len(suite.findall('testcase/skipped'))\n"
                   "  assert all(c.get('name') and c.get('classname') for c in cases)\n"),
            0)
      << read("python.txt");
}

TEST_F(AuditOutput, AWaivedFindingIsNoFindingAndASuperfluousWaiverIsReported) {
  const std::string audit =
      "audit faulty:fault=wrong_limit_mask,of=model tetrahedron --depth 1 --level quick ";
  ASSERT_EQ(run(audit).code, 1);
  write("waivers.json", R"({"waivers":[
    {"subject":"faulty:*","check":"*","shape":"tetrahedron","reason":"planted","expires":"2999-12-31"},
    {"subject":"other","check":"positions","reason":"gone","expires":"2999-12-31"},
    {"subject":"faulty:*","check":"positions","reason":"old","expires":"2001-01-01"}]})");
  const Outcome o = run(audit + "--waivers waivers.json --json report.json");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const auto report = nlohmann::json::parse(read("report.json"));
  int waived = 0, notes = 0;
  for (const auto& row : report["results"]) {
    waived += row["status"] == "waived";
    notes += row["check"] == "waiver";
  }
  EXPECT_GE(waived, 1);
  EXPECT_EQ(notes, 2);
  write("waivers.json", R"({"waivers":[{"subject":"faulty:*"}]})");
  EXPECT_EQ(run(audit + "--waivers waivers.json").code, 2);
}

TEST_F(AuditOutput, EveryCheckIsExplained) {
  const Outcome o = run("audit --explain positions");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.out.find("bound"), std::string::npos);
  EXPECT_EQ(run("audit --explain nonsense").code, 2);
  EXPECT_EQ(run("audit --explain extreme-scale").out, run("audit --explain scaling").out) << "its new name";
  const Outcome all = run("audit --explain all");
  for (const char* check : {"tessellates", "rejected-inputs", "t-vertices"})
    EXPECT_NE(all.out.find(check), std::string::npos);
}

TEST_F(AuditOutput, LevelsLookAtMoreAndMore) {
  const auto rows = [&](const std::string& level) {
    run("audit model bumpy:400 tetrahedron --depth 1 --json report.json --level " + level);
    return nlohmann::json::parse(read("report.json"))["results"].size();
  };
  const auto quick = rows("quick"), standard = rows("standard"), thorough = rows("thorough");
  EXPECT_LT(quick, standard);
  EXPECT_LT(standard, thorough);
}

}  // namespace
}  // namespace limitcheck::cli
