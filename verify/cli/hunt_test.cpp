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
    json r = json::parse(read(file));
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
  EXPECT_NE(o.out.find("beside another extraordinary one"), std::string::npos) << o.out;
  EXPECT_NE(read("r.xml").find("beside another extraordinary one"), std::string::npos);
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
    EXPECT_EQ(file.path().string().find(".part"), std::string::npos) << file.path();
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
  for (const char* wrong :
       {"part1.json", "part1.json part1.json", "part1.json whole.json", "part1.json nothing.json"}) {
    const Outcome o = run(std::string("merge -o wrong.json ") + wrong);
    EXPECT_EQ(o.code, 2) << wrong;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.json"));
  }
}

TEST_F(HuntCommand, OneThatWasKilledGoesOnWhereItWas) {
  EXPECT_EQ(run(std::string(kHunt) + "--json whole.json --jobs 2").code, 1);
  write("kill.sh",
        std::string("'" LIMITCHECK_PROGRAM "' ") + kHunt +
            "--json r.json --jobs 2 > out 2>&1 &\nfor k in {1..400}; do [ -e r.json.part1 ] && break; sleep "
            "0.05; done\nkill -KILL $!\nwait $!\nsleep 1\n");
  (void)std::system(("cd '" + folder_.string() + "' && bash kill.sh 2> /dev/null").c_str());
  const Outcome o = run(std::string(kHunt) + "--json r.json --jobs 2 --resume");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_EQ(report("r.json"), report("whole.json"));
  write("r.json.part1", read("whole.json"));
  EXPECT_EQ(run(std::string(kHunt) + "--json r.json --jobs 2 --resume").code, 2)
      << "the part of another hunt";
}

TEST_F(HuntCommand, ASignalEndsItWithWhatItHas) {
  write("stop.sh", std::string("'" LIMITCHECK_PROGRAM "' ") +
                       "hunt sliding-window --time 1h --attempts 0 --json r.json > out 2>&1 &\nsleep 2\nkill "
                       "-TERM $!\nwait $!\necho $? > code\n");
  (void)std::system(("cd '" + folder_.string() + "' && bash stop.sh 2> /dev/null").c_str());
  EXPECT_EQ(read("code"), "143\n") << read("out");
  EXPECT_EQ(report("r.json")["incomplete"], "interrupted by SIGTERM");
  EXPECT_NE(read("out").find("INCOMPLETE"), std::string::npos);
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
  for (const char* arguments :
       {"", "nosuch", "row-stream --cases 0", "row-stream --time 0", "row-stream --time 5q",
        "row-stream --time -3s", "row-stream --shard 3/2", "row-stream --shard 1", "row-stream --resume",
        "row-stream --cases 3 --time 3s", "all", "openmesh --scheme loop --option a=b",
        "row-stream --baseline nothing.json", "row-stream --json x --junit x"}) {
    const Outcome o = run(std::string("hunt ") + arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_FALSE(o.err.empty()) << arguments;
  }
}

}  // namespace
}  // namespace limitcheck::cli
