// SPDX-License-Identifier: MIT
// The shader door as a user meets it: the templates are right, each planted fault is seen, and no audit ends with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <sstream>
#include <string>
#include <vector>

#include "verify/shader/prelude.h"
#include "verify/shader/shader_door_test.h"
#include "verify/shader/source.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::cli {
namespace {

// All vertices of quad-torus have four faces: its patches are bicubic B-splines. Shared points keep their bits with
// turned corners, too.
TEST_F(ShaderDoor, TheTemplatesOfAFunctionAndOfATessellationShaderHoldOnARegularTorus) {
  for (const std::string file : {"function.glsl", "tessellation.glsl"}) {
    const json report = audited((kTemplates / file).string() + " quad-torus --depth 3", 0);
    for (const char* check : {"positions", "normals", "shared-positions", "coverage", "written", "finite"})
      EXPECT_EQ(status(report, check), "held") << file << " " << check;
    const json turned = row(report, "corner-rotation");  // a warning: bits inside faces are others
    EXPECT_GT(turned["of"], 1000) << file;
    EXPECT_EQ(turned["count"], 0) << file << turned["message"];
    EXPECT_GT(row(report, "positions")["of"], 1000) << file;
    EXPECT_EQ(report["devices"].size(), 1U);
  }
}

// Hardware cuts triangles otherwise than into halves.
TEST_F(ShaderDoor, EachVertexOfATessellationShaderIsJudgedWhereItLies) {
  write("flat.glsl", R"(#pragma limitcheck tessellate
#pragma limitcheck scheme loop
#pragma limitcheck no-normals
layout(triangles, equal_spacing, ccw) in;
void main() {
  int a = lc_first(lc_patch_face), b = lc_next(a), c = lc_next(b);
  vec3 p = gl_TessCoord.x * lc_position(lc_vertex(a)) + gl_TessCoord.y * lc_position(lc_vertex(b)) +
           gl_TessCoord.z * lc_position(lc_vertex(c));
  lc_put(p, vec3(0), lc_patch_face, 0, gl_TessCoord.yz);
}
)");
  const json report = audited("flat.glsl octahedron --depth 3 --level quick", 1);
  EXPECT_EQ(status(report, "coverage", "octahedron"), "held");
  const json positions = row(report, "positions", "octahedron");
  EXPECT_EQ(positions["of"], row(report, "finite", "octahedron")["of"]);
  EXPECT_EQ(positions["count"], positions["of"]) << "the flat faces lie outside the surface";
}

TEST_F(ShaderDoor, TheTemplateOfPassesRefinesQuadsAndPolygonsInsideAndAtBoundaries) {
  const std::string meshes = "quad-cube quad-fan:1 quad-fan:5 prism:5 mixed:1:40";
  const json report = audited((kTemplates / "passes.glsl").string() + " " + meshes + " --depth 3", 0);
  int judged = 0;
  for (const json& r : report["results"])
    judged += r["check"] == "refined-positions" && r["status"] == "held";
  EXPECT_EQ(judged, 5);
}

TEST_F(ShaderDoor, AWrongWeightIsAFindingWithItsWitness) {
  plant("function.glsl", "t * t + 4.0, 3.0", "t * t + 4.001, 3.0");
  const json report = audited("wrong.glsl quad-torus quad-torus:5 --depth 2 --level quick", 1);
  EXPECT_EQ(status(report, "positions"), "finding");
  // 0.001 / 6 of a coordinate of the torus, which is a quarter of the diagonal from the middle, in each direction
  EXPECT_GT(row(report, "positions")["worst"], 1e-5);
  EXPECT_TRUE(says(row(report, "positions")["witness"]["command"], "limitcheck eval quad-torus"));
}

TEST_F(ShaderDoor, WhatItWritesBehindABufferIsAFinding) {
  // Room for one level of half-edges: the second, 64 of 12 bytes each, lies behind it.
  plant("passes.glsl", "buffer 3 24*C(d)", "buffer 3 12*C(d)");
  const json report = audited("wrong.glsl quad-fan:1 --depth 1 --level quick", 1);
  const std::string message = row(report, "written", "quad-fan:1")["message"];
  EXPECT_TRUE(says(message, "written 768 bytes behind")) << message;
}

TEST_F(ShaderDoor, AVertexThatIsNoneIsAFinding) {
  plant("passes.glsl", "lc_put_vertex(k, point(level, k));", "lc_put_vertex(k + 3, point(level, k));");
  const json report = audited("wrong.glsl quad-torus --depth 1 --level quick", 1);
  const std::string message = row(report, "written")["message"];
  EXPECT_TRUE(says(message, "36 bytes")) << message;  // three vertices of three floats
}

TEST_F(ShaderDoor, WhatDoesNotCompileIsNamedWithTheLineOfTheFile) {
  plant("function.glsl", "    position += wv[j] * row;", "    position += wv[j] * rows;");
  std::istringstream lines(read("wrong.glsl"));
  int number = 1;
  for (std::string line; std::getline(lines, line) && !line.ends_with(" rows;");) ++number;
  const Outcome o = run("audit --shader wrong.glsl quad-torus --depth 1 --level quick", 2);
  EXPECT_TRUE(says(o.err, "does not compile: wrong.glsl:" + std::to_string(number) + ":")) << o.err;
  EXPECT_TRUE(says(o.err, "rows")) << o.err;
}

// Lines end with LF, CR LF or CR; a mark of the byte order may come first, as editors write it.
TEST_F(ShaderDoor, OfEveryKindOfTextTheLinesAreSeen) {
  const std::string text = contents_of(kTemplates / "function.glsl");
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    write("right.glsl", "\xEF\xBB\xBF" + other);
    EXPECT_EQ(status(audited("right.glsl quad-torus --depth 1 --level quick", 0), "positions"), "held");
    write("wrong.glsl",
          "\xEF\xBB\xBF#pragma limitcheck scheme loop" + end + "#pragma limitcheck wish" + end + other);
    const Outcome o = run("audit --shader wrong.glsl quad-cube --depth 1 --level quick", 2);
    EXPECT_TRUE(says(o.err, "wrong.glsl:2: ")) << o.err;
    write("wrong.glsl", "// text" + end + std::string(1, '\0') + text);
    EXPECT_TRUE(says(run("audit --shader wrong.glsl quad-cube --depth 1", 2).err, "wrong.glsl:2: a NUL"));
  }
}

// llvmpipe is wrong in such groups; another device may do them.
TEST_F(ShaderDoor, GroupsThatTheDriverGetsWrongAreRefusedAndTheShaderIsNotBlamed) {
  plant("passes.glsl", "layout(std430, binding = 2)",
        "layout(local_size_x = 4) in;\nlayout(std430, binding = 2)");
  const Outcome o = run("audit --shader wrong.glsl quad-torus --depth 1 --level quick");
  EXPECT_TRUE(o.code == 0 || (o.code == 2 && says(o.err, "work groups of 4"))) << o.out << o.err;
}

// What it says that it does not do it is not asked for.
TEST_F(ShaderDoor, QuadsAloneAreNoFault) {
  const std::string file = (kTemplates / "function.glsl").string();
  const json report =
      audited(file + " quad-torus prism:5 --depth 1 --level quick", 2);  // not all was looked at
  EXPECT_EQ(status(report, "positions"), "held");
  EXPECT_EQ(status(report, "tessellates", "prism:5"), "not-supported");
  // Nor does the report say that it never looked at them.
  const std::string never = report["coverage"][0]["never"].dump();
  EXPECT_TRUE(says(never, "0 infinite edges, 5 faces")) << never;
  EXPECT_FALSE(says(never, "a face of 3 corners") || says(never, "a triangle by"));
}

// A driver may end the loop, as llvmpipe does after some turns: then the points are wrong; or the time is over.
TEST_F(ShaderDoor, ALoopWithoutEndIsAFindingAndTheAuditGoesOn) {
  plant("function.glsl", "  position = vec3(0);\n",
        "  position = vec3(0);\n  if (lc_F > 6)\n    for (int a = 0; a < 1000000000; ++a)\n"
        "      for (int b = 0; b < 1000000000; ++b) position.x = position.x * 0.999 + uv.x;\n");
  const json report = audited("wrong.glsl quad-torus quad-cube --depth 1 --level quick --timeout 15", 1);
  EXPECT_TRUE(status(report, "tessellates") == "timeout" || status(report, "positions") == "finding");
  EXPECT_EQ(status(report, "written", "quad-cube"), "held");
}

TEST_F(ShaderDoor, NotANumberIsAFinding) {
  plant("function.glsl", "  position = vec3(0);\n",
        "  position = vec3(0);\n  if (face == 3) position.y = sqrt(-1.0 - uv.x);\n");
  const json report = audited("wrong.glsl quad-torus --depth 1 --level quick", 1);
  EXPECT_EQ(status(report, "finite"), "finding");
  EXPECT_EQ(row(report, "finite")["count"], 9);  // the points of that face
}

TEST_F(ShaderDoor, PragmasThatMeanNothingAreRefusedWithTheirLine) {
  for (const auto& [line, what] : {std::pair{"#pragma limitcheck scheme third", "third"},
                                   {"#pragma limitcheck max-depth eleven", "eleven"},
                                   {"#pragma limitcheck pass FACES F( 1..2", "F("},
                                   {"#pragma limitcheck pass 9X V", "'9X' is no name of a pass"},
                                   {"#pragma limitcheck pass main V", "'main' is no name of a pass"},
                                   {"#pragma limitcheck wish all", "wish"}}) {
    write("wrong.glsl", std::string("// a shader\n") + line + "\n");
    const Outcome o = run("audit --shader wrong.glsl quad-cube", 2);
    EXPECT_TRUE(says(o.err, "wrong.glsl:2: ")) << o.err;
    EXPECT_TRUE(says(o.err, what)) << o.err;
  }
  write("wrong.glsl", "void main() {}\n");
  EXPECT_TRUE(says(run("audit --shader wrong.glsl quad-cube", 2).err, "lc_evaluate"));
  EXPECT_TRUE(says(run("audit --shader there-is-none.glsl quad-cube", 2).err, "there-is-none.glsl"));
}

}  // namespace
}  // namespace limitcheck::cli

namespace limitcheck::verify {
namespace {

// Two triangles of a square with a semi-sharp diagonal, corners held.
TEST(HalfEdges, HaveTwinsEdgesAndSharpnessOfTwoTriangles) {
  const double positions[12]{};
  const std::int32_t corners[]{0, 1, 2, 0, 2, 3}, sizes[]{3, 3};
  const lc_sharp_edge diagonal{0, 2, 2.5F};
  lc_mesh mesh{};
  mesh.vertex_count = 4, mesh.face_count = 2, mesh.corner_count = 6;
  mesh.positions = positions, mesh.corners = corners, mesh.face_sizes = sizes;
  mesh.sharp_edges = &diagonal, mesh.sharp_edge_count = 1, mesh.corners_held = 1;
  const HalfEdges half_edges(mesh);
  const auto f = [](float x) { return std::bit_cast<std::int32_t>(x); };
  const std::vector<std::int32_t> behind_positions_and_vertices{
      -1,    -1,    3,      2,      -1,    -1,     // twin
      0,     1,     2,      2,      3,     4,      // edge
      0,     0,     0,      1,      1,     1,      // face
      f(10), f(10), f(2.5), f(2.5), f(10), f(10),  // sharpness
      0,     3,     6,                             // first half-edges
      0,     f(10), 0,      f(10)};                // sharpness of vertices
  ASSERT_EQ(half_edges.words.size(), 18 + behind_positions_and_vertices.size());
  EXPECT_TRUE(std::equal(behind_positions_and_vertices.begin(), behind_positions_and_vertices.end(),
                         half_edges.words.begin() + 18));
}

// A cube has 8 vertices and 6 quads, an octahedron 6 and 8 triangles. Steps keep V - E + F = 2, each quad becomes four, and so
// does each triangle; each edge of a closed mesh belongs to two faces.
TEST(Formula, CountsWhatStepsOfSubdivisionMake) {
  const MeshCounts cube{LC_SCHEME_CATMULL_CLARK, {8, 6, 24, 12}, 2, 1};
  const MeshCounts octahedron{LC_SCHEME_LOOP, {6, 8, 24, 12}, 2, 1};
  EXPECT_EQ(Formula("F(d)").value(cube), 96);
  EXPECT_EQ(Formula("E(d)").value(cube), 192);
  EXPECT_EQ(Formula("V(2)").value(cube), 98);
  EXPECT_EQ(Formula("C(level)").value(octahedron), 96);
  EXPECT_EQ(Formula("V(d)-E(d)+F(d)").value(octahedron), 2);
  EXPECT_EQ(Formula("12*C*4^(d+1)/2-1").value(cube), 12 * 24 * 64 / 2 - 1);
  EXPECT_EQ(Formula("d-3").value(cube), -1);
  for (const char* wrong : {"", "V+", "(V", "V)", "x", "V V", "1/0", "2^41", "V(0-1)", "9999999999999999999"})
    EXPECT_THROW((void)Formula(wrong).value(cube), SubjectError) << wrong;
}

}  // namespace
}  // namespace limitcheck::verify
