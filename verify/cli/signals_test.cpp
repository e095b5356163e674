// SPDX-License-Identifier: MIT
// What signals leave: an audit that SIGKILL ends loses nothing but the mesh it was at, a hunt nothing but its case.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class Resume : public CommandTest {
 protected:
  // Says what it can do and fails, counting how often; from the second time on it does not answer until there
  // is `go`.
  void SetUp() override {
    CommandTest::SetUp();
    write("m.off", kVertices + "4 0 1 2 3\n4 4 5 6 7\n");
    write("fails.sh", kTellsWhatItCan +
                          "n=$(cat n 2> /dev/null || echo 0); n=$((n + 1)); echo $n > n\n"
                          "if [ $n -ge 2 ] && [ ! -e go ]; then sleep 1000; fi\n"
                          "echo \"{\\\"status\\\": \\\"failed\\\", \\\"message\\\": \\\"time $n\\\"}\"\n");
    (void)signalled(kArguments, "[ \"$(cat n 2> /dev/null)\" = 2 ]", "KILL");  // the second case has begun
    write("go", "");
  }
  static inline const std::string kVertices =
      "OFF\n8 2 0\n0 0 0\n2 0 0\n3 1 0\n2 2 0\n0 2 0\n-1 1 1\n5 0 0\n5 1 0\n";
  static constexpr const char* kArguments =
      "audit --program 'bash fails.sh' tetrahedron octahedron m.off --depth 1 --level quick --json r.json ";
};

TEST_F(Resume, AnAuditThatWasKilledGoesOnWhereItWas) {
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.json"));
  const std::string journal = read("r.jsonl");
  EXPECT_EQ(std::count(journal.begin(), journal.end(), '\n'), 2) << journal;
  std::ofstream(folder_ / "r.jsonl", std::ios::app) << R"({"subject": "prog)";  // killed while it wrote

  const Outcome o = run(std::string(kArguments) + "--resume", 1);
  const json report = json_in("r.json");
  EXPECT_TRUE(report["incomplete"].is_null());
  const auto said = [&](const char* mesh) {
    for (const json& r : report["results"])
      if (r["mesh"] == mesh && r["check"] == "tessellates") return r["message"].get<std::string>();
    return std::string("no row");
  };
  EXPECT_TRUE(says(said("tetrahedron"), "time 1")) << "not asked again: ";
  EXPECT_TRUE(says(said("octahedron"), "time 3"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.jsonl")) << "the report has it all";
}

TEST_F(Resume, AnotherAuditIsNotResumed) {
  for (const auto& [was, is] :
       {std::pair{"--depth 1", "--depth 2"}, std::pair{"--level quick", "--level standard"},
        std::pair{"octahedron", "icosahedron"}}) {
    std::string other = kArguments;
    other.replace(other.find(was), std::string(was).size(), is);
    const Outcome o = run(other + "--resume", 2);
    EXPECT_TRUE(says(o.err, "--resume: r.jsonl is of another plan"));
  }
  write("m.off", kVertices + "3 0 1 2\n5 3 4 5 6 7\n");  // the same corners in faces of other sizes
  const Outcome o = run(std::string(kArguments) + "--resume", 2);
  EXPECT_TRUE(says(o.err, "--resume: r.jsonl is of another plan"));
  EXPECT_TRUE(says(run("audit naive tetrahedron --resume").err, "--resume needs --json"));
  EXPECT_TRUE(says(run("audit naive tetrahedron --json none.json --resume").err, "there is no none.jsonl"));
}

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

TEST_F(HuntCommand, OneThatWasKilledGoesOnWhereItWas) {
  EXPECT_EQ(run(std::string(kHunt) + "--json whole.json --jobs 2").code, 1);
  (void)signalled(std::string(kHunt) + "--json r.json --jobs 2", "[ -e r.json.part1 ]", "KILL");
  (void)shell("sleep 1");
  const Outcome o = run(std::string(kHunt) + "--json r.json --jobs 2 --resume", 1);
  EXPECT_EQ(report("r.json"), report("whole.json"));
  write("r.json.part1", read("whole.json"));
  EXPECT_EQ(run(std::string(kHunt) + "--json r.json --jobs 2 --resume").code, 2)
      << "the part of another hunt";
}

TEST_F(HuntCommand, ASignalEndsItWithWhatItHas) {
#ifdef LIMITCHECK_SANITIZED
  const std::string later = "[ $k = 400 ]";  // twentieths of a second, until it has begun
#else
  const std::string later = "[ $k = 40 ]";
#endif
  const Outcome o = signalled("hunt sliding-window --time 1h --attempts 0 --json r.json", later, "TERM");
  EXPECT_EQ(o.code, 143) << o.out;
  EXPECT_EQ(report("r.json")["incomplete"], "interrupted by SIGTERM");
  EXPECT_TRUE(says(o.out, "INCOMPLETE"));
}

using Claims = CommandTest;

// Neither the test program, nor what that has started, nor the folder for their output.
TEST_F(Claims, ASignalLeavesNothingBehind) {
  write("claims_programs.txt", "hangs\n");
  const std::string unique = std::to_string(getpid()) + "002";
  write("hangs", "#!/bin/sh\nsleep " + unique + " &\ntouch up\nwait\n");
  std::filesystem::permissions(folder_ / "hangs", std::filesystem::perms::owner_all);
  for (const auto& [signal, code] : {std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 129}}) {
    std::filesystem::remove(folder_ / "up");
    const Outcome o = signalled("claims C14 --programs .", "[ -e up ]", signal, unique);
    EXPECT_EQ(o.code, code) << o.err;
    EXPECT_EQ(o.out, "");
    EXPECT_EQ(o.err, "limitcheck: interrupted by SIG" + std::string(signal) + "\n");
  }
}

using Signals = CommandTest;

// A built-in subject in this process, and the reference, look for no signal.
TEST_F(Signals, ASignalEndsWhatTakesLong) {
  for (const std::string command : {"audit naive bumpy:4000 --depth 6 --json r.json",
                                    "audit naive bipyramid:60000 --depth 1 --json r.json"}) {
    std::filesystem::remove(folder_ / "r.jsonl");
    const Outcome o = signalled(command + " --level quick", "[ -e r.jsonl ] && sleep 0.5", "TERM");
    EXPECT_EQ(o.code, 143) << command << o.err;
    EXPECT_TRUE(says(o.out, "INCOMPLETE: interrupted by SIGTERM"));
    EXPECT_EQ(json_in("r.json")["incomplete"], "interrupted by SIGTERM");
  }
}

TEST_F(Signals, ASignalEndsTheQuestionWhetherBrokenMeshesAreRefused) {
  write("mute.sh", "touch asked\nsleep 1000\n");
  write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n");
  const Outcome o =
      signalled("audit --must-refuse --program 'bash mute.sh' broken.obj", "[ -e asked ]", "TERM");
  EXPECT_EQ(o.code, 143) << o.out << o.err;
}

TEST_F(Signals, ASignalLeavesAPartialReportAndNoProcess) {
  // Says what it can do, and is silent from then on.
  write("mute.sh", kTellsWhatItCan + "touch asked\nsleep 123456 &\nwait\n");
  for (const auto& [signal, code] : {std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 129}}) {
    (void)shell("rm -f asked r.jsonl");
    const Outcome o = signalled(
        "audit --program 'bash mute.sh' tetrahedron icosahedron --depth 1 --level quick --json r.json",
        "[ -e asked ] && sleep 0.2", signal, "123456");
    EXPECT_EQ(o.code, code) << signal << o.err;
    EXPECT_TRUE(says(o.out, "INCOMPLETE: interrupted by SIG" + std::string(signal)));
    const json report = json_in("r.json");
    EXPECT_EQ(report["incomplete"], "interrupted by SIG" + std::string(signal));
    EXPECT_EQ(report["held"], false);
    EXPECT_GT(report["results"].size(), 10U) << "a row for each check of the mesh that was begun";
    for (const auto& row : report["results"]) EXPECT_EQ(row["status"], "not-run") << row;
  }
}

}  // namespace
}  // namespace limitcheck::cli
