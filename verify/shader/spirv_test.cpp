// SPDX-License-Identifier: MIT
// The shader door by Vulkan as a user meets it: the templates as modules are right, and each planted fault is seen. On Mesa's
// driver for the processor.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "verify/shader/shader_door_test.h"

namespace limitcheck::cli {
namespace {

class SpirvDoor : public ShaderDoor {
 protected:
  void SetUp() override { setenv("VK_ICD_FILENAMES", LIMITCHECK_LAVAPIPE, 1); }
  void TearDown() override { unsetenv("VK_ICD_FILENAMES"); }

  /// As SHADERS.md says: the file with all that it is given, a module of it or of each of its passes, its pragmas beside them.
  void compile(const std::string& glsl, const std::string& passes = "") const {
    std::string script =
        "set -e\ncp '" + glsl + "' my.spv.pragmas\nlimitcheck shader '" + glsl + "' > my.comp\n";
    script += passes.empty() ? LIMITCHECK_GLSLANG " -V my.comp -o my.spv\n"
                             : "for pass in " + passes +
                                   "; do " LIMITCHECK_GLSLANG " -V -D$pass my.comp -o my.$pass.spv; done\n";
    (void)shell(script, 0);
  }
  static constexpr const char* kPasses = "START FACES EDGES VERTICES SPLIT DELIVER";
};

TEST_F(SpirvDoor, TheTemplateOfAFunctionHoldsOnARegularTorus) {
  compile((kTemplates / "function.glsl").string());
  const json report = audited("my.spv quad-torus --depth 3", 0);
  for (const char* check : {"positions", "normals", "shared-positions", "coverage", "written", "finite"})
    EXPECT_EQ(status(report, check), "held") << check;
  EXPECT_GT(row(report, "positions")["of"], 1000);
  EXPECT_TRUE(says(report["devices"].dump(), "Vulkan")) << report["devices"];
}

TEST_F(SpirvDoor, TheTemplateOfPassesRefinesInsideAndAtBoundaries) {
  compile((kTemplates / "passes.glsl").string(), kPasses);
  const json report = audited("my.spv quad-cube quad-fan:5 prism:5 --depth 3 --level quick", 0);
  for (const char* mesh : {"quad-cube", "quad-fan:5", "prism:5"})
    EXPECT_EQ(status(report, "refined-positions", mesh), "held") << mesh;
}

TEST_F(SpirvDoor, AWrongWeightIsAFinding) {
  plant("function.glsl", "t * t + 4.0, 3.0", "t * t + 4.001, 3.0");
  compile("wrong.glsl");
  const json report = audited("my.spv quad-torus --depth 2 --level quick", 1);
  EXPECT_EQ(status(report, "positions"), "finding");
  EXPECT_GT(row(report, "positions")["worst"], 1e-5);  // 0.001 / 6 of a coordinate, as by OpenGL
}

TEST_F(SpirvDoor, WhatItWritesBehindABufferIsAFinding) {
  plant("passes.glsl", "buffer 3 24*C(d)", "buffer 3 12*C(d)");
  compile("wrong.glsl", kPasses);
  const json report = audited("my.spv quad-fan:1 --depth 1 --level quick", 1);
  const std::string message = row(report, "written", "quad-fan:1")["message"];
  EXPECT_TRUE(says(message, "written 768 bytes behind")) << message;
}

TEST_F(SpirvDoor, NotANumberIsAFinding) {
  plant("function.glsl", "  position = vec3(0);\n",
        "  position = vec3(0);\n  if (face == 3) position.y = sqrt(-1.0 - uv.x);\n");
  compile("wrong.glsl");
  const json report = audited("my.spv quad-torus --depth 1 --level quick", 1);
  EXPECT_EQ(status(report, "finite"), "finding");
  EXPECT_EQ(row(report, "finite")["count"], 9);  // the points of that face
}

TEST_F(SpirvDoor, ALoopWithoutEndIsAFindingAndTheAuditGoesOn) {
  plant("function.glsl", "  position = vec3(0);\n",
        "  position = vec3(0);\n  if (lc_F > 6)\n    for (int a = 0; a < 1000000000; ++a)\n"
        "      for (int b = 0; b < 1000000000; ++b) position.x = position.x * 0.999 + uv.x;\n");
  compile("wrong.glsl");
  const json report = audited("my.spv quad-torus quad-cube --depth 1 --level quick --timeout 15", 1);
  EXPECT_TRUE(status(report, "tessellates") == "timeout" || status(report, "positions") == "finding");
  EXPECT_EQ(status(report, "written", "quad-cube"), "held");
}

TEST_F(SpirvDoor, AnAuditOfAModuleWithOtherPragmasOrPassesIsAnotherOne) {
  plant("function.glsl", "  position = vec3(0);\n",
        "  position = vec3(0);\n  if (lc_F > 6)\n    for (int a = 0; a < 1000000000; ++a)\n"
        "      for (int b = 0; b < 1000000000; ++b) position.x = position.x * 0.999 + uv.x;\n");
  compile("wrong.glsl");
  const std::string arguments =
      "audit --shader my.spv quad-cube quad-torus --depth 1 --level quick --timeout 100 --json r.json ";
  (void)signalled(arguments, "[ \"$(wc -l < r.jsonl)\" -ge 2 ]", "KILL");  // quad-torus has no end
  const std::string pragmas = read("my.spv.pragmas");
  for (const char* other : {"my.spv.pragmas", "my.PASS.spv"}) {
    write("my.spv.pragmas", pragmas);
    write(other, pragmas + "// another\n");
    EXPECT_TRUE(says(run(arguments + "--resume", 2).err, "of another plan")) << other;
  }
}

TEST_F(SpirvDoor, WhatCannotBeRunIsRefusedWithAWord) {
  const auto refused = [&](const char* what) {
    const Outcome o = run("audit --shader my.spv quad-torus --depth 1", 2);
    EXPECT_TRUE(says(o.err, what)) << o.err;
  };
  refused("my.spv.pragmas");  // is not there
  write("my.spv.pragmas", "#pragma limitcheck points refined\n");
  refused("one scheme");
  write("my.spv.pragmas", "#pragma limitcheck scheme loop\n");
  refused("my.spv");  // is not there
  write("my.spv", "void main() {}\n");
  refused("no module of SPIR-V");
  plant("passes.glsl", "#pragma limitcheck buffer 3", "//");
  compile("wrong.glsl", kPasses);
  refused("binding 3");
  setenv("VK_ICD_FILENAMES", "/nothing.json", 1);
  compile((kTemplates / "function.glsl").string());
  refused("no Vulkan here");
  EXPECT_TRUE(says(run("shader " + (kTemplates / "tessellation.glsl").string(), 2).err, "OpenGL alone"));
}

}  // namespace
}  // namespace limitcheck::cli
