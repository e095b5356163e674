// SPDX-License-Identifier: MIT
// Every option of every command does something: what the command says, its exit code or the files that it leaves are
// others with it than without it; or it is said here to change nothing but the time, and changes nothing. (The options of
// an audit of finished files: audit_files_test.cpp.)
#include <map>
#include <regex>
#include <set>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

/// The arguments without an option and with it; `with` empty: the option itself behind `without`.
struct Trial {
  std::string without, with;
};

struct Command {
  std::string name;
  std::string usual;  // the arguments that options without a trial of their own stand behind
  std::map<std::string, Trial> trials;
  std::set<std::string> of_time_only = {};
  // What it takes more than 2000 rows to see (short_rows_test.cpp), and what depends on the machine
  // (process_tree_test.cpp).
  std::set<std::string> elsewhere = {};
};

const std::vector<Command>& commands() {
  const std::string hunt = "naive --cases 2 --seed 5 --attempts 0 --witnesses w",
                    wrong = "faulty --cases 2 --seed 5 --attempts 0 --witnesses w";
  const std::string audited = "opensubdiv-far fan:5 --depth 1 --level quick";
  static const std::string sleeps = "--program 'sleep 5' --cases 1 --jobs 1 --attempts 0 --witnesses w";
  static const std::vector<Command> list{
      {"check",
       "cube.obj",
       {{"--scheme", {"cube.obj", "cube.obj --scheme loop"}},
        {"--triangulate", {"cube.obj", "cube.obj --triangulate fan"}}}},
      {"generate",
       "bumpy:20 -o a.ply",
       {{"--output", {"bumpy:20", "bumpy:20 -o b.obj"}},
        {"--seed", {"bumpy:20 -o a.ply", "bumpy:20 -o a.ply --seed 7"}},
        {"--scheme", {"quad-cube -o a.ply", "quad-cube -o a.ply --scheme loop"}},
        {"--triangulate", {"quad-cube -o a.ply", "quad-cube -o a.ply --triangulate fan"}},
        {"--list", {"", "--list"}},
        {"--stock", {"", "--stock"}}}},
      {"tessellate",
       "bumpy:20 --depth 1 -o a.obj",
       {{"--scheme", {"bumpy:20 --depth 1 -o a.obj", "bumpy:20 --depth 1 -o a.obj --scheme catmull-clark"}},
        {"--triangulate", {"quad-cube --depth 1 -o a.obj", "quad-cube --depth 1 -o a.obj --triangulate fan"}},
        {"--output", {"bumpy:20", "bumpy:20 -o a.glb"}},
        {"--depth", {"bumpy:20 -o a.obj", "bumpy:20 -o a.obj --depth 1"}},
        {"--strategy", {"bumpy:20 -o a.obj", "bumpy:20 -o a.obj --strategy random"}},
        {"--engine", {"bumpy:20 -o a.obj", "bumpy:20 -o a.obj --engine sliding-window"}},
        {"--camera",
         {"bumpy:20 --strategy combined -o a.obj", "bumpy:20 --strategy combined -o a.obj --camera 9,0,0"}},
        {"--pixels",
         {"bumpy:20 --strategy combined -o a.obj", "bumpy:20 --strategy combined -o a.obj --pixels 9"}},
        {"--angle",
         {"bumpy:20 --strategy curvature -o a.obj", "bumpy:20 --strategy curvature -o a.obj --angle 90"}},
        {"--viewport",
         {"bumpy:20 --strategy project-sphere -o a.obj",
          "bumpy:20 --strategy project-sphere -o a.obj --viewport 99x99"}},
        {"--fov",
         {"bumpy:20 --strategy project-sphere -o a.obj",
          "bumpy:20 --strategy project-sphere -o a.obj --fov 170"}},
        {"--max-depth",
         {"bumpy:20 --strategy curvature --angle 1 -o a.obj",
          "bumpy:20 --strategy curvature --angle 1 -o a.obj --max-depth 1"}},
        {"--cull", {"bumpy:20 --strategy uniform -o a.obj", "bumpy:20 --strategy uniform -o a.obj --cull"}},
        {"--centre",
         {"bumpy:20 --strategy random -o a.obj", "bumpy:20 --strategy random -o a.obj --centre flat"}},
        {"--repair",
         {"bumpy:20 --strategy random -o a.obj", "bumpy:20 --strategy random -o a.obj --repair stitch"}},
        {"--seed", {"bumpy:20 --strategy random -o a.obj", "bumpy:20 --strategy random -o a.obj --seed 2"}},
        {"--colour", {"bumpy:20 -o a.ply", "bumpy:20 -o a.ply --colour depth"}},
        {"--threads", {"bumpy:20 -o a.obj", "bumpy:20 -o a.obj --threads 1"}}},
       {"--threads"}},
      {"eval",
       "bumpy:20 0 1/4 1/4",
       {{"--points", {"bumpy:20 0 1/4 1/4", "bumpy:20 --points points.csv"}},
        {"--certified", {"bumpy:20 --points points.csv", "bumpy:20 --points points.csv --certified"}},
        {"--derivatives", {"bumpy:20 --points points.csv", "bumpy:20 --points points.csv --derivatives 1"}},
        {"--scheme", {"bumpy:20 0 1/4 1/4", "bumpy:20 0 1/4 1/4 --scheme catmull-clark"}},
        {"--triangulate", {"quad-cube 0 1/4 1/4", "quad-cube 0 1/4 1/4 --triangulate fan"}},
        {"--digits", {"bumpy:20 0 1/4 1/4", "bumpy:20 0 1/4 1/4 --digits 30"}},
        {"--precision",
         {"bumpy:20 0 1/4 1/4 --digits 20", "bumpy:20 0 1/4 1/4 --digits 20 --precision float"}},
        {"--weights", {"bumpy:20 0 1/4 1/4", "bumpy:20 0 1/4 1/4 --weights warren"}},
        {"--channel", {"uv-cube 0 1/4 1/4", "uv-cube 0 1/4 1/4 --channel uv"}},
        {"--channel-rule",
         {"uv-cube 0 1/4 1/4 --channel uv", "uv-cube 0 1/4 1/4 --channel uv --channel-rule all"}},
        {"--subject", {"bumpy:20 0 1/4 1/4", "bumpy:20 0 1/4 1/4 --subject naive"}},
        {"--depth", {"bumpy:20 0 1/4 1/4 --subject cgal", "bumpy:20 0 1/4 1/4 --subject cgal --depth 2"}},
        {"--depths",
         {"bumpy:20 0 1/4 1/4 --subject cgal", "bumpy:20 0 1/4 1/4 --subject cgal --depths random:1"}}}},
      {"repair",
       "soup.obj -o a.obj",
       {{"--output", {"soup.obj", "soup.obj -o a.obj"}},
        {"--weld", {"soup.obj -o a.obj", "soup.obj -o a.obj --weld"}},
        {"--scheme", {"cube.obj -o a.obj", "cube.obj -o a.obj --scheme loop"}},
        {"--triangulate", {"cube.obj -o a.obj", "cube.obj -o a.obj --triangulate fan"}}}},
      {"hunt",
       hunt,
       {{"--cases", {hunt, "naive --cases 3 --seed 5 --attempts 0 --witnesses w"}},
        {"--time", {hunt, "naive --time 1s --seed 5 --attempts 0 --witnesses w"}},
        {"--seed",
         {wrong + " --json r.json", "faulty --cases 2 --seed 6 --attempts 0 --witnesses w --json r.json"}},
        {"--scheme", {hunt, hunt + " --scheme catmull-clark"}},
        {"--shard", {hunt + " --json r.json", hunt + " --json r.json --shard 1/2"}},
        {"--option", {hunt, hunt + " --option weights=warren"}},
        {"--vary",
         {"row-stream --cases 2 --seed 5 --witnesses w --json r.json",
          "row-stream --cases 2 --seed 5 --witnesses w --json r.json --vary target"}},
        {"--witnesses",
         {"faulty --cases 1 --seed 5 --attempts 9 --witnesses w",
          "faulty --cases 1 --seed 5 --attempts 9 --witnesses other"}},
        {"--attempts",
         {wrong + " --json r.json", "faulty --cases 2 --seed 5 --attempts 50 --witnesses w --json r.json"}},
        {"--json", {hunt, hunt + " --json r.json"}},
        {"--junit", {hunt, hunt + " --junit r.xml"}},
        {"--baseline", {wrong, wrong + " --baseline known.json"}},
        {"--resume", {hunt + " --json torn.json", hunt + " --json torn.json --resume"}},
        {"--program", {"--cases 1 --witnesses w", "--cases 1 --witnesses w --attempts 0 --program false"}},
        {"--timeout", {sleeps + " --timeout 0.3", sleeps + " --timeout 0.6"}},
        {"--memory",
         {"--program 'python3 eats.py' --cases 1 --jobs 1 --attempts 0 --witnesses w --timeout 2",
          "--program 'python3 eats.py' --cases 1 --jobs 1 --attempts 0 --witnesses w --timeout 2 --memory "
          "60"}},
        {"--witness-folder",
         {"--program 'bash crash.sh' --cases 1 --attempts 0 --witnesses w",
          "--program 'bash crash.sh' --cases 1 --attempts 0 --witnesses w --witness-folder elsewhere"}},
        {"--jobs", {hunt + " --jobs 1", hunt + " --jobs 2"}},
        {"--in-process", {hunt, hunt + " --in-process"}}},
       {"--jobs", "--in-process"},
       {"--containment"}},
      {"merge",
       "one.json two.json -o whole.json",
       {{"--output", {"one.json two.json", "one.json two.json -o whole.json"}},
        {"--verify", {"one.json two.json", "--verify one.json"}},
        {"--require",
         {"one.json two.json -o whole.json", "one.json two.json -o whole.json --require normals,creases"}},
        {"--require-coverage",
         {"one.json two.json -o whole.json", "one.json two.json -o whole.json --require-coverage"}},
        {"--color", {"one.json two.json -o whole.json", "one.json two.json -o whole.json --color always"}},
        {"--junit", {"one.json two.json -o whole.json", "one.json two.json -o whole.json --junit r.xml"}},
        {"--sarif", {"one.json two.json -o whole.json", "one.json two.json -o whole.json --sarif r.sarif"}},
        {"--markdown",
         {"one.json two.json -o whole.json", "one.json two.json -o whole.json --markdown r.md"}},
        {"--waivers",
         {"one.json two.json -o whole.json", "one.json two.json -o whole.json --waivers waivers.json"}},
        {"--baseline",
         {"one.json two.json -o whole.json", "one.json two.json -o whole.json --baseline before.json"}},
        {"--save-baseline",
         {"one.json two.json -o whole.json", "one.json two.json -o whole.json --save-baseline known.txt"}}},
       {},
       {"--all-rows"}},
      {"audit",
       audited,
       {{"--scheme", {audited, audited + " --scheme catmull-clark"}},
        {"--triangulate",
         {"naive cube.obj --depth 1 --level quick",
          "naive cube.obj --depth 1 --level quick --triangulate fan"}},
        {"--depth", {"opensubdiv-far fan:5 --level quick", audited}},
        {"--depths", {audited, audited + " --depths random:1"}},
        {"--sample",
         {"naive bumpy:60 --depth 1 --level quick", "naive bumpy:60 --depth 1 --level quick --sample 9"}},
        {"--exhaustive",
         {"naive --depth 1 --level quick fan:5", "naive --depth 1 --level quick --exhaustive 3"}},
        {"--checks", {audited, audited + " --checks positions"}},
        {"--rerun", {audited, "opensubdiv-far --rerun before.json"}},
        {"--must-refuse", {audited, audited + " --must-refuse"}},
        {"--level",
         {"naive tetrahedron --depth 1 --level quick", "naive tetrahedron --depth 1 --level thorough"}},
        {"--option", {audited, audited + " --option precision=double"}},
        {"--report", {audited, audited + " --report out"}},
        {"--junit", {audited, audited + " --junit r.xml"}},
        {"--sarif", {audited, audited + " --sarif r.sarif"}},
        {"--markdown", {audited, audited + " --markdown r.md"}},
        {"--html", {audited, audited + " --html r.html"}},
        {"--witnesses", {audited, audited + " --witnesses w"}},
        {"--shrink", {audited + " --witnesses w", audited + " --witnesses w --shrink 1"}},
        {"--shard", {audited + " fan:4 --json r.json", audited + " fan:4 --json r.json --shard 1/2"}},
        {"--resume", {audited + " --json torn.json", audited + " --json torn.json --resume"}},
        {"--color", {audited, audited + " --color always"}},
        {"--explain", {audited, "--explain positions"}},
        {"--require", {audited, audited + " --require file-normals"}},
        {"--require-coverage",
         {"naive tetrahedron --depth 1 --level quick",
          "naive tetrahedron --depth 1 --level quick --require-coverage"}},
        {"--waivers", {audited, audited + " --waivers waivers.json"}},
        {"--baseline", {audited, audited + " --baseline before.json"}},
        {"--save-baseline", {audited, audited + " --save-baseline known.txt"}},
        {"--program", {"fan:5 --program false", "fan:5 --program true"}},
        {"--timeout",
         {"tetrahedron --program 'sleep 2' --timeout 1", "tetrahedron --program 'sleep 2' --timeout 9"}},
        {"--memory",
         {"tetrahedron --program 'python3 eats.py' --timeout 2",
          "tetrahedron --program 'python3 eats.py' --timeout 2 --memory 60"}},
        {"--witness-folder",
         {"tetrahedron --program 'bash crash.sh'",
          "tetrahedron --program 'bash crash.sh' --witness-folder elsewhere"}},
        {"--provenance", {audited, audited + " --provenance points.csv"}},
        {"--control", {audited, audited + " --control cube.obj"}},
        {"--tessellation", {audited, audited + " --tessellation cube.obj"}},
        {"--fit", {audited, audited + " --fit scale"}},
        {"--tolerance", {audited, audited + " --tolerance 1"}},
        {"--max-deviation", {audited, audited + " --max-deviation 1"}},
        {"--per-vertex", {audited, audited + " --per-vertex each.csv"}},
        {"--threads", {audited, audited + " --threads 1"}},
        {"--isolate", {audited, audited + " --isolate"}}},
       {"--threads"},
       {"--all-rows", "--containment"}},
      {"prove",
       "--valences 6 --depth 0 --set sample",
       {{"--scheme",
         {"--valences 4 --depth 0 --set sample",
          "--valences 4 --depth 0 --set sample --scheme catmull-clark"}},
        {"--valences", {"--depth 0 --set sample", "--valences 4,5 --depth 0 --set sample"}},
        {"--depth", {"--valences 6 --depth 0 --set sample", "--valences 6 --depth 1 --set sample"}},
        {"--kernel",
         {"--valences 6 --depth 0 --set sample", "--valences 6 --depth 0 --set sample --kernel row-stream"}},
        {"--set",
         {"--valences 6 --depth 0 --kernel row-stream",
          "--valences 6 --depth 0 --set sample --kernel row-stream"}},
        {"--shard",
         {"--valences 4,5 --depth 0 --set sample --json r.json",
          "--valences 4,5 --depth 0 --set sample --json r.json --shard 1/2"}},
        {"--resume",
         {"--valences 6 --depth 0 --set sample --json torn.json",
          "--valences 6 --depth 0 --set sample --json torn.json --resume"}}}},
      {"mutants",
       "",
       {{"--json", {"--shard 1/400", "--json r.json --shard 1/400"}},
        {"--shard", {"--json r.json --shard 1/400", "--json r.json --shard 2/400"}},
        {"--resume", {"--json torn.json --shard 1/400", "--json torn.json --shard 1/400 --resume"}},
        {"--without-provenance",
         {"--json r.json --shard 9/400", "--json r.json --shard 9/400 --without-provenance"}}}},
      {"claims", "C01", {{"--programs", {"C01 --programs .", "C01 --programs absent"}}}}};
  return list;
}

class OptionWalk : public CommandTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(run("generate quad-cube -o cube.obj").code, 0);
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
      const auto own = c.trials.find(name);
      const Trial trial = own != c.trials.end() ? own->second : Trial{c.usual, c.usual + " " + name};
      const std::string without = seen(c.name + " " + trial.without), with = seen(c.name + " " + trial.with);
      EXPECT_EQ(without == with, c.of_time_only.contains(name)) << c.name << " " << trial.with << "\n"
                                                                << with.substr(0, 500);
    }
    for (const auto& [name, trial] : c.trials)
      EXPECT_TRUE(there.contains(name)) << c.name << " has no option " << name;
    // What differs without a reason would be taken for an effect.
    EXPECT_EQ(seen(c.name + " " + c.trials.begin()->second.with),
              seen(c.name + " " + c.trials.begin()->second.with));
  }
}

}  // namespace
}  // namespace limitcheck::cli
