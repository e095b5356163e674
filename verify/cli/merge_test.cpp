// SPDX-License-Identifier: MIT
// Parts of audits and proofs, merged, are the report of the whole; and a part that was killed goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "verify/cli/command_test.h"
#include "verify/shard/shard.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

constexpr const char* kSecond = "[ \"$(cat n 2> /dev/null)\" = 2 ]";  // the second case has begun

class Merge : public CommandTest {
 protected:
  // Byte for byte, but for times, and how processes were held and what they took.
  std::vector<std::string> without_times(const std::string& file) const {
    std::istringstream in(read(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
      for (const char* key : {"\"digest\":", "\"seconds\": ", "\"containment\": ", "\"printed\": ",
                              "\"processes\": ", "\"most_at_once\": ", "\"peak_bytes\": "})
        line = line.substr(0, line.find(key));
      lines.push_back(std::move(line));
    }
    EXPECT_FALSE(lines.empty()) << file;
    return lines;
  }
  // One line is shown, and not what GoogleTest says of unlike texts: it takes memory as the square of their lengths.
  void expect_merged_is_whole() const {
    const std::vector<std::string> merged = without_times("merged.json"), whole = without_times("whole.json");
    const auto [m, w] = std::mismatch(merged.begin(), merged.end(), whole.begin(), whole.end());
    EXPECT_TRUE(m == merged.end() && w == whole.end())
        << "line " << m - merged.begin() + 1 << ": " << (m == merged.end() ? "the end" : *m) << "\nand not "
        << (w == whole.end() ? "the end" : *w);
  }
  /// As one writes it who knows how to seal it.
  void write_sealed(const std::string& file, json report) const {
    report.erase("digest");
    write(file, verify::sealed(report));
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
  expect_merged_is_whole();
  const json report = json_in("merged.json");
  EXPECT_GT(report["causes"].size(), 3U);
  EXPECT_GT(report["results"].size(), 500U);
  EXPECT_GT(report["seconds"], 0);
}

TEST_F(Merge, OfExhaustiveAuditsNamesTheNeighbourhoodThatIsWrong) {
  const std::string faulty =
      "audit faulty --option fault=crease_of_valence_3,of=row-stream --scheme loop --exhaustive 3 ";
  EXPECT_EQ(run(faulty + "--json whole.json").code, 1);
  EXPECT_EQ(in_parts(faulty, 3).code, 1);
  expect_merged_is_whole();
  const json wrong = json::parse(read("merged.json"))["exhaustive"].at(0);
  EXPECT_FALSE(wrong["right"].get<bool>());
  EXPECT_EQ(wrong["looked_at"], wrong["neighbourhoods"]);
  for (const json& star : wrong["examples"]) EXPECT_TRUE(says(star.get<std::string>(), "w=.JJ")) << star;
  const Outcome right = run("audit row-stream --exhaustive 3 --json right.json", 0);
  const json of_right = json_in("right.json");
  for (const json& scheme : of_right["exhaustive"]) {
    EXPECT_TRUE(scheme["right"].get<bool>());
    EXPECT_TRUE(says(right.out, "right on every neighbourhood up to valence 3: " +
                                    std::to_string(scheme["neighbourhoods"].get<int>())));
  }
  EXPECT_EQ(run("audit row-stream octahedron --exhaustive 3").code, 2);
  EXPECT_EQ(run("audit row-stream --depth 1 --exhaustive 3").code, 2);
  EXPECT_EQ(run("audit all --exhaustive 3").code, 2);
}

TEST_F(Merge, MoreShardsThanMeshesAreTheWholeToo) {
  const std::string all = "audit sliding-window octahedron cube-quads --depth 1 --level quick ";
  EXPECT_EQ(run(all + "--json whole.json").code, 0);
  const Outcome o = in_parts(all, 4);
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  expect_merged_is_whole();
}

TEST_F(Merge, NothingLookedAtIsSaidOfTheWholeOnly) {
  EXPECT_EQ(run("audit model quad-cube --depth 1 --json whole.json").code, 2);
  EXPECT_EQ(in_parts("audit model quad-cube --depth 1", 2).code, 2);
  expect_merged_is_whole();
  EXPECT_EQ(in_parts("audit model octahedron quad-cube --depth 1 ", 2).code, 0)
      << "the part of the cube has nothing to say";
}

TEST_F(Merge, BaselinesWaiversAndJUnitAreOfTheWhole) {
  EXPECT_EQ(run(std::string(kFaulty) + "--depth 2 --json whole.json").code, 1);
  const Outcome o = in_parts(std::string(kFaulty) + "--depth 2", 2, "--baseline whole.json --junit j.xml");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_TRUE(says(read("j.xml"), "testsuite"));
  for (const char* option : {"--baseline whole.json", "--waivers whole.json", "--require positions"})
    EXPECT_TRUE(
        says(run(std::string(kFaulty) + "--shard 1/2 --json x.json " + option).err, "limitcheck merge"));
  EXPECT_EQ(run("merge part1.json part2.json -o x.json --require normals").code, 1);
}

TEST_F(Merge, WrongPartsAreRefused) {
  const std::string all = "audit naive octahedron tetrahedron --depth 1 --level quick ";
  EXPECT_EQ(in_parts(all, 2).code, 0);
  EXPECT_EQ(
      run("audit naive octahedron tetrahedron --depth 2 --level quick --shard 2/2 --json other.json").code,
      0);
  EXPECT_EQ(run(all + "--json whole.json").code, 0);
  json part = json_in("part2.json");
  part["results"].erase(0);
  write_sealed("less.json", part);
  part["incomplete"] = "interrupted by SIGINT";
  write_sealed("interrupted.json", part);
  part["incomplete"] = "";
  part["digest"] = json_in("part2.json")["digest"];
  write("altered.json", part.dump());
  struct {
    const char *parts, *sentence;
  } const wrong[]{{"part1.json", "shard 2/2 is missing"},
                  {"part1.json part2.json part1.json", "shard 1/2 is there twice"},
                  {"part1.json other.json", "shard 2/2 is of another plan than shard 1/2"},
                  {"part1.json less.json", "shard 2/2 is incomplete"},
                  {"part1.json interrupted.json", "is incomplete: interrupted by SIGINT"},
                  {"part1.json altered.json", "altered.json: it was altered or damaged"},
                  {"part1.json whole.json", "whole.json: this is no part that --shard has made"},
                  {"part1.json nothing.json", "nothing.json"}};
  for (const auto& [parts, sentence] : wrong) {
    const Outcome o = run(std::string("merge -o wrong.json ") + parts, 2);
    EXPECT_TRUE(says(o.err, sentence));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "wrong.json"));
  }
  expect_refused("audit naive tetrahedron", {"--shard 1/2", "--shard 1/2 --json", "--shard 3/2 --json x.json",
                                             "--shard x --json x.json"});
}

// A unit's result in a part: its rows, each a list of subject, mesh, check, depth, ...
constexpr std::size_t kCheck = 8, kDepth = 2, kSample = 4, kWorst = 12;
json::iterator find_row(json& rows, const std::string& check) {
  return std::find_if(rows.begin(), rows.end(), [&](const json& row) { return row[kCheck] == check; });
}
json& row_of(json& rows, const std::string& check) {
  return *find_row(rows, check);
}

TEST_F(Merge, APartWhoseRowsAreNotThoseOfThePlanIsRefused) {
  const std::string all = "audit naive octahedron tetrahedron cube --depth 1 --level quick ";
  EXPECT_EQ(in_parts(all, 2).code, 0);
  struct {
    const char* sentence;
    std::function<void(json&)> edit;  // of the rows of its first unit
    int code = 2;
  } const wrong[]{
      {"", [](json&) {}, 0},
      {"positions says held, and its numbers say finding",
       [](json& rows) { row_of(rows, "positions")[kWorst] = .5; }},
      {"ginite is no row of it", [](json& rows) { row_of(rows, "finite")[kCheck] = "ginite"; }},
      {"there is no row positions", [](json& rows) { rows.erase(find_row(rows, "positions")); }},
      {"finite is no row of it, or is there twice",
       [](json& rows) { rows.push_back(row_of(rows, "finite")); }},
      {"the row finite is of naive on octahedron, depth 3",
       [](json& rows) { row_of(rows, "finite")[kDepth] = 3; }},
      {"the row finite is of naive on octahedron, depth 1 uniform 7:1",
       [](json& rows) { row_of(rows, "finite")[kSample] = "7:1"; }},
      {"there is no row", [](json& rows) { rows = json::array(); }},
  };
  for (const auto& [sentence, edit, code] : wrong) {
    json part = json_in("part1.json");
    edit(part["results"][0][1]);
    write_sealed("edited.json", part);
    const Outcome o = run("merge edited.json part2.json -o merged.json");
    EXPECT_EQ(o.code, code) << sentence << o.out;
    EXPECT_TRUE(says(o.err, sentence));
    EXPECT_EQ(run("merge --verify edited.json").code, code == 0 ? 0 : 1);
  }
  json part = json_in("part1.json");  // units 0 and 2
  part["results"][1][1] = part["results"][0][1];
  write_sealed("edited.json", part);
  EXPECT_TRUE(says(run("merge edited.json part2.json -o x.json").err,
                   "unit 2, naive on cube: the row tessellates is of naive on octahedron"));
}

TEST_F(Merge, ReceiptsOfPartsAddUpAndMayBeMissing) {
  const std::string all = "audit naive octahedron tetrahedron cube --isolate --depth 1 --level quick ";
  EXPECT_EQ(in_parts(all, 2).code, 0);
  const auto receipt = [&](const char* file) { return json_in(file)["receipts"].at(0); };
  json parts[2];
  for (int k = 0; k < 2; ++k) {
    json part = json_in(k == 0 ? "part1.json" : "part2.json");
    parts[k] = part["receipts"].at(0);
    part.erase("receipts");
    write_sealed("old" + std::to_string(k) + ".json", part);
  }
  // Fields of a receipt in a part, in order: subject, processes, most_at_once, peak_bytes, ...
  EXPECT_EQ(receipt("merged.json")["subject"], "naive");
  EXPECT_EQ(receipt("merged.json")["processes"], parts[0][1].get<int>() + parts[1][1].get<int>());
  EXPECT_GE(receipt("merged.json")["processes"], 3);
  EXPECT_EQ(receipt("merged.json")["peak_bytes"], std::max(parts[0][3], parts[1][3]));
  EXPECT_EQ(run("merge old0.json old1.json -o merged.json").code, 0) << "of an earlier version";
  EXPECT_EQ(json_in("merged.json")["receipts"], json::array());
  json part = json_in("part1.json");
  part["receipts"][0][1] = -1;
  write_sealed("old0.json", part);
  EXPECT_EQ(run("merge old0.json old1.json -o merged.json").code, 2);
}

TEST_F(Merge, AReceiptOutlivesAKill) {
  const std::string all =
      "audit naive octahedron tetrahedron bumpy:4000 --isolate --timeout 600 --depth 5 --level quick --json "
      "r.json ";
  (void)signalled(all, "[ \"$(wc -l < r.jsonl)\" = 3 ]", "KILL");
  std::istringstream lines(read("r.jsonl"));
  std::string line, old;
  int before = 0;
  while (std::getline(lines, line)) {
    json record = json::parse(line);
    if (record.contains("receipts")) before = record["receipts"].at(0)[1];
    record.erase("receipts"), record.erase("digest");
    old += record.contains("unit") ? verify::sealed(record) : line + "\n";
  }
  const std::string journal = read("r.jsonl");
  const auto resumed = [&](const std::string& text) {
    std::filesystem::remove(folder_ / "r.json");
    write("r.jsonl", text);
    EXPECT_EQ(run(all + "--resume").code, 0);
    return json_in("r.json")["receipts"].at(0)["processes"].get<int>();
  };
  const int without = resumed(old);
  EXPECT_GE(before, 2);
  EXPECT_EQ(resumed(journal), before + without);
}

TEST_F(Merge, AResultOfAMutantIsNoneOfRightSubjects) {
  for (const char* shard : {"1/2", "2/2"}) {  // nothing is audited: results are as easily written as read
    json part{{"program", "limitcheck mutants"},
              {"plan", json::object()},
              {"units", 4000},
              {"together", 4000},
              {"shard", shard},
              {"seconds", 0},
              {"containment", ""},
              {"printed", ""},
              {"incomplete", ""}};
    part["results"] = json::array();
    for (int unit = 0; unit < 4000 && shard[0] == '1'; ++unit)
      part["results"].push_back(
          {unit, {{"mutant", "another"}, {"killed_by", {"positions"}}, {"on", "cube"}}});
    write_sealed(std::string("m") + shard[0] + ".json", part);
  }
  const Outcome o = run("merge m1.json m2.json -o x.json", 2);
  EXPECT_TRUE(says(o.err, "unit 0 is a case of right subjects, and its result is of another kind"));
}

TEST_F(Merge, AJournalInWhichAllUnitsAreTheFirstIsRefused) {
  const std::string all =
      "audit naive octahedron tetrahedron bumpy:4000 --depth 5 --level quick --json r.json ";
  (void)signalled(all, "[ \"$(wc -l < r.jsonl)\" = 3 ]", "KILL");
  std::istringstream lines(read("r.jsonl"));
  std::string journal, line;
  json first;
  for (std::size_t k = 0; k < 3 && std::getline(lines, line); ++k) {
    json record = json::parse(line);
    record.erase("digest");
    if (k == 1) first = record["result"];
    if (k == 2) record["result"] = first;
    journal += k == 0 ? line + "\n" : verify::sealed(record);
  }
  write("r.jsonl", journal);
  const Outcome o = run(all + "--resume", 2);
  EXPECT_TRUE(says(o.err, "unit 1, naive on tetrahedron: the row tessellates is of naive on octahedron"));
}

TEST_F(Merge, VerifySaysWhetherAReportIsWholeAndUnaltered) {
  for (const char* command :
       {"audit naive octahedron --depth 1 --level quick", "prove --valences 3 --depth 0 --kernel row-stream",
        "hunt naive --cases 2 --attempts 0 --in-process --jobs 1"}) {
    EXPECT_EQ(run(std::string(command) + " --json r.json").code, 0) << command;
    const Outcome whole = run("merge --verify r.json", 0);
    EXPECT_TRUE(says(whole.out, "r.json: whole and as it was written, by limitcheck"));
    EXPECT_TRUE(says(whole.out, " of this program"));
    const json report = json_in("r.json");
    for (const char* key : {"program", "plan"})
      EXPECT_EQ(report["attested"][key].get<std::string>().size(), 64U) << command;
    std::string text = read("r.json");
    text[text.find("\"version\": \"") + 13] = '9';
    write("altered.json", text);
    const Outcome altered = run("merge --verify altered.json", 1);
    EXPECT_TRUE(says(altered.out, "altered.json: it was altered or damaged"));
    EXPECT_EQ(altered.err, "");
  }
  EXPECT_EQ(run("audit naive octahedron tetrahedron --depth 1 --level quick --json r.json").code, 0);
  json report = json_in("r.json");
  EXPECT_EQ(report["attested"]["meshes"].size(), 2U);
  EXPECT_NE(report["attested"]["meshes"][0][1], report["attested"]["meshes"][1][1]);
  const auto sealed_again = [&](const json& edited) {
    write_sealed("edited.json", edited);
    return run("merge --verify edited.json").out;
  };
  json edited = report;
  edited["incomplete"] = "interrupted by SIGINT";
  EXPECT_TRUE(says(sealed_again(edited), "edited.json: it is incomplete: interrupted by SIGINT"));
  edited = report;
  for (json& row : edited["results"])
    if (row["check"] == "positions") row["worst"] = .5;
  EXPECT_TRUE(
      says(sealed_again(edited), "positions of naive on octahedron says held, and its numbers say finding"));
  for (const char* key : {"status", "count", "of", "worst", "bound"}) {
    edited = report;
    edited["results"][0].erase(key);
    EXPECT_TRUE(says(sealed_again(edited), "it is no report")) << key;
    edited["results"][0][key] = json::object();
    EXPECT_TRUE(says(sealed_again(edited), "it is no report")) << key;
  }
  report.erase("digest");
  write("edited.json", report.dump());
  const Outcome none = run("merge --verify edited.json", 2);
  EXPECT_TRUE(says(none.err, "it carries no digest"));
  expect_refused("merge", {"--verify gone.json", "--verify r.json r.json", "-o x.json", "r.json"});
}

TEST_F(Merge, AShardThatWasKilledGoesOnWhereItWas) {
  // The second case hangs until there is `go`.
  write("slow.sh", kTellsWhatItCan +
                       "n=$(cat n 2> /dev/null || echo 0); n=$((n + 1)); echo $n > n\n"
                       "if [ $n = 2 ] && [ ! -e go ]; then sleep 1000; fi\n"
                       "echo '{\"status\": \"failed\", \"message\": \"no\"}'\n");
  const std::string all =
      "audit --program 'bash slow.sh' tetrahedron wheel:5 octahedron wheel:7 --depth 1 --level quick ";
  (void)signalled(all + "--shard 1/2 --json part1.json", kSecond, "KILL");
  write("go", "");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "part1.jsonl"));
  EXPECT_EQ(run(all + "--shard 2/2 --json part1.json --resume").code, 2) << "another shard";
  EXPECT_EQ(run(all + "--shard 1/2 --json part1.json --resume").code, 1);
  EXPECT_EQ(read("n"), "3\n") << "the first mesh is not asked again";
  EXPECT_EQ(run(all + "--shard 2/2 --json part2.json").code, 1);
  EXPECT_EQ(run("merge part1.json part2.json -o merged.json").code, 1);
  EXPECT_EQ(run(all + "--json whole.json").code, 1);
  expect_merged_is_whole();
}

TEST_F(Merge, ProofsAreTheWhole) {
  const std::string all = "prove --valences 3 --depth 0 --kernel row-stream ";
  EXPECT_EQ(run(all + "--json whole.json").code, 0);
  EXPECT_EQ(in_parts(all, 2).code, 0);
  expect_merged_is_whole();
  EXPECT_EQ(run("merge part1.json -o x.json").code, 2);
  EXPECT_EQ(run("merge part1.json part2.json -o x.json --baseline whole.json").code, 2);

  // The last unit are the stock shapes: mesh, kernel, depth, points, position, normal, ...
  const auto last = [](json& part) -> json& { return part["results"].back(); };
  json parts[]{json_in("part1.json"), json_in("part2.json")};
  const std::size_t holder = last(parts[0])[0] > last(parts[1])[0] ? 0 : 1;
  const std::string sound = holder == 0 ? "part2.json" : "part1.json";
  const auto merged_with = [&](const std::function<void(json&)>& edit) {
    json edited = parts[holder];
    edit(last(edited)[1]);
    write_sealed("edited.json", edited);  // the figures are judged all the same
    return run("merge edited.json " + sound + " -o edited-whole.json");
  };
  EXPECT_EQ(merged_with([](json&) {}).code, 0);
  for (const std::size_t figure : {4, 5}) {
    const Outcome o = merged_with([&](json& lines) { lines[3][figure] = .5; });
    EXPECT_EQ(o.code, 1) << figure << o.out;
    EXPECT_FALSE(json_in("edited-whole.json")["held"].get<bool>()) << figure;
    EXPECT_TRUE(says(o.out, "EXCEEDED"));
  }
  for (const json& nothing : {json(), json::array()}) {
    EXPECT_EQ(merged_with([&](json& lines) { lines = nothing; }).code, 1);
    EXPECT_FALSE(json_in("edited-whole.json")["complete"].get<bool>());
  }
  EXPECT_EQ(merged_with([](json& lines) { lines.erase(3); }).code, 1);
}

}  // namespace
}  // namespace limitcheck::cli
