// SPDX-License-Identifier: MIT
// `limitcheck audit --control --tessellation` as a user meets it.
// `limitcheck audit --control --tessellation` on files as other programs write them, and with one fault each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

class AuditFilesCommand : public CommandTest {};

TEST_F(AuditFilesCommand, HoldsTheEnginesOwnFilesWithinTheRoundingOfFloat) {
  for (const std::string file : {"out.ply", "out.obj"}) {
    ASSERT_EQ(run("generate bumpy:200 -o cage.obj").code, 0);
    ASSERT_EQ(run("tessellate cage.obj --depth 2 -o " + file).code, 0);
    const auto report = json_of("audit --control cage.obj --tessellation " + file +
                                    " --normals --tolerance 1e-7 --per-vertex each.csv --json",
                                0);
    for (const auto& row : report["results"]) EXPECT_EQ(row["status"], "held") << row;
    const std::string each = read("each.csv");
    EXPECT_TRUE(each.starts_with("vertex,distance,normal_angle,face,l1,l2\n"));
    EXPECT_EQ(std::count(each.begin(), each.end(), '\n'), 1 + 1602);  // 2 + 8 * 200 vertices
  }
}

TEST_F(AuditFilesCommand, LeavesTheHausdorffDistanceOutIfAsked) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  ASSERT_EQ(run("tessellate cage.obj --depth 1 -o out.ply").code, 0);
  const auto rows =
      json_of("audit --control cage.obj --tessellation out.ply --no-hausdorff --json", 0)["results"];
  EXPECT_EQ(rows.size(), 10U);
  for (const auto& row : rows)
    EXPECT_EQ(row["status"], row["check"] == "file-hausdorff" ? "not-run" : "held") << row;
  EXPECT_EQ(run("audit --control cage.obj --tessellation out.ply --no-hausdorff --max-deviation 1").code, 2);
}

TEST_F(AuditFilesCommand, TellsTheControlMeshItselfFromATessellation) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  const Outcome o = run("audit --control cage.obj --tessellation cage.obj", 1);
  EXPECT_TRUE(says(o.out, "file-distance             FINDING"));
}

// The limit points of the cube -1 .. 1 are its corners halved: 3/8 + 1/6 - 1/24 of 1 (three neighbours, three
// opposite corners of faces). Cut into triangles it has another surface.
TEST_F(AuditFilesCommand, JudgesFilesOfQuadsByCatmullClarksScheme) {
  ASSERT_EQ(run("generate quad-cube -o cage.obj").code, 0);
  std::istringstream lines(read("cage.obj"));
  std::string limit;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (words >> word; word != "v") {
      limit += line + "\n";
      continue;
    }
    double x = 0, y = 0, z = 0;
    words >> x >> y >> z;
    std::ostringstream half;
    half << "v " << x / 2 << ' ' << y / 2 << ' ' << z / 2 << '\n';
    limit += half.str();
  }
  write("limit.obj", limit);
  const Outcome held = run("audit --control cage.obj --tessellation limit.obj --per-vertex each.csv", 0);
  EXPECT_TRUE(says(held.out, "scheme: catmull-clark"));
  EXPECT_TRUE(read("each.csv").starts_with("vertex,distance,normal_angle,face,corner,u,v\n"));
  EXPECT_EQ(run("audit --control cage.obj --tessellation limit.obj --provenance each.csv").code, 0);
  const Outcome refined = run("audit --control cage.obj --tessellation cage.obj", 1);
  const Outcome loop = run("audit --control cage.obj --tessellation limit.obj --triangulate fan", 1);
}

TEST_F(AuditFilesCommand, ExitsWithTwoOnBadUsageAndBadInput) {
  ASSERT_EQ(run("generate icosahedron -o cage.obj").code, 0);
  write("map.csv", "0,99,0,0\n");
  write("torn.ply", "ply\nformat ascii 1.0\n");
  expect_refused(
      "audit",
      {"--control cage.obj", "--tessellation cage.obj", "--control cage.obj --tessellation absent.ply",
       "--control absent --tessellation cage.obj", "--control cage.obj --tessellation torn.ply",
       "--control cage.obj --tessellation cage.obj --provenance map.csv",
       "--control cage.obj --tessellation cage.obj --tolerance 0",
       "--control cage.obj --tessellation cage.obj --fit shear"});
}

// Every option that --help names: with finished files it has an effect, which is shown here, or it is refused.
// The page of a file shows its triangles, red where they are off: of twenty vertices moved, and of no other.
TEST_F(AuditFilesCommand, ThePageShowsWhereTheFileIsWrong) {
  ASSERT_EQ(run("generate bumpy:20 -o cage.obj").code, 0);
  ASSERT_EQ(run("tessellate cage.obj --depth 2 -o right.obj").code, 0);
  ASSERT_EQ(shell("awk '/^v /{ if (++n > 50 && n <= 70) $2 += 0.001 } { print }' right.obj > moved.obj").code,
            0);
  ASSERT_EQ(run("audit --control cage.obj --tessellation moved.obj --html page.html").code, 1);
  EXPECT_EQ(python("import base64, json, re\n"
                   "page = open('page.html').read()\n"
                   "data = json.loads(re.search('id=\"data\">(.*?)</script>', page, re.S).group(1))\n"
                   "shape = next(c['shape'] for c in data['causes'] if c['shape'])\n"
                   "values = base64.b64decode(shape['values'])\n"
                   "red = sum(v > 0 for v in values)\n"
                   "assert len(values) == 162 and red == 20, (len(values), red)\n"
                   "assert len(base64.b64decode(shape['control'])) == 30 * 2 * 3 * 4\n"
                   "assert 'the file has nothing of the kind' in data['legend']\n"),
            0)
      << read(".stderr");
}

TEST_F(AuditFilesCommand, EveryOptionHasAnEffectOnFilesOrIsRefused) {
  ASSERT_EQ(run("generate bumpy:20 -o cage.obj").code, 0);
  ASSERT_EQ(run("tessellate cage.obj --depth 1 -o out.obj").code, 0);
  ASSERT_EQ(run("generate quad-cube -o quads.obj").code, 0);
  const std::string files = "audit --control cage.obj --tessellation ", wrong = files + "cage.obj ";
  ASSERT_EQ(run(wrong + "--json old.json").code, 1);
  write("waivers.json", R"({"waivers": [{"subject": "cage.obj", "check": "*", "reason": "known",
        "expires": "2999-01-01"}]})");
  write("map.csv", "0,0,0,0\n");
  // The values of options that have one; what is said of a file that has findings, with such an option: the exit
  // code, and what is then there.
  struct Effect {
    std::string value;
    int code;
    std::string file;
  };
  const std::map<std::string, Effect> effects{
      {"--control", {"cage.obj", 1, ""}},
      {"--tessellation", {"out.obj", 1, ""}},
      {"--normals", {"", 1, ""}},
      {"--provenance", {"map.csv", 1, ""}},
      {"--fit", {"", 1, ""}},
      {"--tolerance", {"9", 0, ""}},
      {"--channel-rule", {"all", 1, ""}},
      {"--max-deviation", {"9", 1, ""}},
      {"--no-hausdorff", {"", 1, ""}},
      {"--per-vertex", {"each.csv", 1, "each.csv"}},
      {"--scheme", {"catmull-clark", 1, ""}},
      {"--triangulate", {"fan", 1, ""}},
      {"--threads", {"1", 1, ""}},
      {"--json", {"new.json", 1, "new.json"}},
      {"--details", {"", 1, ""}},
      {"--all-rows", {"--json all.json", 1, "all.json"}},
      {"--color", {"always", 1, ""}},
      {"--sarif", {"log.sarif", 1, "log.sarif"}},
      {"--markdown", {"page.md", 1, "page.md"}},
      {"--require", {"file-normals", 1, ""}},
      {"--junit", {"junit.xml", 1, "junit.xml"}},
      {"--html", {"page.html", 1, "page.html"}},
      {"--witnesses", {"found", 1, "found"}},
      {"--waivers", {"waivers.json", 0, ""}},
      {"--baseline", {"old.json", 0, ""}},
      {"--save-baseline", {"known.txt", 1, "known.txt"}},
      {"--explain", {"normals", 0, ""}},
      {"--help", {"", 0, ""}},
  };
  const std::map<std::string, std::string> values{
      {"--depth", "2"},          {"--depths", "uniform"},   {"--sample", "9"},       {"--exhaustive", "3"},
      {"--option", "a=b"},       {"--shard", "1/2"},        {"--level", "quick"},    {"--shrink", "1"},
      {"--report", "all"},       {"--program", "true"},     {"--timeout", "1"},      {"--memory", "9"},
      {"--containment", "auto"}, {"--witness-folder", "x"}, {"--checks", "normals"}, {"--rerun", "old.json"},
      {"--shader", "x.glsl"}};
  const std::string help = run("audit --help", 0).out;
  const std::regex name("(^|\n) +(?:-[a-z],)?(--[a-z-]+)");
  std::size_t seen = 0;
  for (std::sregex_iterator m(help.begin(), help.end(), name), end; m != end; ++m, ++seen) {
    const std::string option = (*m)[2];
    const auto effect = effects.find(option);
    if (effect == effects.end()) {
      const auto value = values.find(option);
      const Outcome o = run(wrong + option + " " + (value == values.end() ? "" : value->second), 2);
      EXPECT_TRUE(says(o.err, option + " has no effect on finished tessellations")) << option << o.err;
      continue;
    }
    const auto& [value, code, file] = effect->second;
    if (option != "--control" && option != "--tessellation") (void)run(wrong + option + " " + value, code);
    EXPECT_TRUE(file.empty() || std::filesystem::exists(folder_ / file)) << option;
  }
  EXPECT_GT(seen, effects.size());
  expect_refused("audit", {"naive --control cage.obj --tessellation out.obj"});
  EXPECT_TRUE(says(run("audit naive cage.obj --all-rows", 2).err,
                   "--all-rows has no effect without --json or --report"));
  (void)run(files + "out.obj", 0);
  (void)run(files + "out.obj --require file-positions", 2);  // without a provenance there is no such row
  // Several files are subjects of one report.
  const json both = json_of(files + "out.obj --tessellation cage.obj --json", 1);
  EXPECT_EQ(both["subjects"], json({"out.obj", "cage.obj"}));
  for (const json& row : both["results"])
    EXPECT_TRUE(row["subject"] == "cage.obj" || row["status"] == "held") << row;
  ASSERT_EQ(command("mkdir all && cp out.obj cage.obj all").code, 0);
  EXPECT_EQ(json_of(files + "all --json", 1)["subjects"], json({"all/cage.obj", "all/out.obj"}));
  expect_refused("audit", {"--control cage.obj --tessellation all --per-vertex each.csv"});
}

// What an OBJ file has of positions and faces.
struct Obj {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::vector<std::size_t>> faces;  // from 0

  static Obj parse(const std::string& text) {
    Obj obj;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "v") {
        auto& p = obj.positions.emplace_back();
        words >> p[0] >> p[1] >> p[2];
      } else if (word == "f") {
        auto& f = obj.faces.emplace_back();
        while (words >> word) f.push_back(std::stoul(word) - 1);
      }
    }
    return obj;
  }
  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    for (const auto& p : positions) out << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    for (const auto& f : faces) {
      out << 'f';
      for (const std::size_t v : f) out << ' ' << v + 1;
      out << '\n';
    }
    return out.str();
  }
};

class ExportedFiles : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_EQ(run("generate bumpy:20 -o cage.obj").code, 0);
    ASSERT_EQ(run("tessellate cage.obj --depth 2 -o good.obj").code, 0);
    good_ = Obj::parse(read("good.obj"));
    ASSERT_EQ(good_.faces.size(), 20U * 16);
  }
  /// The rows of the audit by name; `code` is the exit code.
  std::map<std::string, json> audit(const std::string& file, int code, const std::string& more = "") const {
    const Outcome o =
        run("audit --control cage.obj --tessellation " + file + " --tolerance 1e-7 --json " + more);
    EXPECT_EQ(o.code, code) << file << " " << more << "\n" << o.out << o.err;
    std::map<std::string, json> rows;
    const json report = json::parse(o.out, nullptr, false);
    EXPECT_FALSE(report.is_discarded()) << o.out;
    for (const json& row : report["results"]) rows[row["check"]] = row;
    return rows;
  }
  static std::string findings(const std::map<std::string, json>& rows) {
    std::string list;
    for (const auto& [name, row] : rows)
      if (row["status"] == "finding") list += (list.empty() ? "" : " ") + name;
    return list;
  }
  std::string findings_with(const std::function<void(Obj&)>& fault) const {
    Obj bad = good_;
    fault(bad);
    write("bad.obj", bad.text());
    return findings(audit("bad.obj", 1));
  }

  Obj good_;
};

TEST_F(ExportedFiles, OurOwnGlbComesBackAsItWas) {
  ASSERT_EQ(run("tessellate cage.obj --depth 2 -o out.glb").code, 0);
  ASSERT_EQ(run("tessellate cage.obj --depth 2 -o out.ply").code, 0);
  auto ply = audit("out.ply", 0, "--normals"), glb = audit("out.glb", 0, "--normals");
  EXPECT_EQ(glb["file-distance"]["worst"], ply["file-distance"]["worst"]) << "the same floats";
  EXPECT_EQ(glb["file-normals"]["worst"], ply["file-normals"]["worst"]);
  EXPECT_EQ(glb["file-finite"]["of"], ply["file-finite"]["of"]) << "as many vertices";
  write("torn.glb", read("out.glb").substr(0, 1000));
  EXPECT_EQ(run("audit --control cage.obj --tessellation torn.glb").code, 2);
}

// Every face has vertices of its own, pairs of triangles
// are quads, there are no normals, the unit is another.
TEST_F(ExportedFiles, AGameEnginesExportHoldsOnceScaleAndOffsetAreFittedAway) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> from;  // directed edge -> face
  for (std::size_t f = 0; f < good_.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) from[{good_.faces[f][k], good_.faces[f][(k + 1) % 3]}] = f;
  std::vector<char> done(good_.faces.size(), 0);
  Obj engine;
  std::size_t quads = 0;
  for (std::size_t f = 0; f < good_.faces.size(); ++f) {
    if (std::exchange(done[f], 1) != 0) continue;
    std::vector<std::size_t> corners = good_.faces[f];
    const auto other = from.find({corners[0], corners[2]});
    if (other != from.end() && done[other->second] == 0) {
      for (const std::size_t v : good_.faces[other->second])
        if (v != corners[0] && v != corners[2]) {
          corners.push_back(v);
          break;
        }
      done[other->second] = 1;
      ++quads;
    }
    auto& face = engine.faces.emplace_back();
    for (const std::size_t v : corners) {
      face.push_back(engine.positions.size());
      const auto& p = good_.positions[v];
      engine.positions.push_back({100 * p[0] + 5, 100 * p[1] - 7, 100 * p[2] + .25});
    }
  }
  ASSERT_GT(quads, 100U);
  write("engine.obj", engine.text());
  EXPECT_NE(findings(audit("engine.obj", 1)), "");
  auto rows = audit("engine.obj", 0, "--fit scale --per-vertex each.csv");
  EXPECT_LE(rows["file-distance"]["worst"].get<double>(), 1e-7);
  EXPECT_EQ(rows["file-normals"]["status"], "not-supported");
  const std::string each = read("each.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(each.begin(), each.end(), '\n')),
            1 + engine.positions.size());
  EXPECT_EQ(findings(audit("engine.obj", 1, "--fit scale --normals")), "file-normals");
}

// The provenance that --per-vertex finds, given back, is a provenance.
TEST_F(ExportedFiles, TheParametersThatWereFoundServeAsProvenance) {
  audit("good.obj", 0, "--per-vertex each.csv");
  std::istringstream lines(read("each.csv"));
  std::string map = "vertex,face,l1,l2\n", line;
  std::getline(lines, line);
  std::vector<std::string> rows;
  while (std::getline(lines, line)) {
    std::vector<std::string> cell;
    std::istringstream cells(line);
    for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
    ASSERT_EQ(cell.size(), 6U) << line;
    rows.push_back(cell[0] + "," + cell[3] + "," + cell[4] + "," + cell[5] + "\n");
  }
  for (const std::string& r : rows) map += r;
  write("map.csv", map);
  auto held = audit("good.obj", 0, "--provenance map.csv");
  EXPECT_EQ(held["file-positions"]["of"], good_.positions.size());
  // Two rows exchanged: still on the surface, but not where they say.
  std::swap(rows[10], rows[11]);
  std::string swapped = "vertex,face,l1,l2\n";
  for (std::size_t k = 0; k < rows.size(); ++k)
    swapped += std::to_string(k) + rows[k].substr(rows[k].find(','));
  write("swapped.csv", swapped);
  EXPECT_TRUE(says(findings(audit("good.obj", 1, "--provenance swapped.csv")), "file-positions"));
}

TEST_F(ExportedFiles, OneFaultInTheFileTurnsTheChecksRedThatAreMeantForIt) {
  const auto sees = [&](const char* check, const std::function<void(Obj&)>& fault) {
    const std::string found = findings_with(fault);
    EXPECT_TRUE(says((" " + found + " "), " " + std::string(check) + " "))
        << check << " did not; red: " << found;
  };
  const auto remove = [](Obj& o) { o.faces.erase(o.faces.begin() + 100); };
  sees("file-coverage", remove);
  sees("file-watertight", remove);
  const auto push = [](Obj& o) {  // outwards of a sphere about the origin
    for (double& x : o.positions[100]) x *= 1 + 1e-5;
  };
  EXPECT_EQ(findings_with(push), "file-distance");
  const auto flip = [](Obj& o) { std::swap(o.faces[200][0], o.faces[200][1]); };
  sees("file-orientation", flip);
  sees("file-watertight", flip);
  // Two neighbours in each other's place: every vertex on the surface, every edge shared by two triangles, and the faces
  // those of the mesh; so neither is where it should be.
  sees("file-distance", [](Obj& o) {
    const auto& f = o.faces[250];
    std::swap(o.positions[f[0]], o.positions[f[1]]);
  });
}

}  // namespace
}  // namespace limitcheck::cli
