// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class HuntCommand : public CommandTest {
 protected:
  // Without what differs from run to run.
  json report(const std::string& file) const {
    json r = json_in(file);
    r.erase("seconds"), r.erase("digest");  // the digest is of the seconds, too
    return r;
  }
  static constexpr const char* kHunt =
      "hunt faulty --option fault=adjacent_extraordinary,of=sliding-window --scheme loop --cases 32 "
      "--attempts 10 --in-process ";
};

TEST_F(HuntCommand, SmallMeshesAndCommandsShowWhatWasFound) {
  const Outcome o = run(std::string(kHunt) + "--json r.json --junit r.xml --witnesses w");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_TRUE(says(o.out, "beside another extraordinary one"));
  EXPECT_TRUE(says(read("r.xml"), "beside another extraordinary one"));
  const json r = report("r.json");
  int small = 0;
  for (const json& f : r["findings"]) {
    EXPECT_GT(f["cases"], 0);
    if (f["witness"] == "" || f["check"] != "positions" || ++small > 1) continue;
    EXPECT_TRUE(std::filesystem::exists(folder_ / std::string(f["witness"]) / "control.obj"));
    const std::string command = f["command"].get<std::string>().substr(std::string("limitcheck ").size());
    EXPECT_EQ(run(command).code, 1) << command << ": the command shows a difference";
    EXPECT_EQ(run(f["found_on"].get<std::string>().substr(std::string("limitcheck ").size())).code, 1);
  }
  EXPECT_GT(small, 0);
  for (const auto& file : std::filesystem::directory_iterator(folder_))
    EXPECT_FALSE(says(file.path().string(), ".part")) << file.path();
  const Outcome again = run(std::string(kHunt) + "--baseline r.json");
  EXPECT_EQ(again.code, 0) << again.out;
}

TEST_F(HuntCommand, PartsAreMergedToTheWhole) {
  EXPECT_EQ(run(std::string(kHunt) + "--json whole.json --jobs 1").code, 1);
  EXPECT_EQ(run(std::string(kHunt) + "--json jobs.json --jobs 3").code, 1);
  EXPECT_EQ(report("jobs.json"), report("whole.json"));
  for (const char* k : {"1", "2"})
    EXPECT_EQ(run(std::string(kHunt) + "--jobs 2 --shard " + k + "/2 --json part" + k + ".json").code, 1);
  EXPECT_EQ(run("merge part2.json part1.json -o merged.json").code, 1);
  EXPECT_EQ(report("merged.json"), report("whole.json"));
  expect_refused("merge -o wrong.json",
                 {"part1.json", "part1.json part1.json", "part1.json whole.json", "part1.json nothing.json"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.json"));
}

TEST_F(HuntCommand, OneThatWasKilledGoesOnWhereItWas) {
  EXPECT_EQ(run(std::string(kHunt) + "--json whole.json --jobs 2").code, 1);
  (void)signalled(std::string(kHunt) + "--json r.json --jobs 2", "[ -e r.json.part1 ]", "KILL");
  (void)shell("sleep 1");
  const Outcome o = run(std::string(kHunt) + "--json r.json --jobs 2 --resume");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_EQ(report("r.json"), report("whole.json"));
  write("r.json.part1", read("whole.json"));
  EXPECT_EQ(run(std::string(kHunt) + "--json r.json --jobs 2 --resume").code, 2)
      << "the part of another hunt";
}

TEST_F(HuntCommand, ASignalEndsItWithWhatItHas) {
  const Outcome o =
      signalled("hunt sliding-window --time 1h --attempts 0 --json r.json", "[ $k = 40 ]", "TERM");
  EXPECT_EQ(o.code, 143) << o.out;
  EXPECT_EQ(report("r.json")["incomplete"], "interrupted by SIGTERM");
  EXPECT_TRUE(says(o.out, "INCOMPLETE"));
}

TEST_F(HuntCommand, ASubjectThatDiesIsAFinding) {
  write("dies.sh", "read -r line\nkill -SEGV $$\n");
  const Outcome o = run("hunt --program 'bash dies.sh' --cases 2 --attempts 4 --json r.json");
  EXPECT_EQ(o.code, 1) << o.err << o.out;
  bool crash = false;
  const json r = report("r.json");
  for (const json& f : r["findings"]) crash = crash || f["status"] == "crash";
  EXPECT_TRUE(crash) << o.out;
}

TEST_F(HuntCommand, NonsenseIsRefused) {
  expect_refused("hunt", {"", "nosuch", "row-stream --cases 0", "row-stream --time 0", "row-stream --time 5q",
                          "row-stream --time -3s", "row-stream --shard 3/2", "row-stream --shard 1",
                          "row-stream --resume", "row-stream --cases 3 --time 3s", "all",
                          "openmesh --scheme loop --option a=b", "row-stream --baseline nothing.json",
                          "row-stream --json x --junit x"});
}

}  // namespace
}  // namespace limitcheck::cli
