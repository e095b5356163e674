// SPDX-License-Identifier: MIT
// Every status an audit can give really comes out of the program, the same in JSON, JUnit and table, and the
// exit code says whether there is anything to act on.
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;

struct Case {
  const char* status;   // in JSON
  const char* cell;     // in the table
  const char* element;  // of the JUnit test case; "": passed
  const char* subject;  // and everything else on the command line
  const char* check;    // the row that has it
  int code;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.status;
}

constexpr const char* kWaivers = R"({"waivers":[
  {"subject":"opensubdiv-far*","check":"normals","shape":"fan:5","reason":"boundary tangents","expires":"2999-12-31"},
  {"subject":"row-stream","check":"positions","shape":"*","reason":"was off","expires":"2999-12-31"}]})";

class AuditStatus : public CommandTest {
 protected:
  /// What python's XML reader finds in the test case of a check: the name of its element, or "".
  std::string junit_element(const std::string& check) const {
    write("element.py",
          "import sys, xml.etree.ElementTree as et\n"
          "for case in et.parse('junit.xml').getroot().iter('testcase'):\n"
          "  if case.get('name') == sys.argv[1]:\n"
          "    print(''.join(child.tag for child in case), end='')\n"
          "    break\n"
          "else: sys.exit(1)\n");
    const Outcome o = command("/usr/bin/python3 element.py " + check);
    EXPECT_EQ(o.code, 0) << check << " is not in the JUnit file";
    return o.out;
  }
};

class EachStatus : public AuditStatus, public testing::WithParamInterface<Case> {};

TEST_P(EachStatus, IsTheSameInJsonJUnitAndTable) {
  const Case& c = GetParam();
  write("waivers.json", kWaivers);
  write(
      "fail.sh",
      "read q; echo '{\"limitcheck\":1, \"status\":\"ok\", \"precision\":\"float64\", \"weights\":\"loop\", "
      "\"boundary\":\"spline\", \"points\":\"limit\", \"max_depth\":9, \"normals\":true, "
      "\"per_face_depth\":true, \"exact_lattice\":true}'\n"
      "read q; echo '{\"status\":\"failed\", \"message\":\"no luck\"}'\n");
  const Outcome o =
      run(std::string("audit --details ") + c.subject + " --json report.json --junit junit.xml");
  EXPECT_EQ(o.code, c.code) << o.out << o.err;

  const json report = json_in("report.json");
  EXPECT_EQ(report["held"], c.code == 0);
  std::string status = "no row";
  for (const json& row : report["results"])
    if (row["check"] == c.check) status = row["status"];
  EXPECT_EQ(status, c.status) << o.out;

  EXPECT_EQ(junit_element(c.check), c.element);

  std::string line = "no line\n";
  std::istringstream table(o.out);
  for (std::string next; line == "no line\n" && std::getline(table, next);)
    if (next.starts_with("  " + std::string(c.check) + " ")) line = next;
  EXPECT_TRUE(says(line, c.cell));
}

INSTANTIATE_TEST_SUITE_P(
    AsAUserMeetsThem, EachStatus,
    testing::Values(
        Case{"held", "held", "", "row-stream tetrahedron --depth 1 --level quick", "positions", 0},
        Case{"finding", "FINDING", "failure", "opensubdiv-bfr fan:5 --depth 1 --level quick", "normals", 1},
        Case{"quality-warning", "warning", "system-out", "naive fan:5 --depth 1", "face-order", 0},
        Case{"not-supported", "not supported", "skipped", "cgal tetrahedron --depth 1 --level quick",
             "positions", 0},
        Case{"not-run", "not run", "skipped", "--program 'exit 3' tetrahedron --depth 1", "positions", 1},
        Case{"crash", "CRASH", "error", "--program 'kill -SEGV $$' tetrahedron --depth 1", "tessellates", 1},
        Case{"timeout", "TIMEOUT", "error", "--program 'sleep 1000' tetrahedron --timeout 0.3", "tessellates",
             1},
        Case{"error", "ERROR", "error", "--program 'sh fail.sh' tetrahedron", "tessellates", 1},
        Case{"waived", "waived", "skipped",
             "opensubdiv-far:precision=double fan:5 --depth 1 --level quick --waivers waivers.json",
             "normals", 1},
        Case{"unexpected-pass", "STALE WAIVER", "system-out",
             "row-stream tetrahedron --depth 1 --level quick --waivers waivers.json", "positions", 0}),
    [](const auto& of) {
      std::string name = of.param.status;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

// The cells of one row of the matrix that ends an audit of several subjects.
std::string matrix_row(const std::string& table, const std::string& check) {
  const std::size_t matrix = table.rfind("\n  check ");
  const std::size_t row = table.find("\n  " + check + " ", matrix);
  return matrix == std::string::npos || row == std::string::npos
             ? "no such row"
             : table.substr(row + 1, table.find('\n', row + 1) - row - 1);
}

TEST_F(AuditStatus, TheMatrixOfAllSubjectsShowsThemSideBySide) {
  write("waivers.json", kWaivers);
  const Outcome o = run("audit all fan:5 --depth 1 --details --waivers waivers.json");
  EXPECT_EQ(o.code, 1) << o.err;
  const std::string positions = matrix_row(o.out, "positions"), normals = matrix_row(o.out, "normals");
  for (const char* cell : {"STALE WAIVER", "held", "not supported"}) EXPECT_TRUE(says(positions, cell));
  for (const char* cell : {"waived", "FINDING"}) EXPECT_TRUE(says(normals, cell));
  EXPECT_TRUE(says(matrix_row(o.out, "face-order"), "warning"));
}

TEST_F(AuditStatus, TheMatrixShowsBreakdownsOfEverySubjectAndNothingElseIsConfirmed) {
  for (const auto& [limit, cell] : {std::pair{"--timeout 0.001", "TIMEOUT"}, {"--memory 1", "CRASH"}}) {
    const Outcome o =
        run(std::string("audit all tetrahedron --isolate --details --json report.json ") + limit);
    EXPECT_EQ(o.code, 1) << o.err;
    EXPECT_TRUE(says(matrix_row(o.out, "tessellates"), cell));
    EXPECT_FALSE(says(matrix_row(o.out, "tessellates"), "held"));
    const json report = json_in("report.json");
    for (const json& row : report["results"]) {
      EXPECT_NE(row["status"], "held") << row;
    }
  }
}

}  // namespace
}  // namespace limitcheck::cli
