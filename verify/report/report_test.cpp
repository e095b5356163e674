// SPDX-License-Identifier: MIT
// Table and JSON.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "data/test_support/assertions.h"
#include "verify/report/forms.h"
#include "verify/report/json.h"
#include "verify/row/commands.h"

namespace limitcheck::verify {
namespace {

Report example() {
  Report report;
  report.version = "1.2.3";
  report.depth = 2;
  report.subjects = {"good", "bad"};
  report.meshes = {{"wheel:7", 29, 63}, {"my cage.obj", 4, 4}};
  for (const char* subject : {"good", "bad"})
    for (const char* mesh : {"wheel:7", "my cage.obj"}) {
      Result r;
      r.subject = subject;
      r.mesh = mesh;
      r.check = "positions";
      r.depth = 2;
      r.of = 100;
      r.worst = 1e-9;
      r.bound = 1e-6;
      r.rms = r.p99 = 1e-10;
      r.unit = "diagonal";
      r.status = Status::kHeld;
      report.results.push_back(r);
    }
  Result& worst = report.results.back();
  worst.status = Status::kFinding;
  worst.bad = 3;
  worst.worst = 0.125;
  worst.witness = Witness{2,
                          "3/8",
                          "1/4",
                          17,
                          -1,
                          {0.1, 0.2, 0.3},
                          {static_cast<double>(0.1F), std::numeric_limits<double>::quiet_NaN(), 1},
                          {}};
  return report;
}

TEST(Table, ShowsTheWorstMeshAndTheCommandThatRecomputesTheExpectedValue) {
  const std::string table = to_table(example(), {});
  EXPECT_TRUE(says(table, "FINDING            1/2"));
  EXPECT_TRUE(says(table, "limitcheck eval 'my cage.obj' 2 3/8 1/4\n"));
  EXPECT_TRUE(says(table, "got       0.1  nan  1\n")) << "floats as floats";
  EXPECT_FALSE(says(table, "\033")) << "no colour unless asked for";
  EXPECT_TRUE(says(to_table(example(), {.colour = true}), "\033[31mFINDING"));
}

TEST(Table, AMeshThatWasNotRunIsNeverCountedAsHeld) {
  Report report = example();
  report.results[0].status = Status::kNotRun;
  const std::string table = to_table(report, {});
  EXPECT_TRUE(says(table, "held               1/2"));
}

TEST(Commands, RepeatAResultAtTheDepthsItHad) {
  Report report = example();
  report.depths = "plan";
  Result r = report.results.back();
  EXPECT_EQ(audit_command(r, "standard"), "limitcheck audit bad 'my cage.obj' --depth 2");
  r.depths = "uniform";
  r.depth = 7;
  EXPECT_EQ(audit_command(r, "quick"), "limitcheck audit bad 'my cage.obj' --depth 7 --level quick");
  r.depths = "random:1";
  EXPECT_EQ(audit_command(r, "standard"), "limitcheck audit bad 'my cage.obj' --depth 7 --depths random:1");
  r.sample = "100:1";
  EXPECT_EQ(audit_command(r, "standard"),
            "limitcheck audit bad 'my cage.obj' --depth 7 --depths random:1 --sample 100:1");
}

TEST(Table, OfAPlanSaysWhichDepthsWereLookedAt) {
  Report report = example();
  report.depths = "plan";
  report.depth = 7;
  for (const auto& [depth, depths, status] : {std::tuple{0, "uniform", Status::kHeld},
                                              {1, "uniform", Status::kHeld},
                                              {7, "uniform", Status::kHeld},
                                              {5, "uniform", Status::kNotSupported},
                                              {4, "view", Status::kFinding}}) {
    Result r = report.results.front();
    r.depth = depth;
    r.depths = depths;
    r.status = status;
    report.results.push_back(r);
  }
  const std::string table = to_table(report, {});
  EXPECT_TRUE(says(table, "limitcheck 1.2.3: depths 0 to 7 on 2 meshes"));
  EXPECT_TRUE(says(table, " 0-2 7*")) << "in the row";
  EXPECT_TRUE(says(table, "depths looked at: 0 1 2 7; *: view\n"));
  EXPECT_TRUE(says(table, "on wheel:7 (view)"));
}

TEST(Json, SaysOfEachResultHowDeepItLooked) {
  Report report = example();
  report.results[3].depths = "random:1";
  report.results[3].sample = "9:1";
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["results"][3]["depth"], 2);
  EXPECT_EQ(json["results"][3]["depths"], "random:1");
  EXPECT_EQ(json["results"][3]["sample"], "9:1");
  EXPECT_TRUE(json["results"][0]["depths"].is_null());
}

TEST(Json, HasTheStableKeys) {
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(json["held"], false);
  EXPECT_EQ(json["meshes"][1]["name"], "my cage.obj");
  ASSERT_EQ(json["results"].size(), 4U);
  const auto& row = json["results"][3];
  for (const char* key : {"subject", "mesh", "check", "status", "count", "worst", "bound", "unit", "witness"})
    EXPECT_TRUE(row.contains(key)) << key;
  EXPECT_EQ(row["status"], "finding");
  EXPECT_EQ(row["count"], 3);
  EXPECT_EQ(row["witness"]["l1"], "3/8");
  EXPECT_EQ(row["witness"]["got"][1], "nan");
  EXPECT_TRUE(json["results"][0]["witness"].is_null());
}

// A part of a report loses nothing; a report is read as far as it has it.
TEST(Json, RowsAreReadAsTheyWereWritten) {
  Result r = example().results.back();
  r.depths = "random:1", r.sample = "9:1", r.triangulated = "fan";
  r.precision = LC_FLOAT32, r.scheme = data::Scheme::kCatmullClark, r.weights = reference::Weights::kWarren;
  r.worst_absolute = .5, r.worst_ulps = std::numeric_limits<double>::infinity();
  r.ill_conditioned = {7, .25, .125};
  r.witness->corner = 3, r.witness->expected_digits = {"0.1", "0.2"};
  r.message = "one", r.accepted = {"two"}, r.not_finite = 3, r.waiver = "four";
  r.places = {{PlaceKind::kBoundaryVertex, 4, 1, 2}, {PlaceKind::kCorner, -1, 0, 1}};
  r.decades = {0, 5}, r.seconds = 1.5;
  r.recognised = {"what", "loop", 2, true, false};
  const auto json = rows_json({r});
  const Result again = rows_of(nlohmann::json::parse(json.dump())).at(0);
  EXPECT_EQ(rows_json({again}), json);
  EXPECT_EQ(again.weights, reference::Weights::kWarren);
  EXPECT_TRUE(std::isnan(again.witness->got[1]));

  Report report = example();
  report.results.back() = r;
  auto reported = nlohmann::json::parse(to_json(report))["results"][3];
  Result kept = reported_row(reported);
  EXPECT_EQ(kept.weights, reference::Weights::kLoop) << "a report does not have it";
  EXPECT_FALSE(kept.worst_ulps) << "no number";
  kept.weights = r.weights, kept.decades = r.decades, kept.accepted = r.accepted;
  kept.not_finite = r.not_finite, kept.waiver = r.waiver, kept.worst_ulps = r.worst_ulps;
  EXPECT_EQ(rows_json({kept}), json);
  reported["status"] = "fynding";
  EXPECT_THROW(reported_row(reported), std::exception);
  auto altered = json;
  for (auto& field : altered[0])
    if (field == static_cast<int>(Status::kFinding)) field = 99;
  EXPECT_THROW(rows_of(altered), std::exception);
}

TEST(Json, IsWrittenWholeOrNotAtAll) {
  const TestFolder folder;
  write_text(folder / "deep" / "report.json", "{}\n");
  EXPECT_EQ(contents_of(folder / "deep" / "report.json"), "{}\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "deep"), {}), 1)
      << "no temporary file stays";
  EXPECT_THROW(write_text("/proc/no/such.json", "x"), std::exception);
}

TEST(Status, WordsAreStable) {
  EXPECT_EQ(word(Status::kHeld), "held");
  EXPECT_EQ(word(Status::kFinding), "finding");
  EXPECT_EQ(word(Status::kNotSupported), "not-supported");
  EXPECT_EQ(word(Status::kNotRun), "not-run");
  EXPECT_EQ(word(Status::kError), "error");
}

// As a merged one may be: its parts say of a row that it is the host's, and nothing else is wrong.
TEST(AReport, DoesNotHoldWhereTheHostLackedSomething) {
  Report report;
  report.results.resize(2);
  report.results[0].status = Status::kHeld;
  EXPECT_TRUE(report.held());
  report.results[1].origin = Origin::kHost;
  EXPECT_FALSE(report.held());
  report.changes = Report::Changes{};
  EXPECT_FALSE(report.held()) << "nor against a baseline";
}

// The contrast of two colours "#rrggbb", by WCAG 2.1.
double contrast(const std::string& a, const std::string& b) {
  const auto luminance = [](const std::string& colour) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double c = std::stoi(colour.substr(1 + 2 * static_cast<std::size_t>(k), 2), nullptr, 16) / 255.0;
      sum += (k == 0   ? .2126
              : k == 1 ? .7152
                       : .0722) *
             (c <= .03928 ? c / 12.92 : std::pow((c + .055) / 1.055, 2.4));
    }
    return sum;
  };
  const double x = luminance(a), y = luminance(b);
  return (std::max(x, y) + .05) / (std::min(x, y) + .05);
}

TEST(Page, EachColourOfTextStandsOutFromThePaperInLightAndInDark) {
  EXPECT_NEAR(contrast("#000000", "#ffffff"), 21, 1e-9);
  EXPECT_NEAR(contrast("#888888", "#ffffff"), 3.54, .01);
  const std::string page = kHtmlPage;
  std::size_t at = 0;
  for (int scheme = 0; scheme < 2; ++scheme) {  // :root of light, then of dark
    const auto colour = [&](const std::string& name) {
      const std::size_t found = page.find("--" + name + ": #", at);
      EXPECT_NE(found, std::string::npos) << name;
      return page.substr(found + name.size() + 4, 7);
    };
    const std::string paper = colour("paper");
    for (const char* text : {"ink", "red", "amber", "dim"})
      EXPECT_GE(contrast(colour(text), paper), 4.5) << text << " of " << paper;
    at = page.find("prefers-color-scheme: dark");
  }
}

}  // namespace
}  // namespace limitcheck::verify
