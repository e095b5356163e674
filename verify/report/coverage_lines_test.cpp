// SPDX-License-Identifier: MIT
// What a report says of the kinds of neighbourhood that it looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "data/generators/named_mesh.h"
#include "verify/audit/default_plan.h"
#include "verify/report/coverage.h"

namespace limitcheck::verify {
namespace {

AuditMesh named(const std::string& name, int depth) {
  AuditMesh m{name, data::named_mesh(name)};
  m.depth = depth;
  return m;
}

// A report of rows that judged positions, or could not.
Report report_of(const CoverageQuestion& question, Status status) {
  Report report;
  report.subjects = {"s"};
  for (const CaseCells& c : question.cases) {
    Result r;
    r.subject = "s", r.mesh = c.mesh, r.check = "positions";
    r.depth = c.depth, r.depths = c.depths, r.sample = c.sample, r.scheme = c.scheme;
    r.status = status, r.of = 1;
    report.results.push_back(r);
  }
  report.coverage = coverage_of(report.results, question);
  return report;
}

TEST(Coverage, CountsWhatWasJudgedAndNothingElse) {
  CoverageQuestion question = coverage_question({}, {named("star:1:J.J.3", 1), named("torus", 2)});
  question.declared = {{"s", data::Scheme::kLoop, LC_SHARP_CREASES, 12}};
  const Coverage held = report_of(question, Status::kHeld).coverage.at(0);
  EXPECT_GT(held.looked, 50);
  EXPECT_EQ(held.declared() + held.not_declared,
            static_cast<std::int64_t>(cells(data::Scheme::kLoop).size()));
  const auto never = [&](const char* name) {
    return std::find(held.never.begin(), held.never.end(), name) != held.never.end();
  };
  EXPECT_FALSE(never("2 infinite edges"));
  EXPECT_TRUE(never("3 infinite edges"));
  EXPECT_FALSE(never("1 semi-sharp edge")) << "which is not declared";
  EXPECT_EQ(report_of(question, Status::kFinding).coverage.at(0).looked, held.looked);
  EXPECT_EQ(report_of(question, Status::kNotSupported).coverage.at(0).looked, 0);
  EXPECT_EQ(report_of(question, Status::kNotRun).coverage.at(0).looked, 0);

  const CoverageQuestion again = coverage_question(nlohmann::json::parse(coverage_json(question).dump()));
  EXPECT_EQ(report_of(again, Status::kHeld).coverage.at(0).never, held.never);
}

TEST(Coverage, OfThePlanIsWholeAndMissesWhatADeletedMeshAloneHad) {
  std::vector<AuditMesh> plan = default_plan(Level::kQuick);
  const auto never = [&] {
    CoverageQuestion question = coverage_question({}, plan);
    constexpr std::int32_t kAll = LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS |
                                  LC_SHARP_SMOOTH_TRIANGLES | kNeedsBoundary | kNeedsDepths;
    for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark})
      question.declared.push_back({"s", scheme, kAll, 12});
    return report_of(question, Status::kHeld);
  };
  const Report whole = never();
  for (const Coverage& c : whole.coverage) EXPECT_TRUE(c.never.empty()) << c.never.front();
  EXPECT_EQ(coverage_lines(whole).find("never"), std::string::npos);
  std::erase_if(plan, [](const AuditMesh& m) { return m.name.find("stars:") != std::string::npos; });
  const Report part = never();
  for (const Coverage& c : part.coverage) EXPECT_FALSE(c.never.empty());
  EXPECT_NE(coverage_lines(part).find("; never: "), std::string::npos);
}

}  // namespace
}  // namespace limitcheck::verify
