// SPDX-License-Identifier: MIT
// An audit that SIGKILL ends loses nothing but the mesh it was at.
#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace limitcheck::cli
