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
    return json_of("audit '" LIMITCHECK_TEST_SUBJECTS
                   "/behaviours_2.so' octahedron tetrahedron --depth 1 --json - --options " +
                       options + " " + limits,
                   options == "behaviour=nothing@create" ? 0 : 1);
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
  static const json good = audit("behaviour=nothing@create");
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
  EXPECT_TRUE(says(told, c.words));

  // A process that breaks down leaves its input and the command that does it again.
  if (std::string(c.status) != "crash" && std::string(c.status) != "timeout") return;
  const std::string key = "again with: limitcheck ";
  const std::size_t place = told.find(key);
  ASSERT_NE(place, std::string::npos) << told;
  const std::string rest = told.substr(place + key.size());
  const json repeated = json_of(rest.substr(0, rest.find(" / ")) + " --level quick --json -", 1);
  EXPECT_EQ(repeated["results"][0]["status"], c.status) << repeated["results"][0];
}

INSTANTIATE_TEST_SUITE_P(
    InOneRequest, Misbehaves,
    testing::Values(Case{"dies_on_the_mirrored_mesh", "behaviour=segfault@tessellate,on=mirrored", "mirror",
                         "crash", "mirrored: "},
                    Case{"hangs_on_a_line", "behaviour=sleep@tessellate,on=line", "degenerate-geometry",
                         "timeout", "with all control points on a line: ", "--timeout 2"},
                    Case{"takes_all_memory_on_the_large_mesh", "behaviour=memory@tessellate,on=large",
                         "scaling", "crash", "times 2^10: ", "--memory 500"},
                    Case{"delivers_garbage_counts_the_second_time",
                         "behaviour=garbage_counts@answer,on=second", "determinism", "finding",
                         "vertex_count is 6510615555426900570"},
                    Case{"delivers_garbage_counts_after_another_mesh",
                         "behaviour=garbage_counts@answer,on=another", "state", "finding",
                         "after another mesh and its look-alikes: vertex_count is 6510615555426900570"},
                    Case{"fails_on_a_line", "behaviour=throw@tessellate,on=line", "degenerate-geometry",
                         "error", "out of luck"},
                    Case{"writes_behind_its_memory_when_mirrored",
                         "behaviour=write_8_behind@answer,on=mirrored", "mirror", "finding",
                         "mirrored: positions written outside its memory"},
                    Case{"dies_of_a_broken_mesh", "behaviour=segfault@create,on=broken", "rejected-inputs",
                         "crash", "an edge with three faces: "}),
    [](const auto& of) { return std::string(of.param.name); });

// They would die of the first broken mesh, and are not handed any if they say so.
class DoesNotValidate : public RelationBreakdown {
 protected:
  void expect_not_asked(const std::string& subject) const {
    const Outcome o =
        run("audit " + subject + " octahedron --depth 1 --junit report.xml --json report.json", 0);
    EXPECT_TRUE(says(o.out, "rejected-inputs of "));
    EXPECT_TRUE(says(o.out, " were never judged: not asked: does not validate\n"));
    const json report = json_in("report.json");
    EXPECT_EQ(statuses(report, "octahedron")["rejected-inputs"], "not-supported");
    EXPECT_EQ(message(report, "rejected-inputs"), "not asked: does not validate");
    EXPECT_EQ(report["never_judged"][0]["reason"], "not asked: does not validate") << report["never_judged"];
    const std::string junit = read("report.xml");
    const std::size_t row = junit.find("name=\"rejected-inputs\"");
    ASSERT_NE(row, std::string::npos);
    EXPECT_TRUE(says(junit.substr(row, 200), "<skipped message=\"not-supported: "));
    EXPECT_TRUE(says(junit.substr(row, 200), "not asked: does not validate"));

    write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n");
    const Outcome refuse = run("audit " + subject + " broken.obj --must-refuse --details", 2);
    EXPECT_TRUE(says(refuse.out, "does not validate"));
  }
};

TEST_F(DoesNotValidate, ALibraryIsNotHandedBrokenMeshes) {
  const std::string fragile =
      "'" LIMITCHECK_TEST_SUBJECTS "/behaviours_2.so' --options behaviour=segfault@create,on=broken";
  expect_not_asked(fragile + ",validates=no");
  EXPECT_EQ(run("audit " + fragile + " octahedron --depth 1").code, 1) << "one that validates is";
}

}  // namespace
}  // namespace limitcheck::cli
