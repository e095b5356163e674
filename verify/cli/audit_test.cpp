// SPDX-License-Identifier: MIT
// `limitcheck audit` as a user meets it: exit codes, what goes where, and the command it prints for a
// witness.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out, err;
};

class AuditCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("limitcheck-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs the program in a folder of its own.
  Outcome run(const std::string& arguments) const {
    Outcome outcome;
    const std::string command =
        "cd '" + folder_.string() + "' && '" LIMITCHECK_PROGRAM "' " + arguments + " 2> stderr.txt";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), [](FILE*) { return 0; });
    for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
      outcome.out += static_cast<char>(c);
    const int status = pclose(pipe.get());
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.err = read("stderr.txt");
    return outcome;
  }
  std::string read(const fs::path& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
};

TEST_F(AuditCommand, ExitsWithZeroWhenAllHeld) {
  const Outcome o = run("audit opensubdiv-far tetrahedron --depth 2 --option precision=double");
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_NE(o.out.find("opensubdiv-far:precision=double"), std::string::npos);
  EXPECT_EQ(o.err, "") << "no progress unless standard error is a terminal";
  EXPECT_EQ(o.out.find('\033'), std::string::npos) << "no colour unless standard output is a terminal";
}

TEST_F(AuditCommand, ExitsWithOneOnFindings) {
  const Outcome o = run("audit opensubdiv-bfr bumpy:20 --depth 2");
  EXPECT_EQ(o.code, 1) << o.out << o.err;
  EXPECT_NE(o.out.find("FINDING"), std::string::npos);
}

TEST_F(AuditCommand, ExitsWithTwoOnBadUsageAndBadInput) {
  for (const char* arguments :
       {"audit no-such-subject", "audit naive no-such-mesh", "audit naive tetrahedron --depth 99",
        "audit naive tetrahedron --no-such-option", "audit naive --option nonsense=1 tetrahedron",
        "audit all tetrahedron --option precision=double", "audit naive tetrahedron --json report.txt"}) {
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << arguments << "\n" << o.out;
    EXPECT_NE(o.err, "") << arguments;
  }
}

TEST_F(AuditCommand, JsonOnStandardOutputIsOneDocumentAndNothingElse) {
  const Outcome o = run("audit opensubdiv-bfr bumpy:20 --depth 2 --json -");
  EXPECT_EQ(o.code, 1) << o.err;
  const auto json = nlohmann::json::parse(o.out);  // throws on anything but one document
  EXPECT_EQ(json["depth"], 2);
  ASSERT_FALSE(json["results"].empty());
  for (const auto& row : json["results"])
    for (const char* key :
         {"subject", "mesh", "check", "status", "count", "worst", "bound", "unit", "witness"})
      EXPECT_TRUE(row.contains(key)) << key;
}

TEST_F(AuditCommand, JsonGoesToAFileBesideTheTable) {
  const Outcome o =
      run("audit opensubdiv-far tetrahedron --depth 1 --option precision=double --json out/report.json");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("positions"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(read("out/report.json"))["held"], true);
}

TEST_F(AuditCommand, AnAuditOfAllSubjectsGoesOnWhenOneRefuses) {
  const Outcome o = run("audit all wheel:50:1 --depth 1 --json -");  // OpenMesh ends at valence 49
  EXPECT_EQ(o.code, 1) << o.err;
  bool refused = false, cgal = false;
  const auto report = nlohmann::json::parse(o.out);
  for (const auto& row : report["results"]) {
    refused = refused ||
              (row["subject"] == "openmesh" && row["check"] == "tessellates" && row["status"] == "finding");
    cgal = cgal || (row["subject"] == "cgal" && row["check"] == "coverage" && row["status"] == "held");
  }
  EXPECT_TRUE(refused);
  EXPECT_TRUE(cgal);
}

// The subject is given in double, so the expected value is that of the mesh as it is.
TEST_F(AuditCommand, TheCommandPrintedWithAFindingRecomputesTheExpectedValue) {
  const Outcome o =
      run("audit opensubdiv-bfr bumpy:20 --depth 3 --option precision=double --json report.json");
  ASSERT_EQ(o.code, 1) << o.err;
  const auto report = nlohmann::json::parse(read("report.json"));
  bool looked = false;
  for (const auto& row : report["results"]) {
    if (row["check"] != "positions") continue;
    looked = true;
    const auto& w = row["witness"];
    const std::string command = "eval bumpy:20 " + std::to_string(w["face"].get<int>()) + " " +
                                w["l1"].get<std::string>() + " " + w["l2"].get<std::string>();
    EXPECT_NE(o.out.find("limitcheck " + command + "\n"), std::string::npos) << command << "\n" << o.out;
    const Outcome e = run(command + " --json");
    ASSERT_EQ(e.code, 0) << e.err;
    const auto position = nlohmann::json::parse(e.out)["position"];
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(std::strtod(position[axis].get<std::string>().c_str(), nullptr),
                  w["expected"][axis].get<double>(), 1e-14);
  }
  EXPECT_TRUE(looked);
}

}  // namespace
