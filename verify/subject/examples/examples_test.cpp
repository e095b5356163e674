// SPDX-License-Identifier: MIT
// The way of a new user: install to a prefix, build the examples outside the tree against it, audit them.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/package/installed_test.h"
#include "verify/subject/subject.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kExamples = fs::path(LIMITCHECK_SOURCE_DIR) / "verify/subject/examples";

// Every valence class inside, and boundary vertices with 1 to 5 faces.
constexpr const char* kMeshes = "icosahedron octahedron torus holes fan:5 wheel:3 wheel:13:2 two-components";

// Quads: regular, of other valences inside, boundary vertices of 1 to 5 faces.
constexpr const char* kQuads = "quad-cube quad-torus quad-wheel:7 quad-fan:1 quad-fan:5";
constexpr const char* kPolygons = "prism:3 prism:5 mixed:1:40 dual:bumpy:20";

class Examples : public InstalledTest {
 protected:
  /// Held; only bits may depend on the order of the faces.
  static void expect_no_fault(const json& row) {
    const bool order =
        row["check"] == "face-order" || row["check"] == "vertex-order" || row["check"] == "corner-rotation";
    EXPECT_TRUE(row["status"] == "held" || (order && row["status"] == "quality-warning")) << row;
  }
  /// Every check on every mesh.
  static void expect_all_held(const Outcome& o, std::size_t rows) {
    const json report = json::parse(o.out, nullptr, false);
    ASSERT_FALSE(report.is_discarded()) << o.out << o.err;
    EXPECT_GE(report["results"].size(), rows);
    for (const json& row : report["results"]) expect_no_fault(row);
    EXPECT_EQ(o.code, 0) << o.err;
  }
  /// Of what delivers no limit points: no check finds a fault, and the points of all meshes are judged.
  static void expect_refined_points_held(const Outcome& o, std::size_t meshes) {
    ASSERT_EQ(o.code, 0) << o.out << o.err;
    std::size_t judged = 0;
    const json report = json::parse(o.out);
    for (const json& row : report["results"]) {
      if (row["status"] != "not-supported") expect_no_fault(row);
      judged += row["check"] == "refined-positions" && row["status"] == "held";
    }
    EXPECT_EQ(judged, meshes);
  }
  /// What a library answers the host of 0.2.0, which had 52 bytes for its capabilities. It writes nothing behind them.
  lc_status answer_to_an_older_host(const std::string& library) const {
    alignas(lc_capabilities) std::array<std::uint8_t, sizeof(lc_capabilities)> bytes;
    std::fill(std::fill_n(bytes.begin(), 52, std::uint8_t{0}), bytes.end(), std::uint8_t{0xA5});
    auto* known = reinterpret_cast<lc_capabilities*>(bytes.data());
    known->size = 52;
    void* loaded = dlopen((folder_ / library).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (loaded == nullptr) return ADD_FAILURE() << dlerror(), LC_FAILED;
    const auto get = reinterpret_cast<decltype(&lc_subject_get)>(dlsym(loaded, LC_SUBJECT_ENTRY));
    const char* message = nullptr;
    const lc_status status = get(LC_SUBJECT_ABI)->capabilities(nullptr, known, &message);
    dlclose(loaded);
    EXPECT_TRUE(std::all_of(bytes.begin() + 52, bytes.end(), [](int b) { return b == 0xA5; })) << library;
    return status;
  }
};

TEST_F(Examples, InCAndInCppBuildAgainstTheInstalledPackageAndPassTheAudit) {
  install();
  for (const char* file : {"prefix/bin/limitcheck", "prefix/include/limitcheck/subject.h"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  EXPECT_TRUE(shell("prefix/bin/limitcheck --version").out.starts_with("limitcheck " LIMITCHECK_VERSION));
  for (const std::string language : {"c", "cpp"}) {
    build(kExamples / language, language);
    expect_all_held(
        shell("prefix/bin/limitcheck audit " + language + "/libloop.so --depth 2 --json - " + kMeshes),
        25U * 8U);
  }
  expect_refined_points_held(
      shell(std::string("prefix/bin/limitcheck audit c/libquads.so --depth 3 --json - ") + kQuads), 5U);
  // Of other faces it says that it does not do them: nothing is judged, and nothing is a finding.
  EXPECT_TRUE(
      says(shell("prefix/bin/limitcheck audit c/libquads.so prism:5 --depth 1", 2).out, "does quads alone"));
  for (const char* library : {"c/libloop.so", "cpp/libloop.so"})
    EXPECT_EQ(answer_to_an_older_host(library), LC_NOT_SUPPORTED) << "no_provenance came later";
  EXPECT_EQ(answer_to_an_older_host("c/libquads.so"), LC_OK);
}

// 5/8 in a(n) becomes 0.626. On the octahedron, +-unit vectors of valence 4, the limit of a vertex v is
// 3 v / (3 + 8 a(4)), a(4) = 5/8 - 9/64 = 31/64: 24/55 v. At depth 0 nothing else enters.
TEST_F(Examples, InCWithOneWeightChangedIsCaughtWithTheRightWitness) {
  install();
  fs::create_directories(folder_ / "wrong");
  for (const char* file : {"CMakeLists.txt", "loop.h", "quads.c", "subject.c"})
    fs::copy(kExamples / "c" / file, folder_ / "wrong");
  std::string code = contents_of(kExamples / "c/loop.c");
  const std::size_t place = code.find("5.0 / 8");
  ASSERT_NE(place, std::string::npos);
  write("wrong/loop.c", code.replace(place, 7, "0.626"));
  build(folder_ / "wrong", "wrong/build");

  const Outcome o =
      shell("prefix/bin/limitcheck audit wrong/build/libloop.so octahedron --depth 0 --json -", 1);
  const json report = json::parse(o.out);
  const double right = 24.0 / 55, wrong = 3 / (3 + 8 * (0.626 - 9.0 / 64));
  for (const json& row : report["results"]) {
    if (row["check"] != "positions") expect_no_fault(row);
    if (row["check"] != "positions") continue;
    EXPECT_EQ(row["status"], "finding") << row;
    EXPECT_EQ(row["count"], 6);
    EXPECT_NEAR(row["worst_absolute"].get<double>(), right - wrong, 1e-15);
    const json& w = row["witness"];
    double expected = 0, got = 0;
    for (int axis = 0; axis < 3; ++axis) {
      expected += std::abs(w["expected"][axis].get<double>());
      got += std::abs(w["got"][axis].get<double>());
    }
    EXPECT_NEAR(expected, right, 1e-15) << w;
    EXPECT_NEAR(got, wrong, 1e-15) << w;
    // The same from the calculator.
    const Outcome e =
        shell("prefix/bin/limitcheck eval octahedron " + std::to_string(w["face"].get<int>()) + " " +
                  w["l1"].get<std::string>() + " " + w["l2"].get<std::string>() + " --json",
              0);
    const json position = json::parse(e.out)["position"];
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(std::stod(position[axis].get<std::string>()), w["expected"][axis].get<double>(), 1e-15);
    }
  }

  // One cause, also where meshes without regular faces are among those that have some.
  const Outcome all = shell(
      "prefix/bin/limitcheck audit wrong/build/libloop.so tetrahedron octahedron icosahedron "
      "bumpy:200 holes --depth 2 --json -",
      1);
  const json causes = json::parse(all.out)["causes"];
  EXPECT_EQ(causes.size(), 1U) << causes;
}

// The same in the other languages.
TEST_F(Examples, InEveryLanguageOneWeightChangedIsCaught) {
  install();
  const auto changed = [&](const std::string& folder, const std::string& file, const std::string& right) {
    fs::copy(kExamples / folder, folder_ / folder, fs::copy_options::recursive);
    std::string code = contents_of(kExamples / folder / file);
    const std::size_t place = code.find(right);
    ASSERT_NE(place, std::string::npos) << file;
    write(folder + "/" + file, code.replace(place, right.size(), "0.626"));
  };
  changed("cpp", "loop.h", "5.0 / 8");
  build(folder_ / "cpp", "cpp/build");
  changed("python", "loop.py", "5 / 8");
  std::vector<std::string> commands{"prefix/bin/limitcheck audit cpp/build/libloop.so",
                                    "prefix/bin/limitcheck audit --program 'python3 python/loop.py'"};
  if (std::system("node --version > /dev/null 2>&1") == 0) {
    changed("node", "loop.mjs", "5 / 8");
    commands.emplace_back("LIMITCHECK_PROGRAM=prefix/bin/limitcheck node node/geometry.mjs");
  }
  for (const std::string& command : commands) {
    const Outcome o = shell(command + " octahedron --depth 1 --level quick --json -", 1);
    bool found = false;
    const json report = json::parse(o.out);
    for (const json& row : report["results"])
      found |=
          row["status"] == "finding" && (row["check"] == "positions" || row["check"] == "refined-positions");
    EXPECT_TRUE(found) << command;
  }
}

TEST_F(Examples, InPythonPassesTheAudit) {
  const std::string audit =
      "audit --program \"python3 '" + (kExamples / "python/loop.py").string() + "'\" --timeout 300 --json - ";
  expect_all_held(run(audit + "--depth 2 --level quick " + kMeshes), 12U * 8U);
  expect_all_held(run(audit + "--depth 1 octahedron fan:2"), 25U * 2U);
}

// The arrays of the library in C, through Python.
TEST_F(Examples, InPythonOverTheCInterfacePassesTheAudit) {
  install();
  build(kExamples / "c", "c");
  const std::string script = (kExamples / "python/over_c.py").string();
  // Behind a structure that is smaller than its own, a library may write.
  std::string sizes;
  for (const std::size_t s : {sizeof(lc_capabilities), sizeof(lc_mesh), sizeof(lc_request),
                              sizeof(lc_tessellation), sizeof(lc_subject)})
    sizes += std::to_string(s) + "\n";
  const std::string folder = (kExamples / "python").string();
  EXPECT_EQ(
      shell("python3 -B -c \"import ctypes, sys; sys.path.append('" + folder +
                "'); sys.argv = ['', 'c/libloop.so']; import over_c as o; print(*map(ctypes.sizeof, "
                "(o.Capabilities, o.Mesh, o.Request, o.Tessellation, o.Subject)), sep='\\n')\" < /dev/null",
            0)
          .out,
      sizes);
  expect_all_held(shell("prefix/bin/limitcheck audit --program \"python3 '" + script +
                        "' c/libloop.so\" icosahedron holes fan:5 --depth 2 --level quick --json -"),
                  12U * 3U);
}

// It does not validate, says so, and would crash.
TEST_F(Examples, OfMatricesPassesTheAuditAndIsNotHandedBrokenMeshes) {
  install();
  const std::string audit = "/libmatrices.so octahedron holes fan:5 wheel:13:2 --depth 2 --json -";
  build(kExamples / "matrices", "matrices");
  const Outcome o = shell("prefix/bin/limitcheck audit matrices" + audit);
  expect_refined_points_held(o, 4U);
  EXPECT_TRUE(says(o.out, "not asked: does not validate"));

  fs::create_directories(folder_ / "silent");
  for (const char* file : {"CMakeLists.txt", "loop.h"})
    fs::copy(kExamples / "matrices" / file, folder_ / "silent");
  std::ifstream in(kExamples / "matrices/subject.cpp");
  std::string code{std::istreambuf_iterator<char>(in), {}};
  const std::size_t place = code.find("does_not_validate = 1");
  ASSERT_NE(place, std::string::npos);
  write("silent/subject.cpp", code.replace(place, 21, "does_not_validate = 0"));
  build(folder_ / "silent", "silent/build");
  const Outcome crash = shell("prefix/bin/limitcheck audit silent/build" + audit, 1);
  EXPECT_TRUE(says(crash.out, "\"status\": \"crash\""));
}

TEST_F(Examples, InJavaScriptPassesTheAudit) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "node is not installed";
  expect_refined_points_held(
      shell("LIMITCHECK_PROGRAM='" LIMITCHECK_PROGRAM "' node '" +
            (kExamples / "node/geometry.mjs").string() + "' octahedron fan:5 wheel:13:2 --depth 2 --json -"),
      3U);
  // What is no mesh, or no function's result.
  write("wrong.mjs", "import { audit } from '" + (kExamples / "node/index.mjs").string() +
                         "';\naudit('wrong', () => ({ points: [] }));\n");
  const Outcome wrong =
      shell("LIMITCHECK_PROGRAM='" LIMITCHECK_PROGRAM "' node wrong.mjs octahedron --json -", 1);
  EXPECT_TRUE(says(wrong.out, "the function has to return { position, index } or { position, faces }"));
  EXPECT_TRUE(
      says(shell("LIMITCHECK_PROGRAM=/nowhere node wrong.mjs", 2).err, "there is no program /nowhere"));
}

TEST_F(Examples, InPythonOfQuadsAndPolygonsPassesTheAudit) {
  const std::string audit = "audit --program \"python3 '" + (kExamples / "python/quads.py").string() +
                            "'\" --timeout 300 --json - ";
  expect_refined_points_held(run(audit + "--depth 2 --level quick " + kQuads + " " + kPolygons), 9U);
  expect_refined_points_held(run(audit + "--depth 0 --level quick prism:3 prism:5 dual:bumpy:20"), 3U);
  expect_refined_points_held(run(audit + "--depth 1 quad-cube prism:5"), 2U);
}

}  // namespace
}  // namespace limitcheck::cli
