// SPDX-License-Identifier: MIT
// `limitcheck audit --control --tessellation` as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class AuditFilesCommand : public CommandTest {};

TEST_F(AuditFilesCommand, HoldsTheEnginesOwnFilesWithinTheRoundingOfFloat) {
  for (const std::string file : {"out.ply", "out.obj"}) {
    ASSERT_EQ(run("generate bumpy:200 -o cage.obj").code, 0);
    ASSERT_EQ(run("tessellate cage.obj --depth 2 -o " + file).code, 0);
    const Outcome o = run("audit --control cage.obj --tessellation " + file +
                          " --normals --tolerance 1e-7 --per-vertex each.csv --json");
    EXPECT_EQ(o.code, 0) << o.out << o.err;
    const auto report = nlohmann::json::parse(o.out);
    for (const auto& row : report["results"]) EXPECT_EQ(row["status"], "held") << row;
    const std::string each = read("each.csv");
    EXPECT_TRUE(each.starts_with("vertex,distance,normal_angle,face,l1,l2\n"));
    EXPECT_EQ(std::count(each.begin(), each.end(), '\n'), 1 + 1602);  // 2 + 8 * 200 vertices
  }
}

TEST_F(AuditFilesCommand, LeavesTheHausdorffDistanceOutIfAsked) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  ASSERT_EQ(run("tessellate cage.obj --depth 1 -o out.ply").code, 0);
  const Outcome o = run("audit --control cage.obj --tessellation out.ply --no-hausdorff --json");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  const auto rows = nlohmann::json::parse(o.out)["results"];
  EXPECT_EQ(rows.size(), 10U);
  for (const auto& row : rows)
    EXPECT_EQ(row["status"], row["check"] == "file-hausdorff" ? "not-run" : "held") << row;
  EXPECT_EQ(run("audit --control cage.obj --tessellation out.ply --no-hausdorff --max-deviation 1").code, 2);
}

TEST_F(AuditFilesCommand, TellsTheControlMeshItselfFromATessellation) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  const Outcome o = run("audit --control cage.obj --tessellation cage.obj");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_NE(o.out.find("file-distance             FINDING"), std::string::npos) << o.out;
}

// The limit points of the cube -1 .. 1 are its corners halved: 3/8 + 1/6 - 1/24 of 1 (three neighbours, three
// opposite corners of faces). Cut into triangles it has another surface.
TEST_F(AuditFilesCommand, JudgesFilesOfQuadsByCatmullClarksScheme) {
  ASSERT_EQ(run("generate quad-cube -o cage.obj").code, 0);
  std::istringstream lines(read("cage.obj"));
  std::string limit;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (words >> word; word != "v") {
      limit += line + "\n";
      continue;
    }
    double x = 0, y = 0, z = 0;
    words >> x >> y >> z;
    std::ostringstream half;
    half << "v " << x / 2 << ' ' << y / 2 << ' ' << z / 2 << '\n';
    limit += half.str();
  }
  write("limit.obj", limit);
  const Outcome held = run("audit --control cage.obj --tessellation limit.obj --per-vertex each.csv");
  EXPECT_EQ(held.code, 0) << held.out << held.err;
  EXPECT_NE(held.out.find("scheme: catmull-clark"), std::string::npos) << held.out;
  EXPECT_TRUE(read("each.csv").starts_with("vertex,distance,normal_angle,face,corner,u,v\n"));
  EXPECT_EQ(run("audit --control cage.obj --tessellation limit.obj --provenance each.csv").code, 0);
  const Outcome refined = run("audit --control cage.obj --tessellation cage.obj");
  EXPECT_EQ(refined.code, 1);
  const Outcome loop = run("audit --control cage.obj --tessellation limit.obj --triangulate fan");
  EXPECT_EQ(loop.code, 1) << loop.out << loop.err;
}

TEST_F(AuditFilesCommand, ExitsWithTwoOnBadUsageAndBadInput) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  write("map.csv", "0,99,0,0\n");
  write("torn.ply", "ply\nformat ascii 1.0\n");
  for (const char* arguments :
       {"--control cage.obj", "--tessellation cage.obj", "--control cage.obj --tessellation absent.ply",
        "--control absent --tessellation cage.obj", "--control cage.obj --tessellation torn.ply",
        "--control cage.obj --tessellation cage.obj --provenance map.csv",
        "--control cage.obj --tessellation cage.obj --tolerance 0",
        "--control cage.obj --tessellation cage.obj --fit shear"}) {
    const Outcome o = run(std::string("audit ") + arguments);
    EXPECT_EQ(o.code, 2) << arguments << "\n" << o.out;
    EXPECT_NE(o.err, "") << arguments;
  }
}

}  // namespace
}  // namespace limitcheck::cli
