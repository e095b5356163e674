// SPDX-License-Identifier: MIT
// What `cmake --install` gives to other projects: it builds there, with nothing more than it needs.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "verify/package/installed_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

const fs::path kConsumers = fs::path(LIMITCHECK_SOURCE_DIR) / "verify/package/test_package";

using Package = InstalledTest;
using DebianPackage = InstalledTest;

// A machine that has none of the libraries that are judged; and a project with folders named like ours.
TEST_F(Package, FastNeedsNoCgalNoOpenSubdivNoOpenMeshNoFlint) {
  install();
  fs::copy(kConsumers / "fast", folder_ / "project");
  for (const char* own : {"project/data", "project/fast"}) fs::create_directories(folder_ / own);
  for (const char* own : {"project/data/control_mesh.h", "project/fast/frame.h", "project/fast/vec3.h"})
    write(own, "#error \"the project's own header was included\"\n");
  build(folder_ / "project", "build",
        "-DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenSubdiv=ON "
        "-DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON "
        "-DCMAKE_DISABLE_FIND_PACKAGE_Boost=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON");

  // An octahedron at depth 3: 8 x 4^3 triangles, by Euler half as many vertices and 2. Its corners' limit is
  // 24/55 of the way out (valence 4: 3 / (3 + 8 a(4)), a(4) = 31/64).
  const Outcome o = shell("build/tessellate", 0);
  EXPECT_TRUE(says(o.out, "uniform: 8 faces, 512 triangles, 258 vertices, 0 fans\n"));
  const std::size_t corner = o.out.find("corner: ");
  ASSERT_NE(corner, std::string::npos) << o.out;
  double x = 0, y = 0, z = 0;
  ASSERT_EQ(std::sscanf(o.out.c_str() + corner, "corner: %lf %lf %lf", &x, &y, &z), 3) << o.out;
  EXPECT_NEAR(std::abs(x) + std::abs(y) + std::abs(z), 24.0 / 55, 1e-7) << o.out;

  const std::string libraries = shell("ldd build/tessellate").out;
  EXPECT_TRUE(says(libraries, "libtbb"));
  for (const char* foreign : {"CGAL", "osd", "OpenMesh", "flint", "mpfr", "gmp", "tinygltf"})
    EXPECT_FALSE(says(libraries, foreign));
  EXPECT_EQ(shell("build/tessellate absent.obj").code, 2);
}

// What was written for 0.1 finds its headers where they lay then.
TEST_F(Package, ThePathsOfTheFirstReleaseLeadToTheHeaders) {
  install();
  write("first.cpp",
        "#include <limitcheck/fast/frame.h>\n#include <limitcheck/fast/row_stream/stream_frame.h>\n"
        "#include <limitcheck/reference/certified.h>\n#include <limitcheck/reference/naive.h>\n"
        "#include <limitcheck/reference/stam.h>\n"
        "limitcheck::fast::TessellatorOptions options;\n"
        "limitcheck::fast::row_stream::StreamTessellator* stream;\n"
        "limitcheck::fast::Tessellator<float>* window;\n"
        "limitcheck::reference::CertifiedEvaluator* certified;\n"
        "limitcheck::reference::StamEvaluator<double>* stam;\n"
        "limitcheck::reference::NaiveSubdivider<double>* naive;\n");
  const Outcome o = shell("'" LIMITCHECK_CXX "' -std=c++20 -fsyntax-only -Iprefix/include first.cpp", 0);
}

// data/known_answers.json, exact_tetrahedron: found by rational arithmetic outside this project.
TEST_F(Package, ReferenceGivesTheKnownAnswer) {
  install();
  build(kConsumers / "reference", "build",
        "-DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenSubdiv=ON "
        "-DCMAKE_DISABLE_FIND_PACKAGE_OpenMesh=ON -DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON");
  const Outcome o = shell("build/true_point", 0);
  EXPECT_TRUE(says(o.out,
                   "certified: 0.149691358024691358024691358025 0.149691358024691358024691358025 "
                   "-0.149691358024691358024691358025 "));
  EXPECT_TRUE(says(o.out, "leaves at depth 3: 64\n"));
}

TEST_F(Package, AnAuditIsATestOfTheProject) {
  install();
  fs::copy(kConsumers / "audit", folder_ / "project");
  for (const char* file : {"subject.c", "loop.c", "loop.h"})
    fs::copy(fs::path(LIMITCHECK_SOURCE_DIR) / "verify/subject/examples/c" / file,
             folder_ / "project" / file);
  build(folder_ / "project", "build");
  const Outcome right = shell("cd build && ctest --verbose", 0);
  EXPECT_TRUE(says(right.out, "audit_loop"));
  EXPECT_TRUE(says(right.out, " 0 findings"));
  // With another weight than 5/8 it fails.
  const std::string loop = read("project/loop.c");
  ASSERT_NE(loop.find("5.0 / 8 -"), std::string::npos);
  write("project/loop.c", std::string(loop).replace(loop.find("5.0 / 8 -"), 3, "4.9"));
  shell("'" LIMITCHECK_CMAKE "' --build build", 0);
  EXPECT_TRUE(says(shell("cd build && ctest --verbose", 8).out, "root cause"));
}

TEST_F(Package, EveryHeaderCompilesByItself) {
  install();
  int headers = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "prefix/include")) {
    if (entry.path().extension() != ".h") continue;
    ++headers;
    const std::string name = entry.path().lexically_relative(folder_ / "prefix/include");
    write("alone.cpp", "#include <" + name + ">\n#include <" + name + ">\n");
    const Outcome o =
        shell("'" LIMITCHECK_CXX
              "' -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Werror -Iprefix/include "
              "alone.cpp");
    EXPECT_EQ(o.code, 0) << name << "\n" << o.err;
    // All names of ours lie in limitcheck/.
    EXPECT_TRUE(name.starts_with("limitcheck/")) << name;
    const std::string text = read(entry.path());
    for (const char* folder : {"data/", "reference/", "fast/", "verify/"})
      EXPECT_FALSE(says(text, "#include \"" + std::string(folder))) << name;
  }
  EXPECT_GT(headers, 30);
}

class Components : public InstalledTest {
 protected:
  Outcome find(const std::string& arguments, const std::string& without, const std::string& then = "") const {
    fs::remove_all(folder_ / "build");
    fs::create_directories(folder_ / "project");
    write("project/CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.16)\nproject(p LANGUAGES CXX)\n"
          "find_package(limitcheck 0.1 " +
              arguments + ")\n" + then);
    return configure("project", "build", "-DCMAKE_DISABLE_FIND_PACKAGE_" + without + "=ON");
  }
};

TEST_F(Components, ThatCannotBeHadAreRefusedWithWhatTheyLack) {
  install();
  Outcome o = find("REQUIRED COMPONENTS fast", "hwy");
  EXPECT_NE(o.code, 0);
  EXPECT_TRUE(says(o.err, "component fast needs hwy"));
  o = find("REQUIRED COMPONENTS faster", "hwy");
  EXPECT_NE(o.code, 0);
  EXPECT_TRUE(says(o.err, "there is no component 'faster'"));
  // The others do not miss it.
  o = find("REQUIRED COMPONENTS subject reference", "hwy",
           "if(NOT TARGET limitcheck::reference OR TARGET limitcheck::fast)\nmessage(FATAL_ERROR "
           "wrong)\nendif()\n");
  EXPECT_EQ(o.code, 0) << o.err;
}

TEST_F(Components, AreAllThatCanBeHadWhereNoneIsNamed) {
  install();
  const std::string check =
      "if(NOT TARGET limitcheck::subject OR NOT TARGET limitcheck::reference OR TARGET limitcheck::fast)\n"
      "message(FATAL_ERROR wrong)\nendif()\n";
  const Outcome o = find("REQUIRED", "hwy", check);
  EXPECT_EQ(o.code, 0) << o.err;
}

// As they come out of `cpack`; unpacked, not installed, so that the test needs no rights.
TEST_F(DebianPackage, OfTheProgramRunsAndSaysItsLicence) {
  const Outcome made = shell("cpack --config '" LIMITCHECK_BINARY_DIR "/CPackConfig.cmake' -B .", 0);
  const std::string depends = shell("dpkg-deb -f limitcheck_*.deb Depends").out;
  for (const char* needed : {"libtbb12", "libosdcpu3.5.0", "libflint-arb2", "libc6"})
    EXPECT_TRUE(says(depends, needed));
  EXPECT_FALSE(says(depends, "-dev"));
  EXPECT_FALSE(says(shell("dpkg-deb -f limitcheck_*.deb Maintainer").out, "nobody"));

  ASSERT_EQ(shell("dpkg-deb -x limitcheck_*.deb root").code, 0);
  const std::string version = shell("root/usr/bin/limitcheck --version").out;
  EXPECT_TRUE(version.starts_with("limitcheck " LIMITCHECK_VERSION)) << version;
  for (const char* file : {"libexec/limitcheck/limitcheck-keeper", "libexec/limitcheck/limitcheck-worker",
                           "share/man/man1/limitcheck.1.gz", "share/bash-completion/completions/limitcheck",
                           "share/doc/limitcheck/changelog.gz"})
    EXPECT_TRUE(fs::exists(folder_ / "root/usr" / file)) << file;
  EXPECT_FALSE(fs::exists(folder_ / "root/usr/include"));
  const std::string copyright = read("root/usr/share/doc/limitcheck/copyright");
  ASSERT_TRUE(says(copyright, "Files: usr/bin/limitcheck\n"));
  EXPECT_TRUE(says(copyright.substr(copyright.find("Files: usr/bin/limitcheck\n")), "License: GPL-3+\n"));

  if (fs::exists(LIMITCHECK_BINARY_DIR "/python/limitcheck/_core.pyi")) {
    ASSERT_EQ(shell("dpkg-deb -x python3-limitcheck_*.deb python").code, 0);
    EXPECT_TRUE(says(shell("dpkg-deb -f python3-limitcheck_*.deb Depends").out,
                     "limitcheck, python3, python3-numpy"));
    const Outcome o = shell(
        "PATH=$PWD/root/usr/bin:$PATH PYTHONPATH=python/usr/lib/python3/dist-packages /usr/bin/python3 -P -c "
        "'import limitcheck; print(limitcheck.__file__, limitcheck.audit(\"naive\", [\"octahedron\"], "
        "depth=1).held)'");
    EXPECT_TRUE(says(o.out, "dist-packages/limitcheck/__init__.py True")) << o.err;
  }

  // The libraries: for CMake, and for whoever has pkg-config alone.
  ASSERT_EQ(shell("dpkg-deb -x liblimitcheck-dev_*.deb lib").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "lib/usr/bin"));
  EXPECT_TRUE(fs::exists(folder_ / "lib/usr/share/doc/liblimitcheck-dev/copyright"));
  EXPECT_TRUE(fs::exists(folder_ / "lib/usr/share/doc/liblimitcheck-dev/changelog.gz"));
  const std::string flags =
      "PKG_CONFIG_PATH=$(dirname $(find lib -name limitcheck-fast.pc)) pkg-config "
      "--define-variable=prefix=$PWD/lib/usr --cflags --libs ";
  for (const auto& [library, source] :
       {std::pair{"fast", "fast/tessellate.cpp"}, {"reference", "reference/true_point.cpp"}}) {
    const Outcome o =
        shell(fmt::format("flags=$({}limitcheck-{}) && {} -std=c++20 -fPIE '{}' $flags -o {}", flags, library,
                          LIMITCHECK_CXX, (kConsumers / source).string(), library));
    EXPECT_EQ(o.code, 0) << o.err;
  }
  EXPECT_TRUE(says(shell("./reference").out, "certified: 0.149691358024691358024691358025 "));
}

}  // namespace
}  // namespace limitcheck::cli
