// SPDX-License-Identifier: MIT
// `limitcheck eval` as a user meets it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class EvalCommand : public CommandTest {};

// A height of 324 at one of the twelve vertices picks its weight out of the sum.             [C66; section 5]
TEST_F(EvalCommand, TheCentreOfARegularFaceHasThePapersWeights) {
  // Fig. 9's order: rows (1,2) (3,4,5) (6,7,8,9) (10,11,12).
  const int faces[13][3] = {{4, 7, 8}, {1, 3, 4},  {1, 4, 2},   {2, 4, 5},  {3, 6, 7},   {3, 7, 4}, {4, 8, 5},
                            {5, 8, 9}, {6, 10, 7}, {7, 10, 11}, {7, 11, 8}, {8, 11, 12}, {8, 12, 9}};
  const double xy[12][2] = {{1.5, 3}, {2.5, 3}, {1, 2},   {2, 2}, {3, 2}, {.5, 1},
                            {1.5, 1}, {2.5, 1}, {3.5, 1}, {1, 0}, {2, 0}, {3, 0}};
  const int weight[12] = {1, 1, 14, 92, 14, 1, 92, 92, 1, 1, 14, 1};  // over 324
  for (int chosen = 0; chosen < 12; ++chosen) {
    std::string obj;
    for (int v = 0; v < 12; ++v) {
      obj += "v " + std::to_string(xy[v][0]) + " " + std::to_string(xy[v][1]) +
             (v == chosen ? " 324\n" : " 0\n");
    }
    for (const auto& f : faces) {
      obj += "f " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
    }
    write("regular.obj", obj);
    const Outcome o = run("eval regular.obj 0 1/3 1/3 --json --digits 40");
    ASSERT_EQ(o.code, 0) << o.err;
    const auto json = nlohmann::json::parse(o.out);
    EXPECT_EQ(std::stod(json["position"][2].get<std::string>()), weight[chosen]) << "vertex " << chosen + 1;
    for (const char* key : {"position", "d1", "d2", "normal"}) {
      ASSERT_EQ(json[key].size(), 3U) << key;
      EXPECT_TRUE(json[key][0].is_string()) << key;
    }
  }
}

TEST_F(EvalCommand, ASecondWayToWriteAPointGivesTheSameAnswer) {
  const auto position = [&](const std::string& point) {
    const Outcome o = run("eval bumpy:200 17 " + point + " --json");
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out)["position"];
  };
  EXPECT_EQ(position("1/4 1/2"), position("0.25 0.5"));
  EXPECT_EQ(position("1/4 1/2"), position("2/8 5e-1"));
}

TEST_F(EvalCommand, RefusesBadInputWithExitCodeTwo) {
  for (const char* arguments :
       {"eval", "eval tetrahedron", "eval tetrahedron 4 0 0", "eval tetrahedron -1 0 0",
        "eval tetrahedron 0 2/3 2/3", "eval tetrahedron 0 -1/3 1/3", "eval tetrahedron 0 1/0 0",
        "eval tetrahedron 0 abc 0", "eval tetrahedron 0 nan 0", "eval tetrahedron 0 0 0 --digits 0",
        "eval tetrahedron 0 0 0 --digits 1000000000", "eval tetrahedron 99999999999999999999 0 0",
        "eval no-such-file.obj 0 0 0"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments << "\n" << o.out;
    EXPECT_NE(o.err, "") << arguments;
    EXPECT_EQ(o.out, "") << arguments;
  }
}

}  // namespace
}  // namespace limitcheck::cli
