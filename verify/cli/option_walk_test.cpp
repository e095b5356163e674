// SPDX-License-Identifier: MIT
// Every option of every command does something: what the command says, its exit code or the files that it leaves are
// others with it than without it; or it is said here to change nothing but the time, and changes nothing. (The options of
// an audit of finished files: sessions/files.sh.)
#include <map>
#include <regex>
#include <set>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

/// What is compared: the arguments without an option, and with it and its value behind them.
struct Trial {
  std::string without, value;  // without empty: those that are usual for the command
  std::string with = {};       // the arguments with the option, where it does not stand behind the others
};

struct Command {
  std::string name;
  std::string usual;  // the arguments that options without a trial of their own stand behind
  std::map<std::string, Trial> trials;
  std::set<std::string> of_time_only = {};
  // What it takes more than 2000 rows to see (short_rows_test.cpp), and what depends on the machine
  // (process_tree_test.cpp, sessions/misfortune.sh).
  std::set<std::string> elsewhere = {};
};

const std::vector<Command>& commands() {
  const std::string hunt = "naive --cases 2 --seed 5 --attempts 0 --witnesses w",
                    wrong = "faulty --cases 2 --seed 5 --attempts 0 --witnesses w";
  const std::string audited = "opensubdiv-far fan:5 --depth 1 --level quick";
  static const std::string sleeps = "--program 'sleep 5' --cases 1 --jobs 1 --attempts 0 --witnesses w";
  static const std::vector<Command> list{
      {"check", "cube.obj", {{"--scheme", {"", "loop"}}, {"--triangulate", {"", "fan"}}}},
      {"generate",
       "bumpy:20 -o a.ply",
       {{"--output", {"bumpy:20", "", "bumpy:20 -o b.obj"}},
        {"--seed", {"", "7"}},
        {"--scheme", {"quad-cube -o a.ply", "loop"}},
        {"--triangulate", {"quad-cube -o a.ply", "fan"}},
        {"--list", {"", ""}}}},
      {"tessellate",
       "bumpy:20 --depth 1 -o a.obj",
       {{"--scheme", {"", "catmull-clark"}},
        {"--triangulate", {"quad-cube --depth 1 -o a.obj", "fan"}},
        {"--output", {"bumpy:20", "", "bumpy:20 -o a.glb"}},
        {"--depth", {"bumpy:20 -o a.obj", "1"}},
        {"--strategy", {"bumpy:20 -o a.obj", "random"}},
        {"--engine", {"bumpy:20 -o a.obj", "sliding-window"}},
        {"--gpu", {"bumpy:20 -o a.obj", ""}},
        {"--camera", {"bumpy:20 --strategy combined -o a.obj", "9,0,0"}},
        {"--pixels", {"bumpy:20 --strategy combined -o a.obj", "9"}},
        {"--angle", {"bumpy:20 --strategy curvature -o a.obj", "90"}},
        {"--viewport", {"bumpy:20 --strategy project-sphere -o a.obj", "99x99"}},
        {"--fov", {"bumpy:20 --strategy project-sphere -o a.obj", "170"}},
        {"--max-depth", {"bumpy:20 --strategy curvature --angle 1 -o a.obj", "1"}},
        {"--cull", {"bumpy:20 --strategy uniform -o a.obj", ""}},
        {"--centre", {"bumpy:20 --strategy random -o a.obj", "flat"}},
        {"--repair", {"bumpy:20 --strategy random -o a.obj", "stitch"}},
        {"--seed", {"bumpy:20 --strategy random -o a.obj", "2"}},
        {"--colour", {"bumpy:20 -o a.ply", "depth"}},
        {"--threads", {"bumpy:20 -o a.obj", "1"}}},
       {"--threads"}},
      {"eval",
       "bumpy:20 0 1/4 1/4",
       {{"--points", {"bumpy:20 0 1/4 1/4", "", "bumpy:20 --points points.csv"}},
        {"--certified", {"bumpy:20 --points points.csv", ""}},
        {"--derivatives", {"bumpy:20 --points points.csv", "1"}},
        {"--scheme", {"", "catmull-clark"}},
        {"--triangulate", {"quad-cube 0 1/4 1/4", "fan"}},
        {"--digits", {"", "30"}},
        {"--precision", {"bumpy:20 0 1/4 1/4 --digits 20", "float"}},
        {"--weights", {"", "warren"}},
        {"--channel", {"uv-cube 0 1/4 1/4", "uv"}},
        {"--channel-rule", {"uv-cube 0 1/4 1/4 --channel uv", "all"}},
        {"--subject", {"", "naive"}},
        {"--depth", {"bumpy:20 0 1/4 1/4 --subject cgal", "2"}},
        {"--depths", {"bumpy:20 0 1/4 1/4 --subject cgal", "random:1"}}}},
      {"repair",
       "soup.obj -o a.obj",
       {{"--output", {"soup.obj", "", "soup.obj -o a.obj"}},
        {"--weld", {"", ""}},
        {"--scheme", {"cube.obj -o a.obj", "loop"}},
        {"--triangulate", {"cube.obj -o a.obj", "fan"}}}},
      {"hunt",
       hunt,
       {{"--cases", {hunt, "", "naive --cases 3 --seed 5 --attempts 0 --witnesses w"}},
        {"--time", {hunt, "", "naive --time 1s --seed 5 --attempts 0 --witnesses w"}},
        {"--seed",
         {wrong + " --json r.json", "",
          "faulty --cases 2 --seed 6 --attempts 0 --witnesses w --json r.json"}},
        {"--scheme", {"", "catmull-clark"}},
        {"--shard", {hunt + " --json r.json", "1/2"}},
        {"--option", {"", "weights=warren"}},
        {"--vary", {"row-stream --cases 2 --seed 5 --witnesses w --json r.json", "target"}},
        {"--witnesses",
         {"faulty --cases 1 --seed 5 --attempts 9 --witnesses w", "",
          "faulty --cases 1 --seed 5 --attempts 9 --witnesses other"}},
        {"--attempts",
         {wrong + " --json r.json", "",
          "faulty --cases 2 --seed 5 --attempts 50 --witnesses w --json r.json"}},
        {"--json", {"", "r.json"}},
        {"--junit", {"", "r.xml"}},
        {"--baseline", {wrong, "known.json"}},
        {"--resume", {hunt + " --json torn.json", ""}},
        {"--program",
         {"--cases 1 --witnesses w", "", "--cases 1 --witnesses w --attempts 0 --program false"}},
        {"--timeout", {sleeps + " --timeout 0.3", "", sleeps + " --timeout 0.6"}},
        {"--memory",
         {"--program 'python3 eats.py' --cases 1 --jobs 1 --attempts 0 --witnesses w --timeout 2", "60"}},
        {"--witness-folder", {"--program 'bash crash.sh' --cases 1 --attempts 0 --witnesses w", "elsewhere"}},
        {"--jobs", {hunt + " --jobs 1", "", hunt + " --jobs 2"}},
        {"--in-process", {"", ""}}},
       {"--jobs", "--in-process"},
       {"--containment"}},
      {"merge",
       "one.json two.json -o whole.json",
       {{"--output", {"one.json two.json", "", "one.json two.json -o whole.json"}},
        {"--verify", {"one.json two.json", "", "--verify one.json"}},
        {"--require", {"", "normals,creases"}},
        {"--require-coverage", {"", ""}},
        {"--color", {"", "always"}},
        {"--junit", {"", "r.xml"}},
        {"--sarif", {"", "r.sarif"}},
        {"--markdown", {"", "r.md"}},
        {"--waivers", {"", "waivers.json"}},
        {"--baseline", {"", "before.json"}},
        {"--save-baseline", {"", "known.txt"}}},
       {},
       {"--all-rows"}},
      {"audit",
       audited,
       {{"--scheme", {"", "catmull-clark"}},
        {"--triangulate", {"naive cube.obj --depth 1 --level quick", "fan"}},
        {"--depth", {"opensubdiv-far fan:5 --level quick", "", audited}},
        {"--depths", {"", "random:1"}},
        {"--sample", {"naive bumpy:60 --depth 1 --level quick", "9"}},
        {"--exhaustive",
         {"naive --depth 1 --level quick fan:5", "", "naive --depth 1 --level quick --exhaustive 3"}},
        {"--checks", {"", "positions"}},
        {"--rerun", {audited, "", "opensubdiv-far --rerun before.json"}},
        {"--must-refuse", {"", ""}},
        {"--level",
         {"naive tetrahedron --depth 1 --level quick", "", "naive tetrahedron --depth 1 --level thorough"}},
        {"--option", {"", "precision=double"}},
        {"--report", {"", "out"}},
        {"--junit", {"", "r.xml"}},
        {"--sarif", {"", "r.sarif"}},
        {"--markdown", {"", "r.md"}},
        {"--html", {"", "r.html"}},
        {"--witnesses", {"", "w"}},
        {"--shrink", {audited + " --witnesses w", "1"}},
        {"--shard", {audited + " fan:4 --json r.json", "1/2"}},
        {"--resume", {audited + " --json torn.json", ""}},
        {"--color", {"", "always"}},
        {"--explain", {audited, "", "--explain positions"}},
        {"--require", {"", "file-normals"}},
        {"--require-coverage", {"naive tetrahedron --depth 1 --level quick", ""}},
        {"--waivers", {"", "waivers.json"}},
        {"--baseline", {"", "before.json"}},
        {"--save-baseline", {"", "known.txt"}},
        {"--program", {"fan:5 --program false", "", "fan:5 --program true"}},
        {"--timeout",
         {"tetrahedron --program 'sleep 2' --timeout 1", "", "tetrahedron --program 'sleep 2' --timeout 9"}},
        {"--memory", {"tetrahedron --program 'python3 eats.py' --timeout 2", "60"}},
        {"--witness-folder", {"tetrahedron --program 'bash crash.sh'", "elsewhere"}},
        {"--provenance", {"", "points.csv"}},
        {"--control", {"", "cube.obj"}},
        {"--tessellation", {"", "cube.obj"}},
        {"--channel-rule", {"--control uv-torus --tessellation atlas.obj", "all"}},
        {"--fit", {"", "scale"}},
        {"--tolerance", {"", "1"}},
        {"--max-deviation", {"", "1"}},
        {"--per-vertex", {"", "each.csv"}},
        {"--threads", {"", "1"}},
        {"--isolate", {"", ""}}},
       {"--threads"},
       {"--all-rows", "--containment"}},
      {"prove",
       "--valences 6 --depth 0 --set sample",
       {{"--scheme", {"--valences 4 --depth 0 --set sample", "catmull-clark"}},
        {"--valences", {"--depth 0 --set sample", "", "--valences 4,5 --depth 0 --set sample"}},
        {"--depth", {"--valences 6 --depth 0 --set sample", "", "--valences 6 --depth 1 --set sample"}},
        {"--kernel", {"", "row-stream"}},
        {"--set",
         {"--valences 6 --depth 0 --kernel row-stream", "",
          "--valences 6 --depth 0 --set sample --kernel row-stream"}},
        {"--shard", {"--valences 4,5 --depth 0 --set sample --json r.json", "1/2"}},
        {"--resume", {"--valences 6 --depth 0 --set sample --json torn.json", ""}}}},
      {"mutants",
       "",
       {{"--json", {"--shard 1/400", "", "--json r.json --shard 1/400"}},
        {"--shard", {"--json r.json --shard 1/400", "", "--json r.json --shard 2/400"}},
        {"--resume", {"--json torn.json --shard 1/400", ""}},
        {"--without-provenance", {"--json r.json --shard 9/400", ""}}}},
      {"claims", "C01", {{"--programs", {"C01 --programs .", "", "C01 --programs absent"}}}}};
  return list;
}

/// The command without the option, and with it.
std::pair<std::string, std::string> commands_of(const Command& c, const std::string& option) {
  const auto own = c.trials.find(option);
  const Trial trial = own != c.trials.end() ? own->second : Trial{};
  const std::string without = c.name + " " + (trial.without.empty() ? c.usual : trial.without);
  return {without,
          trial.with.empty() ? without + " " + option + " " + trial.value : c.name + " " + trial.with};
}

class OptionWalk : public CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(run("generate quad-cube -o cube.obj").code, 0);
    ASSERT_EQ(run("generate uv-torus -o atlas.obj").code, 0);
    write("soup.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n");
    write("points.csv", "0,1/4,1/4\n3,0.5,0.25\n");
    for (const char* journal : {"torn.jsonl", "torn.json.part1"}) write(journal, "{\"half\": ");
    write("crash.sh", kTellsWhatItCan + "kill -SEGV $$\n");
    write("eats.py", "import time\nx = bytearray(200 << 20)\ntime.sleep(9)\n");
    write("waivers.json",
          R"({"waivers": [{"subject": "*", "check": "*", "reason": "known", "expires": "2999-01-01"}]})");
    const std::string audit = "audit opensubdiv-far fan:4 fan:5 --depth 1 --level quick ";
    (void)run(audit + "--json before.json", 1);
    for (const char* part : {"1/2 --json one.json", "2/2 --json two.json"})
      (void)run(audit + "--shard " + part);
    (void)run("hunt faulty --cases 2 --seed 5 --attempts 0 --witnesses w --json known.json");
    inputs_ = names();
  }

  std::set<std::string> names() const {
    std::set<std::string> list;
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      if (const std::string name = fs::relative(entry.path(), folder_).string(); !name.starts_with(".std"))
        list.insert(name);
    return list;
  }

  /// Exit code, output and files of a command, without times and digests; afterwards the folder is as it was.
  std::string seen(const std::string& command) const {
    static const std::regex varies(
        "milliseconds:[^\n]*|[0-9.e+-]+ (m?s|seconds?|cases per "
        "second)\\b|\"(seconds|milliseconds|digest|peak)[^,}]*|"
        "[0-9a-f]{64}|/tmp/[^ \"]*|limitcheck: [0-9]+/[0-9]+,[^\n]*| +[0-9.]+(?=\n)");
    const Outcome o = run(command);
    std::string all = std::to_string(o.code) + "\n" + o.out + o.err;
    for (const std::string& name : names()) {
      if (inputs_.contains(name)) continue;
      all += "\n== " + name;
      if (fs::is_regular_file(folder_ / name)) all += "\n" + read(name);
    }
    for (const std::string& name : names())
      if (!inputs_.contains(name)) fs::remove_all(folder_ / name);
    return std::regex_replace(all, varies, "#");
  }

  std::set<std::string> inputs_;
};

TEST_F(OptionWalk, EachChangesSomethingAndThoseOfTimeNothing) {
  const std::regex option("(^|\n) +(?:-[a-z],)?(--[a-z-]+)");
  for (const Command& c : commands()) {
    const std::string help = run(c.name + " --help", 0).out;
    std::set<std::string> there;
    for (std::sregex_iterator m(help.begin(), help.end(), option), end; m != end; ++m) {
      const std::string name = (*m)[2];
      if (name == "--help" || c.elsewhere.contains(name)) continue;
      there.insert(name);
      const auto [without, with] = commands_of(c, name);
      const std::string said = seen(with);
      EXPECT_EQ(seen(without) == said, c.of_time_only.contains(name)) << with << "\n" << said.substr(0, 500);
    }
    for (const auto& [name, trial] : c.trials)
      EXPECT_TRUE(there.contains(name)) << c.name << " has no option " << name;
    // What differs without a reason would be taken for an effect.
    const std::string any = commands_of(c, c.trials.begin()->first).second;
    EXPECT_EQ(seen(any), seen(any));
  }
}

}  // namespace
}  // namespace limitcheck::cli
