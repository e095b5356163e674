// SPDX-License-Identifier: MIT
// The JSON of a large report: small, and nothing that a baseline needs is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "verify/report/json.h"
#include "verify/report/known.h"

namespace limitcheck::verify {
namespace {

// Of 2 subjects and 4 checks on 300 meshes; every third row is a finding.
Report large() {
  Report report;
  report.subjects = {"one", "other"};
  for (const std::string& subject : report.subjects)
    for (int mesh = 0; mesh < 300; ++mesh)
      for (const char* check : {"positions", "normals", "watertight", "mirror"}) {
        Result r;
        r.subject = subject, r.mesh = "bumpy:" + std::to_string(mesh), r.check = check;
        r.depth = mesh % 5, r.depths = mesh % 2 == 0 ? "uniform" : "random:7", r.of = 1000;
        r.sample = mesh % 7 == 0 ? "20:1" : "";
        r.status = Status::kHeld, r.worst = 1e-9, r.bound = 1e-6, r.message = std::string(200, 'x');
        if (report.results.size() % 3 == 0)
          r.status = Status::kFinding, r.bad = mesh + 1, r.worst = 1e-5 * mesh;
        report.results.push_back(r);
      }
  return report;
}

std::int64_t findings(const Report& report) {
  return std::count_if(report.results.begin(), report.results.end(), is_bad);
}

TEST(ShortRows, OfEachSubjectAndCheckTheLargestFindingsStayInFull) {
  const Report report = large();
  const auto json = nlohmann::json::parse(to_json(report));
  ASSERT_EQ(json["results"].size(), 2 * 4 * kInFull);
  std::map<std::string, double> largest;
  for (const auto& row : json["results"]) {
    EXPECT_EQ(row["status"], "finding");
    double& worst = largest[row["subject"].get<std::string>() + row["check"].get<std::string>()];
    worst = std::max(worst, row["worst"].get<double>());
  }
  EXPECT_EQ(largest.size(), 8U);
  for (const auto& [name, worst] : largest) EXPECT_GE(worst, 2.95e-3) << name;
  EXPECT_EQ(json["in_short"]["left_out"]["held"], report.results.size() - findings(report));
  EXPECT_LT(to_json(report).size(), to_json(report, "standard", true).size() / 10);
}

TEST(ShortRows, OneComparesAndRepeatsByThemAsByAllRows) {
  const Report report = large();
  const std::string small = to_json(report), all = to_json(report, "standard", true);
  const auto bad = [](const std::string& text) {
    std::vector<std::string> lines;
    for (const Result& r : reported_rows(text, "it"))
      if (is_bad(r))
        lines.push_back(r.subject + r.check + r.mesh + std::to_string(r.depth) + r.depths + r.sample +
                        r.triangulated + std::to_string(*r.worst) + std::to_string(r.bad) +
                        std::to_string(r.of));
    std::sort(lines.begin(), lines.end());
    return lines;
  };
  EXPECT_EQ(bad(small), bad(all));
  EXPECT_EQ(static_cast<std::int64_t>(bad(small).size()), findings(report));
  for (const std::string& before : {small, all}) {
    Report now = report;
    now.results[0].worst = 1;                  // worse
    now.results[1].status = Status::kFinding;  // new
    now.results[3].status = Status::kHeld;     // gone
    compare_with_baseline(now, before, "it");
    EXPECT_EQ(now.changes->worse, 1);
    EXPECT_EQ(now.changes->appeared, 1);
    EXPECT_EQ(now.changes->gone, 1);
    EXPECT_EQ(now.changes->same, findings(report) - 2);
    EXPECT_FALSE(now.held());
    Report again = report;
    compare_with_baseline(again, before, "it");
    EXPECT_TRUE(again.held()) << "all of it is known";
    for (const char* none : {"{}", "no JSON"})
      EXPECT_THROW(compare_with_baseline(again, none, "it"), std::exception);
  }
}

TEST(ShortRows, ASmallReportHasThemAllAndNothingInShort) {
  Report report = large();
  report.results.resize(kMostInFull);
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["results"].size(), kMostInFull);
  EXPECT_FALSE(json.contains("in_short"));
}

}  // namespace
}  // namespace limitcheck::verify
