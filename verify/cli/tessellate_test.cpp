// SPDX-License-Identifier: MIT
// `limitcheck tessellate` as a user meets it: what it prints, what it writes, what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "data/io/read.h"
#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

// Every call below is one of `limitcheck tessellate`.
class TessellateCommand : public CommandTest {
 protected:
  Outcome run(const std::string& arguments, std::optional<int> code = {}) const {
    return CommandTest::run("tessellate " + arguments, code);
  }
  nlohmann::json json_of(const std::string& arguments, int code = 0) const {
    return CommandTest::json_of("tessellate " + arguments, code);
  }
  // Of the vertices of two files with the same triangles.
  double largest_distance(const char* one, const char* other) const {
    const data::ControlMesh a = data::read_mesh(folder_ / one), b = data::read_mesh(folder_ / other);
    EXPECT_EQ(triangles_of(a), triangles_of(b));
    EXPECT_EQ(a.positions.size(), b.positions.size());
    double worst = 0;
    for (std::size_t v = 0; v < std::min(a.positions.size(), b.positions.size()); ++v)
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(a.positions[v][c] - b.positions[v][c]));
    return worst;
  }
};

TEST_F(TessellateCommand, WritesAClosedManifoldWithEveryTriangleItReports) {
  for (const char* extension : {"ply", "obj"}) {
    const std::string file = std::string("out.") + extension;
    const Outcome o = run("bumpy:200 --strategy random --depth 4 --json -o " + file, 0);
    EXPECT_EQ(o.err, "") << "no progress unless standard error is a terminal";
    const auto json = nlohmann::json::parse(o.out);
    const data::ControlMesh mesh = data::read_mesh(folder_ / file);  // validated
    EXPECT_EQ(json["triangles"], mesh.faces.size());
    EXPECT_EQ(json["vertices"], mesh.positions.size());
    EXPECT_GT(json["fans"], 0);
    // Each edge in both directions, and Euler's formula of the sphere: closed, one piece, no T-vertices.
    std::map<std::pair<int, int>, int> edges;
    for (const auto& t : triangles_of(mesh)) {
      for (int k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    }
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(mesh.positions.size(), mesh.faces.size() / 2 + 2);
  }
}

TEST_F(TessellateCommand, TellsOfSubstituteNormalsAndOnlyThen) {
  {
    std::ofstream cage(folder_ / "needle.obj");  // a tetrahedron whose corners lie on one line
    cage << "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  }
  const Outcome o = run("needle.obj --depth 2 -o needle.ply", 0);
  EXPECT_TRUE(says(o.out, "substitute normals"));
  EXPECT_FALSE(says(run("tetrahedron --depth 2").out, "substitute"));
}

TEST_F(TessellateCommand, CountsWhatTheDesignNamesAndTimesEachStage) {
  const auto json = json_of("bumpy:800 --camera 0,0,4:0,0,0 --json", 0);
  for (const char* key : {"faces", "pairs", "singletons", "fans", "culled", "triangles", "vertices"}) {
    EXPECT_TRUE(json[key].is_number_integer()) << key;
  }
  for (const char* key : {"heuristics", "pairing", "evaluation", "write"}) {
    EXPECT_GE(json["seconds"][key].get<double>(), 0) << key;
  }
  EXPECT_EQ(json["faces"], 800);
  EXPECT_EQ(2 * json["pairs"].get<int>() + json["singletons"].get<int>() + json["culled"].get<int>(), 800);
  EXPECT_EQ(json["strategy"], "combined") << "a view is given";
  EXPECT_GT(json["culled"], 200);
  EXPECT_EQ(json["output"], nullptr);
}

// 4^3 triangles per face; a closed surface of genus 0 has F / 2 + 2 vertices.
TEST_F(TessellateCommand, WithoutOptionsIsUniformOfDepthThree) {
  const auto json = json_of("octahedron --json");
  EXPECT_EQ(json["strategy"], "uniform");
  EXPECT_EQ(json["triangles"], 8 * 64);
  EXPECT_EQ(json["vertices"], 8 * 32 + 2);
  EXPECT_EQ(json["culled"], 0);
  EXPECT_TRUE(says(run("octahedron").out,
                   "8 faces: 4 pairs, 0 singletons, 0 fans, 0 culled; 512 triangles, 258 vertices"));
}

TEST_F(TessellateCommand, WritesTheSameBytesWithAnyNumberOfThreadsAndOtherOnesWithAnotherSeed) {
  const std::string what = "bumpy:400 --strategy random --depth 4 --colour kind -o ";
  ASSERT_EQ(run(what + "1.ply --threads 1").code, 0);
  ASSERT_EQ(run(what + "2.ply --threads 2").code, 0);
  ASSERT_EQ(run(what + "8.ply --threads 8").code, 0);
  ASSERT_EQ(run(what + "seed.ply --seed 2").code, 0);
  EXPECT_FALSE(read("1.ply").empty());
  EXPECT_EQ(read("1.ply"), read("2.ply"));
  EXPECT_EQ(read("1.ply"), read("8.ply"));
  EXPECT_NE(read("1.ply"), read("seed.ply"));
}

// Both engines triangulate alike, so the files differ in rounding alone: at most 2e-7 of the sphere's size,
// and equal in all that counts.
TEST_F(TessellateCommand, StreamsRowsByDefaultAndKeepsThePapersFormOnRequest) {
  for (const char* what : {"bumpy:200 --depth 3", "bumpy:200 --strategy random --depth 4",
                           "bumpy:200 --strategy random --depth 4 --repair stitch"}) {
    const std::string name(what);
    const auto rows = json_of(name + " --json -o rows.ply");
    const auto window = json_of(name + " --json -o window.ply --engine sliding-window");
    EXPECT_EQ(rows["engine"], "row-stream");
    EXPECT_EQ(window["engine"], "sliding-window");
    for (const char* key :
         {"pairs", "singletons", "fans", "stitched", "triangles", "vertices", "limit_points"})
      EXPECT_EQ(rows[key], window[key]) << key;
    const double worst = largest_distance("rows.ply", "window.ply");
    EXPECT_LE(worst, 5e-7) << what;
    EXPECT_GT(worst, 0) << "two engines";
  }
  EXPECT_EQ(run("octahedron --depth 10 --json").code, 0);
}

// Which fuses no product with a sum, unlike the processor's kernels.
TEST_F(TessellateCommand, ComputesOnAGraphicsCardOrSaysWhyNot) {
  for (const char* what : {"bumpy:200 --strategy random --depth 4", "dual:bumpy:60 --depth 3"}) {
    const Outcome there = run(std::string(what) + " --gpu --json -o there.ply");
    if (there.code != 0) {
      EXPECT_EQ(there.code, 2);
      EXPECT_TRUE(says(there.err, "--gpu: no OpenGL"));
      GTEST_SKIP() << there.err;
    }
    EXPECT_TRUE(says(nlohmann::json::parse(there.out)["device"].get<std::string>(), "OpenGL")) << there.out;
    EXPECT_TRUE(json_of(std::string(what) + " --json -o here.ply")["device"].is_null());
    const double worst = largest_distance("here.ply", "there.ply");
    EXPECT_LE(worst, 5e-7) << what;
    EXPECT_GT(worst, 0) << what;
  }
  EXPECT_EQ(run("octahedron --depth 9 --gpu").code, 2);
}

TEST_F(TessellateCommand, ObeysCullingCentreRepairAngleAndPixels) {
  const auto count = [&](const std::string& arguments, const char* key) {
    return json_of("bumpy:200 --json " + arguments, 0)[key].get<std::int64_t>();
  };
  EXPECT_EQ(count("--strategy combined --no-cull", "culled"), 0);
  EXPECT_GT(count("--strategy random --cull", "culled"), 0);
  EXPECT_GT(count("--pixels 20", "triangles"), count("--pixels 60", "triangles"));
  EXPECT_GT(count("--strategy curvature --angle 10", "triangles"),
            count("--strategy curvature --angle 40", "triangles"));
  EXPECT_GT(count("--strategy curvature --angle 40,10", "triangles"),
            count("--strategy curvature --angle 40", "triangles"));
  EXPECT_GT(count("--strategy random --depth 4 --repair stitch", "stitched"), 0);
  EXPECT_LE(count("--strategy combined --max-depth 1", "triangles"), 200 * 4);
  ASSERT_EQ(run("bumpy:200 --strategy random -o limit.ply").code, 0);
  ASSERT_EQ(run("bumpy:200 --strategy random -o flat.ply --centre flat").code, 0);
  EXPECT_EQ(read("limit.ply").size(), read("flat.ply").size());
  EXPECT_NE(read("limit.ply"), read("flat.ply"));
}

TEST_F(TessellateCommand, FromInsideShowsNothingAndSaysWhy) {
  const Outcome o = run("octahedron --camera 0.01,0,0:1,0,0 -o nothing.ply --json", 0);
  EXPECT_EQ(nlohmann::json::parse(o.out)["triangles"], 0);
  EXPECT_TRUE(says(o.err, "is the camera inside?"));
  EXPECT_TRUE(fs::exists(folder_ / "nothing.ply"));
}

TEST_F(TessellateCommand, RefusesBadArgumentsWithExitCodeTwoAndWritesNothing) {
  write("empty.obj", "");
  for (const char* arguments : {"",
                                "no-such-mesh",
                                "empty.obj",
                                "octahedron --depth 40",
                                "octahedron --depth -1",
                                "octahedron --pixels 0",
                                "octahedron --pixels nan",
                                "octahedron --angle 0",
                                "octahedron --angle 1,2,3,4",
                                "octahedron --strategy best",
                                "octahedron --engine fast",
                                "octahedron --camera 1,2",
                                "octahedron --camera 1,2,3:1,2,3",
                                "octahedron --camera 1,2,x:0,0,0",
                                "octahedron --camera 0,0,4:0,0,0:0,0,1",
                                "octahedron --camera 0,0,4:0,0,0:0,1,0:1",
                                "octahedron --viewport 0x768",
                                "octahedron --viewport 640",
                                "octahedron --fov 180",
                                "octahedron --threads -1",
                                "octahedron --colour red",
                                "octahedron --centre middle",
                                "octahedron --strategy uniform --depth 4 --max-depth 3",
                                "octahedron --nonsense",
                                "octahedron -o out.stl",
                                "octahedron -o absent/out.ply"}) {
    const Outcome o = run(std::string(arguments) +
                              (std::string(arguments).find("-o") == std::string::npos ? " -o out.ply" : ""),
                          2);
    EXPECT_NE(o.err, "") << arguments;
    EXPECT_EQ(o.out, "") << arguments;
  }
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename();
    EXPECT_TRUE(name == ".stdout" || name == ".stderr" || name == "empty.obj") << name;
  }
}

}  // namespace
}  // namespace limitcheck::cli
