// SPDX-License-Identifier: MIT
// `limitcheck generate` as a user meets it.
// `limitcheck check` and `limitcheck repair` as a user meets them.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "data/generators/polygon_meshes.h"
#include "data/io/read.h"
#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class GenerateCommand : public CommandTest {};

// F = 2V - 4 on a closed surface of genus 0.                                                          [C71]
TEST_F(GenerateCommand, WritesABumpySphereInEveryFormat) {
  for (const char* file : {"a.obj", "a.off", "a.ply"}) {
    const Outcome o = run(std::string("generate bumpy:200 -o ") + file, 0);
    const data::ControlMesh mesh = data::read_mesh(folder_ / file);
    EXPECT_EQ(mesh.faces.size(), 200U);
    EXPECT_EQ(mesh.positions.size(), 102U);
  }
}

TEST_F(GenerateCommand, TheSeedDecidesTheMesh) {
  ASSERT_EQ(run("generate bumpy:200 -o a.obj --seed 7").code, 0);
  ASSERT_EQ(run("generate bumpy:200 -o b.obj --seed 7").code, 0);
  ASSERT_EQ(run("generate bumpy:200 -o c.obj --seed 8").code, 0);
  EXPECT_EQ(read("a.obj"), read("b.obj"));
  EXPECT_NE(read("a.obj"), read("c.obj"));
}

TEST_F(GenerateCommand, WritesPolygonsAsPolygonsInEveryFormat) {
  for (const char* file : {"a.obj", "a.off", "a.ply"}) {
    const Outcome o = run(std::string("generate cube-quads -o ") + file, 0);
    EXPECT_TRUE(o.err.starts_with("scheme: catmull-clark (not all faces are triangles)\n")) << o.err;
    EXPECT_EQ(data::read_mesh(folder_ / file), data::quad_cube()) << file;
  }
  const Outcome cut = run("generate cube-quads -o b.obj --triangulate fan");
  EXPECT_TRUE(cut.err.starts_with("scheme: loop (--triangulate fan cut 6 faces into triangles)\n"))
      << cut.err;
  EXPECT_EQ(data::read_mesh(folder_ / "b.obj").faces.size(), 12U);
  EXPECT_EQ(run("generate dual:bumpy:20 -o c.obj --seed 5").code, 0);
  EXPECT_NE(read("c.obj"), "");

  const Outcome stl = run("generate cube-quads -o a.stl", 2);
  EXPECT_TRUE(says(stl.err, "STL is read, not written"));
}

TEST_F(GenerateCommand, RefusesWithExitCodeTwoAndLeavesWhatIsThere) {
  write("keep.obj", "precious");
  expect_refused("generate", {"", "no-such-shape -o keep.obj", "bumpy:3 -o keep.obj", "bumpy:201 -o keep.obj",
                              "wheel:2 -o keep.obj", "wheel:-7 -o keep.obj", "wheel:x -o keep.obj",
                              "quad-cube -o keep.obj --scheme loop", "dual:triangle -o keep.obj",
                              "octahedron -o keep.obj --scheme doo-sabin", "icosahedron -o keep.xyz",
                              "icosahedron -o absent/a.obj"});
  EXPECT_EQ(read("keep.obj"), "precious");
}

class CheckCommand : public CommandTest {};
class RepairCommand : public CommandTest {};

// Faces 2 and 4 (lines 6 and 8) are at fault, and so is vertex 5.
constexpr const char* kBroken =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 9\nf 1 2 4\nf 3 3 4\nf 2 3 4\nf 1 4 3\nv 7 7 7\n";

TEST_F(CheckCommand, ListsEveryFaultWithItsLineAndCountsAsTheFileDoes) {
  write("broken.obj", kBroken);
  const Outcome o = run("check broken.obj", 1);
  EXPECT_TRUE(says(o.out, "broken.obj:6: MESH_INDEX_OUT_OF_RANGE: face 2 names vertex 9"));
  EXPECT_TRUE(says(o.out, "broken.obj:8: MESH_DEGENERATE_FACE: face 4 names vertex 3 twice"));
  EXPECT_TRUE(says(o.out, "broken.obj:11: MESH_ISOLATED_VERTEX: no face names vertex 5"));
  EXPECT_TRUE(says(o.out, "counted from 1"));

  const auto json = json_of("check broken.obj --json");
  EXPECT_EQ(json["faults"].size(), 2U);
  EXPECT_EQ(json["warnings"].size(), 1U);
  EXPECT_FALSE(json["valid"].get<bool>());
  EXPECT_EQ(json["numbers_from"], 1);
}

// The first of the tetrahedron's five, and the last.
TEST_F(CheckCommand, UnusedVerticesAreLeftOutAndNoFault) {
  write("used.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  write("unused.obj",
        "v 7 7 7\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\nf 2 4 3\nf 2 3 5\nf 3 4 5\nf 2 5 4\n");
  write("unused.ply",
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
        "7 7 7\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 9 9\n3 1 3 2\n3 1 2 4\n3 2 3 4\n3 1 4 3\n");
  const auto rows = [&](const std::string& mesh) {
    const auto report = json_of("audit sliding-window " + mesh + " --depth 2 --json -", 0);
    EXPECT_EQ(report["meshes"][0]["vertices"], 4) << mesh;
    std::string text;
    for (const auto& row : report["results"]) text += row["check"].dump() + row["worst"].dump() + "\n";
    return text;
  };
  const std::string without = rows("used.obj");
  for (const std::string mesh : {"unused.obj", "unused.ply"}) {
    EXPECT_EQ(rows(mesh), without) << mesh;
    EXPECT_EQ(run("audit sliding-window " + mesh + " --depth 1 --level quick").err,
              "limitcheck: warning: " + mesh + ": 2 vertices that no face names are left out\n");
    const Outcome check = run("check " + mesh, 0);
    EXPECT_TRUE(says(check.out, "unused vertices     2, which an audit leaves out"));
    ASSERT_EQ(run("tessellate " + mesh + " -o fine.ply --depth 2").code, 0);
    EXPECT_EQ(run("audit --control " + mesh + " --tessellation fine.ply").code, 0);
    const auto position = [&](const std::string& of) {
      return json_of("eval " + of + " 0 1/3 1/3 --json")["position"];
    };
    EXPECT_EQ(position(mesh), position("used.obj"));
  }
}

TEST_F(CheckCommand, SummarisesAMeshWithoutFaults) {
  ASSERT_EQ(run("generate octahedron -o o.ply").code, 0);
  const Outcome o = run("check o.ply", 0);
  EXPECT_TRUE(says(o.out, "none: the mesh is closed"));
  const auto json = json_of("check o.ply --json");
  EXPECT_TRUE(json["valid"].get<bool>());
  EXPECT_EQ(json["vertices"], 6);
  EXPECT_EQ(json["interior_valences"]["4"], 6);
  EXPECT_EQ(json["euler_characteristic"], 2);
}

TEST_F(CheckCommand, NamesPolygonsNotTheTrianglesTheyBecome) {
  // Two quads and a third face on the edge that they share.
  write("book.obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 1 0 1\nf 1 2 3 4\nf 2 5 6 3\nf 3 2 7\n");
  const Outcome o = run("check book.obj", 1);
  EXPECT_TRUE(says(o.out, "edge 2–3 has 3 faces (1, 2, 3)"));
}

TEST_F(CheckCommand, JudgesAMeshByItsSchemeAndCountsItsFacesBySize) {
  ASSERT_EQ(run("generate prism:5 -o prism.obj").code, 0);
  const Outcome o = run("check prism.obj", 0);
  EXPECT_TRUE(o.out.starts_with("scheme: catmull-clark (not all faces are triangles)\n")) << o.out;
  EXPECT_TRUE(says(o.out, "7; by corners: 5 of 4, 2 of 5"));
  EXPECT_TRUE(says(o.out, "by neighbours: 10 of 3"));

  const Outcome loop = run("check prism.obj --scheme loop", 1);
  EXPECT_TRUE(loop.out.starts_with("scheme: loop (--scheme)\n")) << loop.out;
  EXPECT_TRUE(says(loop.out, "prism.obj:11: MESH_POLYGON: face 1 has 5 corners"));

  const Outcome cut = run("check prism.obj --triangulate shortest-diagonal", 0);
  EXPECT_TRUE(
      cut.out.starts_with("scheme: loop (--triangulate shortest-diagonal cut 7 faces into triangles)\n"))
      << cut.out;

  const auto checked = [&](const std::string& options) {
    return json_of("check prism.obj --json" + options);
  };
  const auto own = checked(""), of_triangles = checked(" --triangulate fan");
  EXPECT_EQ(own["scheme"], "catmull-clark");
  EXPECT_EQ(own["faces_cut"], 0);
  EXPECT_EQ(own["face_sizes"], (nlohmann::json{{"4", 5}, {"5", 2}}));
  EXPECT_EQ(own["euler_characteristic"], 2);
  EXPECT_EQ(of_triangles["scheme"], "loop");
  EXPECT_EQ(of_triangles["faces_cut"], 7);
  // As ever: those that the faces of the file give when they are cut.
  EXPECT_EQ(own["triangles"], 16);
  EXPECT_EQ(of_triangles["triangles"], 16);
  EXPECT_EQ(checked(" --scheme loop")["faults"].size(), 7U);
}

TEST_F(CheckCommand, ChoosesTheSchemeByFacesThatAreAtFaultToo) {
  write("twice.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4 2\n");
  EXPECT_TRUE(run("check twice.obj").out.starts_with("scheme: catmull-clark")) << run("check twice.obj").out;
}

TEST_F(CheckCommand, RefusesWhatIsNoMesh) {
  write("x.obj", "v 1 2\n");
  expect_refused("check", {"x.obj", "absent.obj", "", "x.xyz"});
}

TEST_F(RepairCommand, MakesAMeshThatAnAuditTakes) {
  write("broken.obj", kBroken);
  ASSERT_EQ(run("audit row-stream broken.obj --depth 1 --level quick").code, 2);
  const Outcome o = run("repair broken.obj -o fixed.obj", 0);
  EXPECT_TRUE(says(o.out, "dropped 1 face that named a vertex which does not exist"));
  EXPECT_EQ(run("check fixed.obj").code, 0);
  EXPECT_EQ(run("audit row-stream fixed.obj --depth 1 --level quick").code, 0);
  EXPECT_TRUE(says(run("repair fixed.obj -o again.obj").out, "\nnothing had to be changed\n"));
}

TEST_F(RepairCommand, WeldsTheBorderWithinADistanceIfItIsGivenOne) {
  write("strip.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e-16 0 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 1e-16 1\n"
        "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n");
  EXPECT_TRUE(says(run("repair --weld 1e-6 strip.obj -o a.obj", 0).out, "6 vertices, 3 faces"));
  for (const char* plain : {"repair --weld strip.obj -o b.obj", "repair strip.obj -o b.obj --weld"})
    EXPECT_TRUE(says(run(plain, 0).out, "8 vertices, 3 faces")) << plain;
  expect_refused("repair",
                 {"strip.obj -o b.obj --weld nan", "strip.obj -o b.obj --weld 1", "-o b.obj --weld 1e-6",
                  "strip.obj -o b.obj --weld -1", "strip.obj -o b.obj --weld much"});
}

TEST_F(RepairCommand, SaysWhatItCannotMend) {
  // Two triangles back to back: three interior vertices of valence 2.
  write("pillow.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n");
  const Outcome o = run("repair pillow.off -o out.off");
  EXPECT_EQ(o.code, 0) << o.out;  // the later of the two faces is a duplicate, and goes
  EXPECT_TRUE(says(o.out, "dropped 1 face with the corners of a face before it"));
}

TEST_F(RepairCommand, KeepsPolygonsInEveryFormat) {
  write("quads.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 9 9 9\nf 1 2 3 4\nf 2 5 6 3\n");
  for (const char* file : {"a.obj", "a.off", "a.ply"}) {
    ASSERT_EQ(run(std::string("repair quads.obj -o ") + file).code, 0);
    const auto json = json_of(std::string("check --json ") + file);
    EXPECT_EQ(json["face_sizes"], (nlohmann::json{{"4", 2}})) << file;
    EXPECT_EQ(json["vertices"], 6) << file;
  }
}

TEST_F(RepairCommand, CutsPolygonsOnlyIfItIsTold) {
  ASSERT_EQ(run("generate quad-cube -o cube.off").code, 0);
  const Outcome kept = run("repair cube.off -o kept.off"),
                cut = run("repair cube.off -o cut.off --triangulate fan");
  EXPECT_TRUE(kept.out.starts_with("scheme: catmull-clark (not all faces are triangles)\n")) << kept.out;
  EXPECT_TRUE(says(kept.out, "8 vertices, 6 faces"));
  EXPECT_TRUE(cut.out.starts_with("scheme: loop (--triangulate fan cut 6 faces into triangles)\n"))
      << cut.out;
  EXPECT_TRUE(says(cut.out, "8 vertices, 12 faces"));
  EXPECT_EQ(read("kept.off"), read("cube.off"));
  const Outcome loop = run("repair cube.off -o loop.off --scheme loop");
  EXPECT_EQ(loop.code, 1) << "faults are left, for Loop's scheme";
  EXPECT_TRUE(says(loop.out, "MESH_POLYGON"));
}

TEST_F(RepairCommand, LeavesWhatIsThereWhenItCannotWrite) {
  write("broken.obj", kBroken);
  write("keep.stl", "precious");
  EXPECT_EQ(run("repair broken.obj -o keep.stl").code, 2);
  EXPECT_EQ(read("keep.stl"), "precious");
  EXPECT_EQ(run("repair absent.obj -o keep.stl").code, 2);
  EXPECT_EQ(read("keep.stl"), "precious");
}

TEST_F(CheckCommand, APointCloudIsCalledOne) {
  write("cloud.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
        "z\nend_header\n0 0 0\n");
  write("cloud.obj", "v 0 0 0\n");
  for (const std::string file : {"cloud.ply", "cloud.obj"}) {
    const Outcome o = run("check " + file, 1);
    EXPECT_TRUE(says(o.out, "MESH_EMPTY: a point cloud: 1 vertices and no faces"));
    EXPECT_FALSE(says(o.out, "closed"));
  }
}

// Which has a vertex for each normal: without them being one there would be a seam.
TEST_F(CheckCommand, AControlMeshMayBeGltf) {
  ASSERT_EQ(run("tessellate octahedron --depth 1 --no-cull -o cage.glb").code, 0);
  EXPECT_TRUE(says(run("check cage.glb", 0).out, "none: the mesh is closed"));
  EXPECT_EQ(run("audit naive cage.glb --depth 1 --level quick").code, 0);
  EXPECT_EQ(run("repair cage.glb -o cage.obj").code, 0);
}

// Each line that `help tags` shows is read, and check says so where it is an edge or a vertex.
TEST_F(CheckCommand, TheTagsOfTheHelpAreReadAndCounted) {
  const std::string help = run("help tags", 0).out;
  ASSERT_EQ(run("generate quad-cube -o cube.obj").code, 0);
  const std::string cube = read("cube.obj");
  std::size_t tags = 0;
  std::istringstream in(help);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("  t ")) continue;
    ++tags;
    std::string tag = line.substr(2, line.find("   ", 4) - 2);
    const auto edge = cube.substr(cube.find("\nf ") + 3);  // "1 2 3 4", from 1
    for (const auto& [letter, number] :
         {std::pair{" A ", fmt::format(" {} ", std::stoi(edge) - 1)},
          {" B ", fmt::format(" {} ", std::stoi(edge.substr(edge.find(' '))) - 1)},
          {" V ", std::string(" 3 ")}})
      if (const auto at = tag.find(letter); at != tag.npos) tag.replace(at, 3, number);
    if (tag.ends_with(" S")) tag.replace(tag.size() - 1, 1, "23/10");
    if (tag.ends_with(" F")) tag.replace(tag.size() - 1, 1, "5");
    write("tagged.obj", cube + tag + "\n");
    const std::string said = run("check tagged.obj", 0).out;
    EXPECT_EQ(says(said, "sharp edges         1 semi-sharp (2.3)\n"), says(tag, "crease ")) << said;
    EXPECT_EQ(says(said, "sharp vertices      1 semi-sharp (2.3)\n"), says(tag, "corner ")) << said;
    if (says(tag, "hole ")) {
      ASSERT_EQ(run("audit naive tagged.obj --depth 1 --level quick").code, 0);
    }
  }
  EXPECT_EQ(tags, 6U);
  EXPECT_TRUE(says(run("help tag", 2).err, "there is no command 'tag'"));
  EXPECT_TRUE(says(run("help eval", 0).out, "--digits"));
}

TEST_F(CheckCommand, LongListsOfFaultsAreCutAndJsonHasThemAll) {
  std::string file = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int k = 0; k < 400; ++k) file += "f 1 2 3\n";
  write("many.obj", file);
  const std::string said = run("check many.obj", 1).out;
  EXPECT_LT(std::count(said.begin(), said.end(), '\n'), 60);
  EXPECT_TRUE(says(said, " more; limitcheck check many.obj --json has them all"));
  EXPECT_GT(json_of("check many.obj --json", 1)["faults"].size(), 300U);
}

TEST_F(GenerateCommand, WhatBecomesOfChannelsIsSaid) {
  EXPECT_TRUE(says(run("generate uvs:1:cube -o c.ply", 0).err,
                   "no place for the rule of the channel uv, the channel colour"));
  (void)run("generate uv-torus -o torus.obj", 0);
  EXPECT_TRUE(says(run("check torus.obj", 0).out, "uv: "));
  EXPECT_EQ(json_of("check torus.obj --json", 0)["channels"][0]["components"], 2);
  EXPECT_TRUE(says(run("tessellate torus.obj --depth 1 -o fine.obj", 0).err, "fine.obj has none"));
  (void)run("repair torus.obj -o again.obj", 0);
  EXPECT_EQ(read("again.obj"), read("torus.obj"));
}

}  // namespace
}  // namespace limitcheck::cli
