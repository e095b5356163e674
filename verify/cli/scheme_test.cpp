// SPDX-License-Identifier: MIT
// Every command that takes a control mesh chooses the scheme by the mesh, says so first, and cuts no polygon
// unless it is told to.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class Scheme : public CommandTest {
 protected:
  static std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }
};

constexpr const char* kLoop = "scheme: loop (all faces are triangles)";
constexpr const char* kCut = "scheme: loop (--triangulate fan cut 6 faces into triangles)";

TEST_F(Scheme, IsTheFirstLineOfEveryCommand) {
  ASSERT_EQ(run("tessellate octahedron --depth 2 -o out.ply").code, 0);
  for (const char* command :
       {"tessellate octahedron --depth 1", "audit naive octahedron --depth 1 --level quick",
        "audit model --depth 1 --level quick", "eval octahedron 0 0 0",
        "audit --control octahedron --tessellation out.ply"}) {
    const Outcome o = run(command, 0);
    EXPECT_EQ(first_line(o.out), kLoop) << command;
  }
  EXPECT_EQ(first_line(run("generate octahedron -o o.obj").err), kLoop);
}

TEST_F(Scheme, LoopsTakesPolygonsThatAreCutOnRequestAndSaysHowMany) {
  ASSERT_EQ(run("tessellate quad-cube --triangulate fan --depth 2 -o out.ply").code, 0);
  for (const char* command :
       {"tessellate quad-cube --depth 1 --triangulate fan", "eval quad-cube 0 0 0 --triangulate fan",
        "audit naive quad-cube --depth 1 --level quick --triangulate fan",
        "audit --control quad-cube --tessellation out.ply --triangulate fan"}) {
    const Outcome o = run(command, 0);
    EXPECT_EQ(first_line(o.out), kCut) << command;
  }
  const auto json = json_of("tessellate quad-cube --depth 1 --triangulate fan --json");
  EXPECT_EQ(json["scheme"], "loop");
  EXPECT_EQ(json["faces_cut"], 6);
  EXPECT_EQ(json["faces"], 12);
}

// Files and names alike.
TEST_F(Scheme, PolygonsAreRefusedForLoopsInASentenceThatNamesTheWaysOut) {
  ASSERT_EQ(run("generate quad-cube -o cube.ply").code, 0);
  ASSERT_EQ(run("tessellate octahedron --depth 1 -o out.ply").code, 0);
  for (const std::string mesh : {"quad-cube", "cube.ply"}) {
    for (const std::string& command : {"tessellate " + mesh, "audit naive " + mesh, "eval " + mesh + " 0 0 0",
                                       "audit --control " + mesh + " --tessellation out.ply"}) {
      const Outcome o = run(command + " --scheme loop", 2);
      EXPECT_EQ(o.out, "") << command;
      for (const char* part :
           {"6 of 6 faces are no triangles", "leave out --scheme loop", "--triangulate fan"})
        EXPECT_TRUE(says(o.err, part)) << command;
    }
  }
}

TEST_F(Scheme, OfATessellationIsThatOfTheMesh) {
  for (const std::string mesh : {"quad-cube", "prism:5", "creased-cube", "creased-cube:2", "mixed-sharp:3"}) {
    const auto json = json_of("tessellate --depth 2 --json " + mesh);
    EXPECT_EQ(json["scheme"], "catmull-clark") << mesh;
    EXPECT_EQ(json["engine"], "row-stream") << mesh;
    EXPECT_GT(json["triangles"], 0) << mesh;
  }
  EXPECT_EQ(run("tessellate octahedron --scheme catmull-clark").code, 0);
  EXPECT_EQ(run("tessellate corner:3").code, 0);
  EXPECT_EQ(run("tessellate dart:5").code, 0);
  const Outcome sharp = run("tessellate sharp:3");
  EXPECT_EQ(sharp.code, 2) << "silence would be the surface without the edges";
  EXPECT_TRUE(says(sharp.err, "semi-sharp"));
}

// What is written is the surface: the audit judges the files like anybody's.
TEST_F(Scheme, TessellationsOfQuadsAreRight) {
  for (const std::string mesh : {"quad-cube", "prism:5"}) {
    for (const std::string file : {"out.ply", "out.glb"}) {
      ASSERT_EQ(run("tessellate " + mesh + " --depth 3 -o " + file).code, 0);
      const Outcome o = run("audit --control " + mesh + " --tessellation " + file);
      EXPECT_EQ(o.code, 0) << mesh << " " << file << "\n" << o.out << o.err;
    }
  }
}

TEST_F(Scheme, OfAnAuditIsThatOfEachMesh) {
  ASSERT_EQ(run("generate prism:5 -o prism.off").code, 0);
  const std::string subject = "audit naive --depth 2 --level quick ";
  const Outcome polygons = run(subject + "quad-cube prism.off", 0);
  EXPECT_EQ(first_line(polygons.out), "scheme: catmull-clark (not all faces are triangles)");
  EXPECT_EQ(first_line(run(subject + "octahedron prism.off cube").out),
            "scheme: loop (2 of 3 meshes, whose faces are all triangles), catmull-clark (1)");
  EXPECT_EQ(first_line(run(subject + "octahedron --scheme catmull-clark").out),
            "scheme: catmull-clark (--scheme)");

  const auto json = json_of(subject + "octahedron prism.off --json");
  EXPECT_EQ(json["meshes"][0]["scheme"], "loop");
  EXPECT_EQ(json["meshes"][1]["scheme"], "catmull-clark");
  for (const auto& row : json["results"])
    EXPECT_EQ(row["scheme"], row["mesh"] == "octahedron" ? "loop" : "catmull-clark") << row["check"];
  EXPECT_TRUE(json["meshes"][1]["triangulated"].is_null());
  const auto cut = json_of(subject + "prism.off --triangulate fan --json");
  EXPECT_EQ(cut["meshes"][0]["triangulated"], "fan");
  EXPECT_EQ(cut["meshes"][0]["faces"], 16);
}

TEST_F(Scheme, OfASubjectThatDoesLoopsOnlyLeadsToTriangulate) {
  const Outcome o = run("audit model quad-cube --depth 1 --level quick", 2);
  EXPECT_TRUE(says(o.out, "does Loop's scheme only needs --triangulate"));
  EXPECT_EQ(run("audit model quad-cube --depth 1 --level quick --triangulate fan").code, 0);
  const Outcome both = run("audit model quad-cube cube --depth 1 --level quick", 2);
  EXPECT_TRUE(says(both.out, "14 held, 0 findings")) << "the cube is judged";
  EXPECT_TRUE(says(both.err, "nothing was judged on quad-cube: model: does not subdivide by catmull-clark"));
}

TEST_F(Scheme, OfBrokenMeshesIsChosenLikewise) {
  write("twice.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 2 3 4 1\n");
  const Outcome o = run("audit naive twice.obj --must-refuse", 0);
  EXPECT_EQ(first_line(o.out), "scheme: catmull-clark (not all faces are triangles)");
  const Outcome cut = run("audit naive twice.obj --must-refuse --triangulate shortest-diagonal", 0);
  EXPECT_EQ(first_line(cut.out), "scheme: loop (--triangulate shortest-diagonal cut 2 faces into triangles)");
  ASSERT_EQ(run("generate quad-cube -o cube.obj").code, 0);
  EXPECT_EQ(run("audit naive cube.obj --must-refuse").code, 2) << "nothing is wrong with it";
  EXPECT_EQ(run("audit naive cube.obj --must-refuse --scheme loop").code, 0) << "no mesh for Loop's scheme";
}

// As polygons this is a disc; cut from their first corners the two quads both get the edge 1-3.
TEST_F(Scheme, WhatIsNoManifoldOnceItIsCutIsRefused) {
  write("book.obj",
        "v 0 0 0\nv 1 -1 0\nv 2 0 0\nv 1 1 0\nv 1 1 1\nv 1 -1 1\nf 1 2 3 4\nf 1 5 3 6\nf 1 4 5\nf 4 3 5\n");
  EXPECT_EQ(run("eval book.obj 0 0 0").code, 0);
  const Outcome o = run("tessellate book.obj --triangulate fan", 2);
  EXPECT_TRUE(says(o.err, "edge 1–3 has 4 faces (1, 1, 2, 2)"));
}

}  // namespace
}  // namespace limitcheck::cli
