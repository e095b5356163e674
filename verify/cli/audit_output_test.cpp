// SPDX-License-Identifier: MIT
// What `limitcheck audit` writes besides the table: schema, JUnit, waivers, explanations, levels.
// `limitcheck audit` as one screen: root causes and the commands that show them, the page, what changed; and
// a stranger's first guesses.
// --witnesses and --shrink: what is written for a finding shows the finding again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "data/io/read.h"
#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class AuditOutput : public CommandTest {
 protected:
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
        << read(".stderr");
  }
}

TEST_F(AuditOutput, AFindingHasFortyDigitsAndTheCommandThatRepeatsIt) {
  ASSERT_EQ(run("audit opensubdiv-bfr bumpy:20 --depth 3 --level quick --json report.json").code, 1);
  const auto report = json_in("report.json");
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
      << read(".stderr");
}

TEST_F(AuditOutput, AWaivedFindingIsNoFindingAndASuperfluousWaiverIsReported) {
  const std::string audit =
      "audit faulty:fault=wrong_limit_mask,of=model tetrahedron --depth 1 --level quick ";
  ASSERT_EQ(run(audit).code, 1);
  write("waivers.json", R"({"waivers":[
    {"subject":"faulty:*","check":"*","shape":"tetrahedron","reason":"planted","expires":"2999-12-31"},
    {"subject":"other","check":"positions","reason":"gone","expires":"2999-12-31"},
    {"subject":"faulty:*","check":"positions","reason":"old","expires":"2001-01-01"}]})");
  const Outcome o = run(audit + "--waivers waivers.json --json report.json", 0);
  const auto report = json_in("report.json");
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

// On a terminal there are colours and a line of progress that is written over, on one that is dumb there are none.
TEST_F(AuditOutput, ADumbTerminalGetsNoEscapeSequences) {
  const auto on_terminal = [&](const std::string& variables) {
    write("audit.sh", variables + " '" LIMITCHECK_PROGRAM "' audit naive octahedron --depth 1\n");
    return command("script -qec 'sh audit.sh' /dev/null", 0).out;
  };
  EXPECT_TRUE(says(on_terminal("TERM=xterm"), "\033["));
  EXPECT_FALSE(says(on_terminal("TERM=dumb"), "\033["));
}

TEST_F(AuditOutput, EveryCheckIsExplained) {
  const Outcome o = run("audit --explain positions", 0);
  EXPECT_TRUE(says(o.out, "bound"));
  EXPECT_EQ(run("audit --explain nonsense").code, 2);
  EXPECT_EQ(run("audit --explain extreme-scale").out, run("audit --explain scaling").out) << "its new name";
  const Outcome all = run("audit --explain all");
  for (const char* check : {"tessellates", "rejected-inputs", "t-vertices"})
    EXPECT_TRUE(says(all.out, check));
}

TEST_F(AuditOutput, LevelsLookAtMoreAndMore) {
  const auto rows = [&](const std::string& level) {
    run("audit model bumpy:400 tetrahedron --depth 1 --json report.json --level " + level);
    return json_in("report.json")["results"].size();
  };
  const auto quick = rows("quick"), standard = rows("standard"), thorough = rows("thorough");
  EXPECT_LT(quick, standard);
  EXPECT_LT(standard, thorough);
}

using AuditCauses = AuditOutput;

TEST_F(AuditCauses, EachHasACommandThatShowsTheDifference) {
  const Outcome o =
      run("audit all fan:1 fan:5 prism:3 quad-fan:2 quad-dart:4 wheel:50 --depth 2 --json report.json", 1);
  EXPECT_LE(std::count(o.out.begin(), o.out.end(), '\n'), 50) << o.out;
  const json report = json_in("report.json");
  ASSERT_GE(report["causes"].size(), 8U);
  std::size_t shown = 0;
  for (const json& cause : report["causes"]) {
    const std::string command = cause["command"];
    ASSERT_TRUE(command.starts_with("limitcheck ")) << cause;
    const Outcome again = run(command.substr(11), 1);
    if (!command.starts_with("limitcheck eval ")) continue;
    ++shown;
    EXPECT_TRUE(says(again.out, "<-- wrong")) << command;
    EXPECT_TRUE(says(again.out, "expected")) << command;
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
  EXPECT_TRUE(says(page, "\"positions\":\"")) << "the mesh";
  EXPECT_FALSE(says(page, "%DATA%"));
  // Who runs no script reads overview and causes all the same; who does sees the control mesh and the bound.
  const std::string plain =
      page.substr(page.find("<noscript>"), page.find("</noscript>") - page.find("<noscript>"));
  for (const char* words :
       {"<th>subject</th>", "<td>opensubdiv-bfr</td>", "<li>high, opensubdiv-bfr: ", "<code>limitcheck "})
    EXPECT_TRUE(says(plain, words)) << words << plain;
  EXPECT_FALSE(says(plain, "%PLAIN%"));
  EXPECT_FALSE(says(page, "\"control\":\"\"")) << "the control mesh's edges";
  EXPECT_TRUE(says(page, "\"of\":\"positions\",\"bound\":")) << "the bound of the histogram";
  EXPECT_FALSE(says(page, "\"bound\":null"));
  EXPECT_FALSE(says(page, "src=\"http")) << "opens without a network";
  EXPECT_LT(page.size(), 2000000U);
  // Its policy lets in its own style and script, by their digests, and nothing from elsewhere.
  EXPECT_EQ(
      python(
          "import re, hashlib, base64\n"
          "page = open('out/page.html').read()\n"
          "policy = re.search('http-equiv=\"Content-Security-Policy\" content=\"(.*?)\"', page).group(1)\n"
          "digest = lambda tag: \"'sha256-\" + base64.b64encode(hashlib.sha256(re.search(\n"
          "  '<' + tag + '>(.*?)</' + tag + '>', page, re.S).group(1).encode()).digest()).decode() + \"'\"\n"
          "assert policy == \"default-src 'none'; style-src \" + digest('style') + '; script-src ' + "
          "digest('script'), policy\n"
          "assert not re.search(' style=| on[a-z]+=', page)\n"),
      0)
      << read(".stderr");
  EXPECT_EQ(run("audit naive tetrahedron --html same --junit same").code, 2);
}

TEST_F(AuditCauses, AgainstABaselineOnlyWhatIsNewOrWorseIsAFinding) {
  const std::string audit = "audit opensubdiv-bfr bumpy:20 --depth 2 --level quick ";
  ASSERT_EQ(run(audit + "--json old.json").code, 1);
  const Outcome same = run(audit + "--baseline old.json", 0);
  EXPECT_TRUE(says(same.out, "since old.json: 0 new, 0 worse, 0 gone"));
  const Outcome more = run("audit opensubdiv-bfr bumpy:20 fan:1 --depth 2 --level quick --baseline old.json");
  EXPECT_EQ(more.code, 1) << "another mesh has new ones";
  write("none.json", "{}");
  EXPECT_EQ(run(audit + "--baseline none.json").code, 2);
}

TEST_F(AuditCauses, ACrashCanBeWaived) {
  write("w.json",
        R"({"waivers":[{"subject":"*","check":"tessellates","reason":"known","expires":"2999-12-31"}]})");
  const Outcome o = run("audit --program 'kill -SEGV $$' tetrahedron --waivers w.json");
  EXPECT_TRUE(says(o.out, "waived: "));
  EXPECT_NE(o.code, 1) << "nothing is red, and nothing was confirmed";
}

TEST_F(AuditCauses, WhatASubjectPrintsIsNotOnTheScreen) {
  const Outcome o = run("audit openmesh tetrahedron --depth 1 --json report.json");
  EXPECT_FALSE(says(o.err, "add_face"));
  EXPECT_TRUE(says(json_in("report.json")["printed"].get<std::string>(), "add_face"));
}

TEST_F(AuditCauses, AStrangersGuessesLeadOn) {
  ASSERT_EQ(run("generate quad-cube -o quad.obj").code, 0);
  EXPECT_TRUE(says(run("quad.obj").err, "limitcheck audit quad.obj"));
  const Outcome all = run("audit quad.obj --depth 1 --level quick");
  EXPECT_TRUE(says(all.err, "all built-in subjects are audited on it"));
  EXPECT_TRUE(says(all.out, "\nrow-stream "));
  EXPECT_TRUE(says(run("audit gone.obj").err, "there is no file gone.obj"));
  EXPECT_EQ(run("help").code, 0);
  EXPECT_EQ(run("help repair").out, run("repair --help").out);
  EXPECT_EQ(run("audit row-stream --option target=scalar quad.obj --depth 1 --level quick").code, 0)
      << "the mesh is no option";
}

namespace fs = std::filesystem;

class WitnessFiles : public CommandTest {
 protected:
  // Runs both commands of each witness in `folder` and returns how many there were.
  int expect_reproducible(const std::string& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
      ++count;
      const json witness = json_in(entry.path() / "witness.json");
      const std::string check = witness.at("check");
      const std::string again = witness.at("audit");
      EXPECT_TRUE(again.starts_with("limitcheck ")) << again;
      const Outcome audit = run(again.substr(11) + " --json again.json", 1);
      bool found = false;
      const json repeated = json_in("again.json");
      for (const auto& row : repeated["results"])
        found = found || (row["check"] == check && row["status"] == witness.at("status"));
      EXPECT_TRUE(found) << check << ": " << again;
      if (!witness.contains("eval")) continue;
      const std::string eval = witness.at("eval");
      const Outcome point = run(eval.substr(11) + " --json", 0);
      EXPECT_EQ(json::parse(point.out)["position"], witness.at("limit_position")) << eval;
      EXPECT_EQ(json::parse(point.out)["normal"], witness.at("limit_normal")) << eval;
    }
    return count;
  }
  // Audits, and shows each finding again. Returns how many there are.
  int findings_shown_again(const std::string& arguments) {
    int findings = 0;
    const json report =
        json_of("audit " + arguments + " --depth 2 --level quick --witnesses found --json -", 1);
    for (const auto& row : report["results"]) findings += row["status"] == "finding";
    EXPECT_EQ(expect_reproducible("found"), findings) << arguments;
    return findings;
  }
};

TEST_F(WitnessFiles, OfEveryFindingShowItAgain) {
  EXPECT_GT(findings_shown_again("opensubdiv-bfr bumpy:20 fan:1"), 4);
}

TEST_F(WitnessFiles, AreWrittenWhereTheSurroundingsOfAFaceTouchThemselves) {
  EXPECT_GE(findings_shown_again("model:mutation=mean_facet_normals torus:3:3 random:360:60"), 2);
}

// Without the option the command would mean the polygons, and be about another surface.
TEST_F(WitnessFiles, NameTheWayInWhichPolygonsWereCut) {
  ASSERT_EQ(run("generate pawn:5 -o pawn.obj").code, 0);
  const Outcome o =
      run("audit opensubdiv-bfr pawn.obj --triangulate shortest-diagonal --depth 2 --level quick --witnesses "
          "found "
          "--json -",
          1);
  EXPECT_GT(expect_reproducible("found"), 2);
  int commands = 0;
  const json report = json::parse(o.out);
  for (const auto& row : report["results"]) {
    if (row["status"] != "finding" || row["witness"]["difference"].is_null()) continue;
    ++commands;
    EXPECT_EQ(row["triangulated"], "shortest-diagonal");
    const std::string difference = row["witness"]["difference"], audit = row["witness"]["reproduce"];
    for (const std::string& command : {difference, audit}) {
      EXPECT_TRUE(says(command, " pawn.obj "));
      EXPECT_EQ(run(command.substr(11)).code, 1) << command;
    }
    if (row["witness"]["command"].is_null()) continue;
    const std::string eval = row["witness"]["command"];
    const Outcome point = run(eval.substr(11) + " --json", 0);
    if (row["check"] != "positions") continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(std::stod(json::parse(point.out)["position"][axis].get<std::string>()),
                  row["witness"]["expected"][axis].get<double>(), 1e-14)
          << eval;
  }
  EXPECT_GT(commands, 1);
}

// Quads, polygons, and triangles that are meant for Catmull-Clark's scheme.
TEST_F(WitnessFiles, OfCatmullClarksSurfacesShowTheFindingAgain) {
  for (const char* meshes : {"quad-cube prism:5 mixed-pawn:5", "octahedron --scheme catmull-clark"}) {
    EXPECT_GT(findings_shown_again(std::string("quad-model:mutation=face_weight_1e-6 ") + meshes), 0);
    for (const auto& entry : fs::directory_iterator(folder_ / "found")) {
      const json witness = json_in(entry.path() / "witness.json");
      EXPECT_EQ(witness.at("scheme"), "catmull-clark");
      EXPECT_TRUE(says(witness.at("audit").get<std::string>(), " --scheme catmull-clark"));
    }
    fs::remove_all(folder_ / "found");
  }
}

TEST_F(WitnessFiles, NameTheFamilyOfWeights) {
  const Outcome o =
      run("audit model:mutation=warren_declared octahedron --depth 1 --level quick --witnesses found", 1);
  EXPECT_GT(expect_reproducible("found"), 0);
  for (const auto& entry : fs::directory_iterator(folder_ / "found")) {
    const json witness = json_in(entry.path() / "witness.json");
    if (witness.at("check") != "positions") continue;
    EXPECT_TRUE(says(witness.at("eval").get<std::string>(), "--weights warren"));
  }
}

TEST_F(WitnessFiles, CarryTheDepthsOfTheFaces) {
  const Outcome o =
      run("audit sliding-window icosahedron --depth 2 --depths random:3 --option repair=none --level quick "
          "--witnesses found",
          1);
  EXPECT_GT(expect_reproducible("found"), 0);
}

TEST_F(WitnessFiles, AreSmallAfterShrinking) {
  for (const char* audited : {"model:mutation=weight_1e-6_at_valence_5 random:5:300",
                              "quad-model:mutation=weight_1e-6_at_valence_5 mixed:4:300"}) {
    const Outcome o = run(std::string("audit ") + audited + " --depth 2 --level quick --shrink 60", 1);
    EXPECT_TRUE(says(o.err, "shrunk to"));
    EXPECT_GT(expect_reproducible("limitcheck-witness"), 0);
    for (const auto& entry : fs::directory_iterator(folder_ / "limitcheck-witness"))
      EXPECT_LE(data::read_mesh(entry.path() / "control.obj").faces.size(), 8U) << entry.path();
    fs::remove_all(folder_ / "limitcheck-witness");
  }
}

TEST_F(WitnessFiles, ReproductionOfAQuickAuditIsQuick) {
  const Outcome o = run("audit opensubdiv-bfr bumpy:20 --depth 2 --level quick --json -");
  const json report = json::parse(o.out);
  for (const auto& row : report["results"])
    if (row["status"] == "finding") {
      EXPECT_EQ(row["witness"]["reproduce"],
                "limitcheck audit opensubdiv-bfr bumpy:20 --depth 2 --level quick");
    }
}

}  // namespace
}  // namespace limitcheck::cli
