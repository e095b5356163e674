// SPDX-License-Identifier: MIT
// `limitcheck eval` as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

TEST_F(EvalCommand, TakesEveryFaceOfAValidMesh) {
  // Faces whose surroundings touch themselves in a vertex.
  for (const char* arguments :
       {"eval torus:3:3 0 1/3 1/3", "eval random:360:60 1 1/3 1/3", "eval octahedron 0 1/3 1/3"})
    EXPECT_EQ(run(arguments).code, 0) << arguments;
}

TEST_F(EvalCommand, GivesEveryQuantityARadiusOfItsOwn) {
  // So near a corner of valence 7 second derivatives are huge: theirs is no measure of the position.
  const Outcome o = run("eval wheel:7 0 1e-12 1e-12 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto json = nlohmann::json::parse(o.out);
  const auto& radii = json["radii"];
  double largest = 0;
  for (const char* key : {"position", "d1", "d2", "normal", "d11", "d12", "d22"}) {
    const double size = std::abs(std::stod(json[key][0].get<std::string>())) +
                        std::abs(std::stod(json[key][1].get<std::string>())) +
                        std::abs(std::stod(json[key][2].get<std::string>()));
    EXPECT_GT(radii[key].get<double>(), 0) << key;
    EXPECT_LE(radii[key].get<double>(), size * 1e-15) << key;
    largest = std::max(largest, radii[key].get<double>());
  }
  EXPECT_LE(radii["position"].get<double>(), 1e-14);
  EXPECT_GT(radii["d11"].get<double>(), 1e-9);
  for (const char* key : {"gaussian_curvature", "mean_curvature"})
    EXPECT_LE(radii[key].get<double>(), std::abs(std::stod(json[key].get<std::string>())) * 1e-14) << key;
  EXPECT_EQ(json["radius"].get<double>(), largest);
  EXPECT_TRUE(radii["tangent1"].is_null());
}

TEST_F(EvalCommand, SaysWhichDerivativesExistAtAnExtraordinaryCorner) {
  const auto at = [&](const std::string& mesh) {
    const Outcome o = run("eval " + mesh + " 0 0 0 --json");
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out);
  };
  const nlohmann::json zero{"0", "0", "0"};
  for (const char* mesh : {"tetrahedron", "octahedron", "icosahedron"}) {  // valence 3, 4, 5
    const auto json = at(mesh);
    EXPECT_EQ(json["derivatives_exist"], true) << mesh;
    EXPECT_EQ(json["d1"], zero) << mesh;
    EXPECT_EQ(json["d2"], zero) << mesh;
    EXPECT_EQ(json["radii"]["d1"], 0) << mesh;
    EXPECT_EQ(json["d11"].is_null(), std::string(mesh) != "tetrahedron") << mesh;
    EXPECT_NE(json["tangent1"], zero) << mesh;
  }
  const auto json = at("wheel:7");
  EXPECT_EQ(json["derivatives_exist"], false);
  EXPECT_EQ(json["d1"], json["tangent1"]);  // as ever
  EXPECT_TRUE(json["d11"].is_null());
  const std::string text = run("eval wheel:7 0 0 0").out;
  EXPECT_NE(text.find("d/dl1       does not exist"), std::string::npos) << text;
  EXPECT_NE(text.find("d2/dl1dl1   does not exist"), std::string::npos) << text;
  EXPECT_NE(run("eval octahedron 0 0 0").out.find("d/dl1       0  0  0  exact"), std::string::npos);
}

TEST_F(EvalCommand, HasWarrensWeightsToo) {
  // A vertex of the octahedron keeps half of its distance from the centre, 24/55 by Loop's weights.
  const auto first = [&](const std::string& options) {
    const Outcome o = run("eval octahedron 0 0 0 --digits 20 --json" + options);
    EXPECT_EQ(o.code, 0) << o.err;
    const auto json = nlohmann::json::parse(o.out);
    double length = 0;
    for (const auto& x : json["position"]) length = std::hypot(length, std::stod(x.get<std::string>()));
    return length;
  };
  EXPECT_NEAR(first(" --weights warren") / first(""), 0.5 * 55 / 24, 1e-14);
  EXPECT_EQ(run("eval octahedron 0 0 0 --weights hoppe").code, 2);
}

TEST_F(EvalCommand, RefusesBadInputWithExitCodeTwo) {
  write("far.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(run("eval far.obj 0 1/3 1/3").code, 0);
  EXPECT_NE(run("eval far.obj 0 1/3 1/3 --precision float").err.find("vertex 1"), std::string::npos);

  for (const char* arguments :
       {"eval", "eval tetrahedron", "eval tetrahedron 4 0 0", "eval tetrahedron -1 0 0",
        "eval tetrahedron 0 2/3 2/3", "eval tetrahedron 0 -1/3 1/3", "eval tetrahedron 0 1/0 0",
        "eval tetrahedron 0 abc 0", "eval tetrahedron 0 nan 0", "eval tetrahedron 0 0 0 --digits 0",
        "eval tetrahedron 0 0 0 --digits 1000000000", "eval tetrahedron 99999999999999999999 0 0",
        "eval far.obj 0 1/3 1/3 --precision float", "eval no-such-file.obj 0 0 0"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments << "\n" << o.out;
    EXPECT_NE(o.err, "") << arguments;
    EXPECT_EQ(o.out, "") << arguments;
  }
}

}  // namespace
}  // namespace limitcheck::cli
