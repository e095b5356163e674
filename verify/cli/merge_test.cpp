// SPDX-License-Identifier: MIT
// Parts of audits and proofs, merged, are the report of the whole; and a part that was killed goes on.
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "verify/cli/command_test.h"
#include "verify/shard/seal.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class Merge : public CommandTest {
 protected:
  // Byte for byte, but for times and how processes were held.
  std::string without_times(const std::string& file) const {
    std::istringstream in(read(file));
    std::string text;
    for (std::string line; std::getline(in, line);) {
      for (const char* key : {"\"seconds\": ", "\"containment\": ", "\"printed\": "})
        line = line.substr(0, line.find(key));
      text += line + "\n";
    }
    EXPECT_FALSE(text.empty()) << file;
    return text;
  }
  // `count` shards of a command that writes --json FILE, and what merge says.
  Outcome in_parts(const std::string& command, int count, const std::string& options = "") const {
    std::string parts;
    for (int k = count; k > 0; --k) {
      const std::string name = "part" + std::to_string(k) + ".json";
      const Outcome o =
          run(command + " --shard " + std::to_string(k) + "/" + std::to_string(count) + " --json " + name);
      EXPECT_LE(o.code, 1) << o.err;
      EXPECT_FALSE(std::filesystem::exists(folder_ / (name + "l")));
      parts += name + " ";
    }
    return run("merge " + parts + "-o merged.json " + options);
  }
  static constexpr const char* kFaulty =
      "audit faulty --option fault=one_ulp_crack,of=sliding-window tetrahedron octahedron wheel:7 cube ";
};

TEST_F(Merge, AuditsAreTheWhole) {
  const std::string all = "audit all octahedron cube-quads wheel:5 fan:3 tetrahedron --depth 2 ";
  EXPECT_EQ(run(all + "--json whole.json").code, 1);
  EXPECT_EQ(in_parts(all, 3).code, 1);
  EXPECT_EQ(without_times("merged.json"), without_times("whole.json"));
  const json report = json::parse(read("merged.json"));
  EXPECT_GT(report["causes"].size(), 3U);
  EXPECT_GT(report["results"].size(), 500U);
  EXPECT_GT(report["seconds"], 0);
}

TEST_F(Merge, MoreShardsThanMeshesAreTheWholeToo) {
  const std::string all = "audit sliding-window octahedron cube-quads --depth 1 --level quick ";
  EXPECT_EQ(run(all + "--json whole.json").code, 0);
  const Outcome o = in_parts(all, 4);
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_EQ(without_times("merged.json"), without_times("whole.json"));
}

TEST_F(Merge, NothingLookedAtIsSaidOfTheWholeOnly) {
  EXPECT_EQ(run("audit model quad-cube --depth 1 --json whole.json").code, 2);
  EXPECT_EQ(in_parts("audit model quad-cube --depth 1", 2).code, 2);
  EXPECT_EQ(without_times("merged.json"), without_times("whole.json"));
  EXPECT_EQ(in_parts("audit model octahedron quad-cube --depth 1 ", 2).code, 0)
      << "the part of the cube has nothing to say";
}

TEST_F(Merge, BaselinesWaiversAndJUnitAreOfTheWhole) {
  EXPECT_EQ(run(std::string(kFaulty) + "--depth 2 --json whole.json").code, 1);
  const Outcome o = in_parts(std::string(kFaulty) + "--depth 2", 2, "--baseline whole.json --junit j.xml");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_NE(read("j.xml").find("testsuite"), std::string::npos);
  for (const char* option : {"--baseline whole.json", "--waivers whole.json", "--require positions"})
    EXPECT_NE(run(std::string(kFaulty) + "--shard 1/2 --json x.json " + option).err.find("limitcheck merge"),
              std::string::npos);
  EXPECT_EQ(run("merge part1.json part2.json -o x.json --require normals").code, 1);
}

TEST_F(Merge, WrongPartsAreRefused) {
  const std::string all = "audit naive octahedron tetrahedron --depth 1 --level quick ";
  EXPECT_EQ(in_parts(all, 2).code, 0);
  EXPECT_EQ(
      run("audit naive octahedron tetrahedron --depth 2 --level quick --shard 2/2 --json other.json").code,
      0);
  EXPECT_EQ(run(all + "--json whole.json").code, 0);
  json part = json::parse(read("part2.json"));
  part["results"].erase(0);
  part.erase("digest");
  write("less.json", verify::sealed(part));
  part["incomplete"] = "interrupted by SIGINT";
  write("interrupted.json", verify::sealed(part));
  part["incomplete"] = "";
  part["digest"] = json::parse(read("part2.json"))["digest"];
  write("altered.json", part.dump());
  struct {
    const char *parts, *says;
  } const wrong[]{{"part1.json", "shard 2/2 is missing"},
                  {"part1.json part2.json part1.json", "shard 1/2 is there twice"},
                  {"part1.json other.json", "shard 2/2 is of another plan than shard 1/2"},
                  {"part1.json less.json", "shard 2/2 is incomplete"},
                  {"part1.json interrupted.json", "is incomplete: interrupted by SIGINT"},
                  {"part1.json altered.json", "altered.json: it was altered or damaged"},
                  {"part1.json whole.json", "whole.json: this is no part that --shard has made"},
                  {"part1.json nothing.json", "nothing.json"}};
  for (const auto& [parts, says] : wrong) {
    const Outcome o = run(std::string("merge -o wrong.json ") + parts);
    EXPECT_EQ(o.code, 2) << parts;
    EXPECT_NE(o.err.find(says), std::string::npos) << o.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.json"));
  }
  for (const char* arguments :
       {"--shard 1/2", "--shard 1/2 --json", "--shard 3/2 --json x.json", "--shard x --json x.json"})
    EXPECT_EQ(run("audit naive tetrahedron " + std::string(arguments)).code, 2) << arguments;
}

TEST_F(Merge, AShardThatWasKilledGoesOnWhereItWas) {
  // The second case hangs until there is `go`.
  write(
      "slow.sh",
      "read -r line\necho '{\"limitcheck\": 1, \"status\": \"ok\", \"precision\": \"float64\", \"weights\": "
      "\"loop\", \"boundary\": \"spline\", \"points\": \"limit\", \"max_depth\": 6, \"normals\": true, "
      "\"per_face_depth\": false, \"exact_lattice\": true}'\nread -r line || exit 0\n"
      "n=$(cat n 2> /dev/null || echo 0); n=$((n + 1)); echo $n > n\n"
      "if [ $n = 2 ] && [ ! -e go ]; then sleep 1000; fi\n"
      "echo '{\"status\": \"failed\", \"message\": \"no\"}'\n");
  const std::string all =
      "audit --program 'bash slow.sh' tetrahedron wheel:5 octahedron wheel:7 --depth 1 --level quick ";
  write("kill.sh", "'" LIMITCHECK_PROGRAM "' " + all +
                       "--shard 1/2 --json part1.json > out 2>&1 &\nfor k in {1..600}; do [ \"$(cat n 2> "
                       "/dev/null)\" = 2 ] && break; sleep 0.05; done\nkill -KILL $!\nwait $!\ntouch go\n");
  (void)std::system(("cd '" + folder_.string() + "' && bash kill.sh 2> /dev/null").c_str());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "part1.jsonl"));
  EXPECT_EQ(run(all + "--shard 2/2 --json part1.json --resume").code, 2) << "another shard";
  EXPECT_EQ(run(all + "--shard 1/2 --json part1.json --resume").code, 1);
  EXPECT_EQ(read("n"), "3\n") << "the first mesh is not asked again";
  EXPECT_EQ(run(all + "--shard 2/2 --json part2.json").code, 1);
  EXPECT_EQ(run("merge part1.json part2.json -o merged.json").code, 1);
  EXPECT_EQ(run(all + "--json whole.json").code, 1);
  EXPECT_EQ(without_times("merged.json"), without_times("whole.json"));
}

TEST_F(Merge, ProofsAreTheWhole) {
  const std::string all = "prove --valences 3 --depth 0 --kernel row-stream ";
  EXPECT_EQ(run(all + "--json whole.json").code, 0);
  EXPECT_EQ(in_parts(all, 2).code, 0);
  EXPECT_EQ(without_times("merged.json"), without_times("whole.json"));
  EXPECT_EQ(run("merge part1.json -o x.json").code, 2);
  EXPECT_EQ(run("merge part1.json part2.json -o x.json --baseline whole.json").code, 2);

  // The last unit are the stock shapes: mesh, kernel, depth, points, position, normal, ...
  const auto last = [](json& part) -> json& { return part["results"].back(); };
  json parts[]{json::parse(read("part1.json")), json::parse(read("part2.json"))};
  const std::size_t holder = last(parts[0])[0] > last(parts[1])[0] ? 0 : 1;
  const std::string sound = holder == 0 ? "part2.json" : "part1.json";
  const auto merged_with = [&](const std::function<void(json&)>& edit) {
    json edited = parts[holder];
    edit(last(edited)[1]);
    edited.erase("digest");  // written again by one who knows how: the figures are judged all the same
    write("edited.json", verify::sealed(edited));
    return run("merge edited.json " + sound + " -o edited-whole.json");
  };
  EXPECT_EQ(merged_with([](json&) {}).code, 0);
  for (const std::size_t figure : {4, 5}) {
    const Outcome o = merged_with([&](json& lines) { lines[3][figure] = .5; });
    EXPECT_EQ(o.code, 1) << figure << o.out;
    EXPECT_FALSE(json::parse(read("edited-whole.json"))["held"].get<bool>()) << figure;
    EXPECT_NE(o.out.find("EXCEEDED"), std::string::npos) << o.out;
  }
  for (const json& nothing : {json(), json::array()}) {
    EXPECT_EQ(merged_with([&](json& lines) { lines = nothing; }).code, 1);
    EXPECT_FALSE(json::parse(read("edited-whole.json"))["complete"].get<bool>());
  }
  EXPECT_EQ(merged_with([](json& lines) { lines.erase(3); }).code, 1);
}

}  // namespace
}  // namespace limitcheck::cli
