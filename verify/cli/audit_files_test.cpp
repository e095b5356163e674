// SPDX-License-Identifier: MIT
// `limitcheck audit --control --tessellation` as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
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

TEST_F(AuditFilesCommand, TellsTheControlMeshItselfFromATessellation) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  const Outcome o = run("audit --control cage.obj --tessellation cage.obj");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_NE(o.out.find("file-distance             FINDING"), std::string::npos) << o.out;
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
