// SPDX-License-Identifier: MIT
// Subjects that behave on the mesh they are given and misbehave on what the audit makes of it: the row that
// asked says so, with the input; every other row, and the next mesh, is what it would have been.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

using nlohmann::json;
using Statuses = std::map<std::string, std::string>;

class RelationBreakdown : public CommandTest {
 protected:
  json audit(const std::string& options, const std::string& limits = "") const {
    const Outcome o = run("audit '" LIMITCHECK_TEST_SUBJECTS
                          "/hostile.so' octahedron tetrahedron --depth 1 "
                          "--json - --options " +
                          options + " " + limits);
    EXPECT_EQ(o.code, options == "do=nothing" ? 0 : 1) << options << "\n" << o.out << o.err;
    const json report = json::parse(o.out, nullptr, false);
    EXPECT_FALSE(report.is_discarded()) << o.out;
    return report;
  }
  static Statuses statuses(const json& report, const std::string& mesh) {
    Statuses all;
    for (const json& r : report["results"])
      if (r["mesh"] == mesh) all[r["check"]] = r["status"];
    return all;
  }
  static std::string message(const json& report, const std::string& check) {
    for (const json& r : report["results"])
      if (r["mesh"] == "octahedron" && r["check"] == check)
        return r["message"].is_null() ? "" : r["message"].get<std::string>();
    return "no row";
  }
};

struct Case {
  const char* name;
  const char* options;
  const char* check;  // the only row that is other than without fault
  const char* status;
  const char* words;  // in its message
  const char* limits = "";
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class Misbehaves : public RelationBreakdown, public testing::WithParamInterface<Case> {};

TEST_P(Misbehaves, ItIsTheRowThatAskedAndNoOther) {
  const Case& c = GetParam();
  static const json good = audit("do=nothing");
  Statuses expected = statuses(good, "octahedron");
  ASSERT_GE(expected.size(), 25U) << "checks and relations";
  for (const auto& [check, status] : expected) EXPECT_NE(status, "not-run") << check;

  const json report = audit(c.options, c.limits);
  expected[c.check] = c.status;
  if (std::string(c.check) == "determinism") expected["state"] = "not-run";  // one cause, one finding
  EXPECT_EQ(statuses(report, "octahedron"), expected) << message(report, c.check);
  Statuses other = statuses(good, "tetrahedron");
  if (std::string(c.check) == "rejected-inputs") other[c.check] = c.status;  // the same broken meshes
  EXPECT_EQ(statuses(report, "tetrahedron"), other);
  const std::string told = message(report, c.check);
  EXPECT_NE(told.find(c.words), std::string::npos) << told;

  // A process that breaks down leaves its input and the command that does it again.
  if (std::string(c.status) != "crash" && std::string(c.status) != "timeout") return;
  const std::string key = "again with: limitcheck ";
  const std::size_t place = told.find(key);
  ASSERT_NE(place, std::string::npos) << told;
  const std::string rest = told.substr(place + key.size());
  const Outcome again = run(rest.substr(0, rest.find(" / ")) + " --level quick --json -");
  EXPECT_EQ(again.code, 1) << told << again.err;
  const json repeated = json::parse(again.out, nullptr, false);
  ASSERT_FALSE(repeated.is_discarded()) << again.out;
  EXPECT_EQ(repeated["results"][0]["status"], c.status) << repeated["results"][0];
}

INSTANTIATE_TEST_SUITE_P(
    InOneRequest, Misbehaves,
    testing::Values(
        Case{"dies_on_the_mirrored_mesh", "do=segfault,on=mirrored", "mirror", "crash", "mirrored: "},
        Case{"dies_at_the_end_of_the_mirrored_mesh", "do=destroy,on=mirrored", "mirror", "crash",
             "killed by SIGABRT"},
        Case{"hangs_on_a_line", "do=sleep,on=line", "degenerate-geometry", "timeout",
             "with all control points on a line: ", "--timeout 2"},
        Case{"hangs_on_a_point", "do=spin,on=point", "degenerate-geometry", "timeout",
             "with all control points at the same place: ", "--timeout 2"},
        Case{"takes_all_memory_on_the_large_mesh", "do=memory,on=large", "scaling", "crash",
             "times 2^10: ", "--memory 500"},
        Case{"delivers_garbage_counts_when_mirrored", "do=garbage_counts,on=mirrored", "mirror", "finding",
             "mirrored: vertex_count is 6510615555426900570"},
        Case{"delivers_garbage_counts_the_second_time", "do=garbage_counts,on=second", "determinism",
             "finding", "vertex_count is 6510615555426900570"},
        Case{"delivers_garbage_counts_after_another_mesh", "do=garbage_counts,on=another", "state", "finding",
             "after another mesh and its look-alikes: vertex_count is 6510615555426900570"},
        Case{"fails_on_a_line", "do=throw,on=line", "degenerate-geometry", "error", "out of luck"},
        Case{"writes_behind_its_memory_when_mirrored", "do=write_behind,on=mirrored", "mirror", "finding",
             "mirrored: positions written outside its memory"},
        Case{"dies_of_a_broken_mesh", "do=segfault,on=broken", "rejected-inputs", "crash",
             "an edge with three faces: "},
        Case{"hangs_on_a_broken_mesh", "do=sleep,on=broken", "rejected-inputs", "timeout",
             "an edge with three faces: ", "--timeout 1"}),
    [](const auto& of) { return std::string(of.param.name); });

// They would die of the first broken mesh, and are not handed any if they say so.
class DoesNotValidate : public RelationBreakdown {
 protected:
  void expect_not_asked(const std::string& subject) const {
    const Outcome o = run("audit " + subject + " octahedron --depth 1 --junit report.xml --json report.json");
    EXPECT_EQ(o.code, 0) << o.out << o.err;
    EXPECT_NE(o.out.find("rejected-inputs of "), std::string::npos) << o.out;
    EXPECT_NE(o.out.find(" were never judged: not asked: does not validate\n"), std::string::npos) << o.out;
    const json report = json::parse(read("report.json"), nullptr, false);
    EXPECT_EQ(statuses(report, "octahedron")["rejected-inputs"], "not-supported");
    EXPECT_EQ(message(report, "rejected-inputs"), "not asked: does not validate");
    EXPECT_EQ(report["never_judged"][0]["reason"], "not asked: does not validate") << report["never_judged"];
    const std::string junit = read("report.xml");
    const std::size_t row = junit.find("name=\"rejected-inputs\"");
    ASSERT_NE(row, std::string::npos);
    EXPECT_NE(junit.substr(row, 200).find("<skipped message=\"not-supported: "), std::string::npos);
    EXPECT_NE(junit.substr(row, 200).find("not asked: does not validate"), std::string::npos);

    write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n");
    const Outcome refuse = run("audit " + subject + " broken.obj --must-refuse --details");
    EXPECT_EQ(refuse.code, 2) << "nothing was looked at\n" << refuse.out << refuse.err;
    EXPECT_NE(refuse.out.find("does not validate"), std::string::npos) << refuse.out;
  }
};

TEST_F(DoesNotValidate, ALibraryIsNotHandedBrokenMeshes) {
  const std::string hostile = "'" LIMITCHECK_TEST_SUBJECTS "/hostile.so' --options do=segfault,on=broken";
  expect_not_asked(hostile + ",validates=no");
  EXPECT_EQ(run("audit " + hostile + " octahedron --depth 1").code, 1) << "one that validates is";
}

TEST_F(DoesNotValidate, AProgramIsNotHandedBrokenMeshes) {
  std::ifstream in(LIMITCHECK_SOURCE_DIR "/verify/subject/examples/python/loop.py");
  std::string code{std::istreambuf_iterator<char>(in), {}};
  const auto change = [&](const std::string& from, const std::string& to) {
    const std::size_t place = code.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    code.replace(place, from.size(), to);
  };
  change("write({\"status\": \"invalid-input\", \"message\": str(refusal)})", "__import__('os').abort()");
  write("dies.py", code);
  change("\"exact_lattice\": True", "\"exact_lattice\": True, \"does_not_validate\": True");
  write("says_so.py", code);
  expect_not_asked("--program 'python3 says_so.py'");
  EXPECT_EQ(run("audit --program 'python3 dies.py' octahedron --depth 1").code, 1) << "one that validates is";
}

}  // namespace
}  // namespace limitcheck::cli
