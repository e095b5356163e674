// SPDX-License-Identifier: MIT
// What SARIF 2.1.0 asks of a log, and what a page of Markdown must not become by the names of others.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "data/test_support/assertions.h"
#include "verify/report/forms.h"

namespace limitcheck::verify {
namespace {

// Two subjects with names that mean something in the format: one is wrong in positions, the other crashes.
Report small_report() {
  Report report;
  report.version = "1.2.3";
  report.subjects = {"program:a b|<x>", "other"};
  report.meshes = {{"cage[1](x).obj", 4, 4}};
  for (const std::string& subject : report.subjects) {
    Result r;
    r.subject = subject, r.mesh = "cage[1](x).obj", r.check = "positions", r.depths = "uniform";
    r.status = Status::kFinding, r.bad = 1, r.of = 4, r.worst = .5, r.bound = 1e-6, r.unit = "diagonal";
    if (subject == "other")
      r.check = "tessellates", r.status = Status::kCrash, r.message = "\033[31m*killed*\n# by `signal`";
    report.results.push_back(r);
  }
  return report;
}

TEST(Sarif, EachCauseIsAResultWithARuleALevelAndItsSubjects) {
  const Report report = small_report();
  const std::vector<Cause> all = causes(report);
  const auto log = nlohmann::json::parse(to_sarif(report, all, "standard"));
  EXPECT_EQ(log["version"], "2.1.0");
  ASSERT_EQ(log["runs"].size(), 1U);
  const auto& run = log["runs"][0];
  EXPECT_EQ(run["tool"]["driver"]["name"], "limitcheck");
  EXPECT_EQ(run["invocations"][0]["executionSuccessful"], true);
  ASSERT_EQ(run["results"].size(), all.size());
  ASSERT_EQ(all.size(), 2U);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& result = run["results"][k];
    const auto& rule = run["tool"]["driver"]["rules"].at(result["ruleIndex"].get<std::size_t>());
    EXPECT_EQ(rule["id"], result["ruleId"]);
    EXPECT_NE(rule["shortDescription"]["text"], "");
    EXPECT_EQ(result["level"], all[k].severity() == "high"     ? "error"
                               : all[k].severity() == "medium" ? "warning"
                                                               : "note");
    EXPECT_NE(result["message"]["text"], "");
    ASSERT_EQ(result["locations"].size(), all[k].subjects.size());
    const std::string uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
    EXPECT_EQ(uri, all[k].subjects[0] == "other" ? "other" : "program%3Aa%20b%7C%3Cx%3E");
  }
  Report cut = report;
  cut.incomplete = "interrupted";
  EXPECT_EQ(nlohmann::json::parse(to_sarif(cut, all, ""))["runs"][0]["invocations"][0]["executionSuccessful"],
            false);
  EXPECT_TRUE(nlohmann::json::parse(to_sarif(Report{}, {}, ""))["runs"][0]["results"].is_array());
}

TEST(Markdown, NamesAndMessagesAreNoMarks) {
  const Report report = small_report();
  const std::string page = to_markdown(report, causes(report), "standard");
  EXPECT_TRUE(says(page, "| program:a b\\|\\<x\\> |"));
  EXPECT_TRUE(says(page, "on cage\\[1\\]\\(x\\).obj"));
  EXPECT_TRUE(says(page, "1. **"));
  EXPECT_TRUE(says(page, "        limitcheck audit "));
  EXPECT_FALSE(says(page, "\033"));
  EXPECT_EQ(page.find("\n# ", 1), std::string::npos) << page;
}

}  // namespace
}  // namespace limitcheck::verify
