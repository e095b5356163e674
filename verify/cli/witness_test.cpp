// SPDX-License-Identifier: MIT
// --witnesses and --shrink: what is written for a finding shows the finding again.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "data/io/read.h"
#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
      const Outcome audit = run(again.substr(11) + " --json again.json");
      EXPECT_EQ(audit.code, 1) << again << audit.err;
      bool found = false;
      const json repeated = json_in("again.json");
      for (const auto& row : repeated["results"])
        found = found || (row["check"] == check && row["status"] == witness.at("status"));
      EXPECT_TRUE(found) << check << ": " << again;
      if (!witness.contains("eval")) continue;
      const std::string eval = witness.at("eval");
      const Outcome point = run(eval.substr(11) + " --json");
      EXPECT_EQ(point.code, 0) << eval << point.err;
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
          "--json -");
  EXPECT_EQ(o.code, 1) << o.err;
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
    const Outcome point = run(eval.substr(11) + " --json");
    ASSERT_EQ(point.code, 0) << eval << point.err;
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
      run("audit model:mutation=warren_declared octahedron --depth 1 --level quick --witnesses found");
  EXPECT_EQ(o.code, 1) << o.err;
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
          "--witnesses found");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_GT(expect_reproducible("found"), 0);
}

TEST_F(WitnessFiles, AreSmallAfterShrinking) {
  for (const char* audited : {"model:mutation=weight_1e-6_at_valence_5 random:5:300",
                              "quad-model:mutation=weight_1e-6_at_valence_5 mixed:4:300"}) {
    const Outcome o = run(std::string("audit ") + audited + " --depth 2 --level quick --shrink 60");
    EXPECT_EQ(o.code, 1) << o.err;
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
