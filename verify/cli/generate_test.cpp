// SPDX-License-Identifier: MIT
// `limitcheck generate` as a user meets it.
#include <gtest/gtest.h>

#include <filesystem>
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
    const Outcome o = run(std::string("generate bumpy:200 -o ") + file);
    ASSERT_EQ(o.code, 0) << o.err;
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
    const Outcome o = run(std::string("generate cube-quads -o ") + file);
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_TRUE(o.err.starts_with("scheme: catmull-clark (not all faces are triangles)\n")) << o.err;
    EXPECT_EQ(data::read_mesh(folder_ / file), data::quad_cube()) << file;
  }
  const Outcome cut = run("generate cube-quads -o b.obj --triangulate fan");
  EXPECT_TRUE(cut.err.starts_with("scheme: loop (--triangulate fan cut 6 faces into triangles)\n"))
      << cut.err;
  EXPECT_EQ(data::read_mesh(folder_ / "b.obj").faces.size(), 12U);
  EXPECT_EQ(run("generate dual:bumpy:20 -o c.obj --seed 5").code, 0);
  EXPECT_NE(read("c.obj"), "");

  const Outcome stl = run("generate cube-quads -o a.stl");
  EXPECT_EQ(stl.code, 2);
  EXPECT_NE(stl.err.find("STL is read, not written"), std::string::npos) << stl.err;
}

TEST_F(GenerateCommand, RefusesWithExitCodeTwoAndLeavesWhatIsThere) {
  write("keep.obj", "precious");
  for (const char* arguments :
       {"generate", "generate no-such-shape -o keep.obj", "generate bumpy:3 -o keep.obj",
        "generate bumpy:201 -o keep.obj", "generate wheel:2 -o keep.obj", "generate wheel:-7 -o keep.obj",
        "generate wheel:x -o keep.obj", "generate quad-cube -o keep.obj --scheme loop",
        "generate dual:triangle -o keep.obj", "generate octahedron -o keep.obj --scheme doo-sabin",
        "generate icosahedron -o keep.xyz", "generate icosahedron -o absent/a.obj"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments;
    EXPECT_NE(o.err, "") << arguments;
  }
  EXPECT_EQ(read("keep.obj"), "precious");
}

}  // namespace
}  // namespace limitcheck::cli
