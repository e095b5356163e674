// SPDX-License-Identifier: MIT
// `limitcheck eval` of channels; and what README.md says of `eval`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class EvalChannel : public CommandTest {};

// Two quads with a chart each: a value of one face is held, and each side of the seam has its own.
const char* const kTwoCharts =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\n"
    "vt 0 0\nvt .5 0\nvt .5 1\nvt 0 1\nvt .625 0\nvt 1 0\nvt 1 1\nvt .625 1\n"
    "f 1/1 2/2 5/3 4/4\nf 2/5 3/6 6/7 5/8\n";

TEST_F(EvalChannel, AChannelHasAValueOnEachSideOfASeam) {
  write("two.obj", kTwoCharts);
  const auto left = json_of("eval two.obj 0 1 0 --channel uv --json", 0),
             right = json_of("eval two.obj 1 0 0 --channel uv --json", 0);
  EXPECT_EQ(left["channel"], "uv");
  EXPECT_EQ(left["channel_rule"], "corners-plus1");  // USD's, as the file says none
  EXPECT_EQ(left["position"].size(), 2U);
  EXPECT_EQ(std::stod(left["position"][0].get<std::string>()), .5);
  EXPECT_EQ(std::stod(right["position"][0].get<std::string>()), .625);
  EXPECT_FALSE(left.contains("normal"));
  EXPECT_EQ(std::stod(right["d1"][0].get<std::string>()), .375);
  // By the rule "none" a value of one face is a B-spline curve's: 2/3 v + 1/6 (a + b).
  const auto none = json_of("eval two.obj 0 1 0 --channel uv --channel-rule none --json", 0);
  EXPECT_NEAR(std::stod(none["position"][0].get<std::string>()), .5 * 2 / 3 + .5 / 6, 1e-15);
  EXPECT_NEAR(std::stod(none["position"][1].get<std::string>()), 1. / 6, 1e-15);
  const std::string text = run("eval two.obj 0 1/2 1/2 --channel uv --channel-rule all").out;
  EXPECT_NE(text.find("channel uv by the rule all\nvalue       0.2500000000000000  0.5000000000000000  "),
            std::string::npos)
      << text;
}

TEST_F(EvalChannel, AChannelTakesManyPoints) {
  write("two.obj", kTwoCharts);
  write("points.csv", "0,1,0\n1,0,0\n");
  EXPECT_EQ(
      run("eval two.obj --points points.csv --channel uv --derivatives 1 --channel-rule all --digits 4").out,
      "face,u,v,value_0,value_1,d1_0,d1_1,d2_0,d2_1\n0,1,0,0.5000,0,0.5000,0,0,1.000\n"
      "1,0,0,0.6250,0,0.3750,0,0,1.000\n");
}

TEST_F(EvalChannel, AChannelThatIsNoneOrCannotBeHasAClearError) {
  write("two.obj", kTwoCharts);
  EXPECT_NE(run("eval two.obj 0 0 0 --channel ''", 2).err.find("a channel has a name"), std::string::npos);
  EXPECT_NE(run("eval two.obj 0 0 0 --channel st", 2).err.find("the mesh has no channel 'st'; it has uv"),
            std::string::npos);
  EXPECT_NE(run("eval quad-cube 0 0 0 --channel uv", 2).err.find("it has none"), std::string::npos);
  EXPECT_NE(run("eval two.obj 0 0 0 --channel uv --channel-rule smooth", 2).err.find("--channel-rule"),
            std::string::npos);
  EXPECT_NE(run("eval two.obj 0 0 0 --channel-rule all", 2).err.find("--channel"), std::string::npos);
}

// The commands of README.md that evaluate a point without a subject.
TEST_F(EvalChannel, TheReadmesCommandsAreAnswered) {
  (void)run("generate pawn -o cage.obj", 0);
  std::istringstream readme(contents_of(LIMITCHECK_SOURCE "/README.md"));
  int commands = 0;
  for (std::string line; std::getline(readme, line);) {
    if (!line.starts_with("limitcheck eval ") || line.find("--subject") != line.npos) continue;
    ++commands;
    (void)run(
        line.substr(std::string("limitcheck ").size(), line.find('#') - std::string("limitcheck ").size()),
        0);
  }
  EXPECT_GE(commands, 2);
}

}  // namespace
}  // namespace limitcheck::cli
