// SPDX-License-Identifier: MIT
// What a waiver covers, and what is said of one that is of no use; of the table of rows, of JUnit, and of the
// kinds of neighbourhood that were looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "data/error.h"
#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "verify/audit/default_plan.h"
#include "verify/checks/checks.h"
#include "verify/relations/relations.h"
#include "verify/report/coverage.h"
#include "verify/report/forms.h"
#include "verify/report/known.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {
namespace {

Report report() {
  Report r;
  r.subjects = {"mine", "mine:level=2"};
  for (const char* subject : {"mine", "mine:level=2"})
    for (const char* mesh : {"bumpy:60", "fan:4"}) {
      Result row{.subject = subject,
                 .mesh = mesh,
                 .check = "positions",
                 .status = Status::kFinding,
                 .bad = 1,
                 .of = 2,
                 .worst = 1e-3};
      r.results.push_back(row);
    }
  return r;
}

Waiver waiver() {
  Waiver w{.subject = "mine",
           .check = "positions",
           .shape = "bumpy:*",
           .reason = "known",
           .expires = "2027-01-31"};
  return w;
}

TEST(Baseline, AsATextTellsWhatIsNewWorseAndGoneBySubjectAndCheck) {
  const Report then = report();
  const std::string text = to_baseline(then);
  EXPECT_TRUE(says(text, "\npositions 2 0.001 mine\n")) << text;
  EXPECT_TRUE(says(text, "\npositions 2 0.001 mine:level=2\n")) << text;
  const auto changes = [&](const Report& now) {
    Report compared = now;
    compare_with_baseline(compared, text, "known.txt");
    const auto& c = *compared.changes;
    EXPECT_EQ(compared.held(), c.appeared + c.worse == 0);
    return std::array{c.appeared, c.worse, c.gone, c.same};
  };
  using Counts = std::array<std::int64_t, 4>;
  EXPECT_EQ(changes(then), (Counts{0, 0, 0, 2}));
  Report other_mesh = then;
  other_mesh.results[0].mesh = "fan:5";
  EXPECT_EQ(changes(other_mesh), (Counts{0, 0, 0, 2})) << "meshes are no part of it";
  Report larger = then;
  larger.results[0].worst = 1.2e-3;
  EXPECT_EQ(changes(larger), (Counts{0, 1, 0, 1}));
  Report more = then;
  more.results.push_back(more.results[0]);
  EXPECT_EQ(changes(more), (Counts{0, 1, 0, 1}));
  Report another = then;
  another.results[0].check = "normals";
  EXPECT_EQ(changes(another), (Counts{1, 0, 0, 2}));
  // Another device rounds otherwise: nothing of its subjects is compared, and that is said.
  Report there = then;
  there.devices = {{"mine", "llvmpipe"}};
  Report here = another;
  here.devices = {{"mine", "a card"}};
  for (const Report& now : {there, here}) {
    Report compared = now;
    compared.results.erase(compared.results.begin() + 2, compared.results.end());
    compare_with_baseline(compared, to_baseline(there), "known.txt");
    const auto& c = *compared.changes;
    const bool same = now.devices == there.devices;
    EXPECT_EQ((std::array{c.appeared, c.worse, c.gone, c.same}), (same ? Counts{0, 0, 0, 1} : Counts{}));
    EXPECT_EQ(c.named.size(), same ? 0U : 1U);
  }
  Report better = then;
  for (Result& r : better.results)
    if (r.subject == "mine") r.status = Status::kHeld, r.bad = 0;
  EXPECT_EQ(changes(better), (Counts{0, 0, 1, 1}));
  Report elsewhere = then;
  std::erase_if(elsewhere.results, [](const Result& r) { return r.subject == "mine"; });
  EXPECT_EQ(changes(elsewhere), (Counts{0, 0, 0, 1})) << "what was not looked at is not gone";
  for (const char* wrong : {"positions 0 - mine", "positions 2 mine", "positions 2 1x mine", "positions"}) {
    Report now = then;
    EXPECT_THROW(compare_with_baseline(now, "limitcheck baseline 1\n" + std::string(wrong) + "\n", "k.txt"),
                 data::ArgumentError)
        << wrong;
  }
  Report now = then;
  EXPECT_THROW(compare_with_baseline(now, text + "positions 2 0.001 mine\n", "k.txt"), data::ArgumentError);
}

// The rows of the report after a waiver, on a day; the first of them was `before`.
std::vector<Result> waived(const Waiver& w, const Result& before = report().results[0],
                           const std::string& today = "2026-11-21", const std::string& version = "") {
  Report r = report();
  r.results[0] = before;
  apply_waivers(r, {w}, {{"mine", version}}, today);
  EXPECT_FALSE(r.held());
  return r.results;
}

TEST(Waivers, CoverASubjectACheckAndAShapeAndNothingElse) {
  const auto rows = waived(waiver());
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].status, Status::kWaived);
  EXPECT_TRUE(says(rows[0].message, "known"));
  for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(rows[k].status, Status::kFinding);
}

TEST(Waivers, AreGoodUpToTheirOwnBoundOnly) {
  Waiver w = waiver();
  w.bound = 1e-4;
  const Result beyond = waived(w)[0];
  EXPECT_EQ(beyond.status, Status::kFinding);
  EXPECT_TRUE(says(beyond.message, "beyond the waiver"));
  Result not_finite = report().results[0];
  not_finite.worst.reset();
  w.bound = 1;
  EXPECT_EQ(waived(w, not_finite)[0].status, Status::kFinding);
}

TEST(Waivers, EndWithTheirLastDay) {
  EXPECT_EQ(waived(waiver(), report().results[0], "2027-01-31")[0].status, Status::kWaived);
  const auto rows = waived(waiver(), report().results[0], "2027-02-01");
  EXPECT_EQ(rows[0].status, Status::kFinding);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[4].status, Status::kQualityWarning);
  EXPECT_TRUE(says(rows[4].message, "expired"));
}

TEST(Waivers, HoldForARangeOfVersions) {
  Waiver w = waiver();
  w.from = "3.5";
  w.before = "4";
  for (const auto& [version, covered] :
       {std::pair{"3.4.9", false}, {"3.5", true}, {"3.5.1", true}, {"3.10", true}, {"4", false}, {"", false}})
    EXPECT_EQ(waived(w, report().results[0], "2026-11-21", version)[0].status == Status::kWaived, covered)
        << version;
  EXPECT_EQ(version_in("OpenSubdiv 3.5 Far: uniform"), "3.5");
  EXPECT_EQ(version_in("our own"), "");
}

TEST(Waivers, WithoutAnythingToCoverAreReported) {
  Waiver w = waiver();
  w.shape = "torus";
  const auto rows = waived(w);
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_TRUE(says(rows[4].message, "covers nothing"));
  Result held = report().results[0];
  held.status = Status::kHeld;
  EXPECT_EQ(waived(waiver(), held)[0].status, Status::kUnexpectedPass);
}

TEST(Waivers, ThatAreNotUnderstoodAreRefused) {
  EXPECT_EQ(parse_waivers(R"({"waivers":[{"subject":"a","check":"b","reason":"c","expires":"2027-01-01",
      "versions":{"from":"1"},"bound":0.5}]})")
                .at(0)
                .from,
            "1");
  for (const char* bad :
       {"", "[]", R"({"waivers":[1]})", R"({"waivers":[{"subject":"a"}]})",
        R"({"waivers":[{"subject":"a","check":"b","reason":"c","expires":"soon"}]})",
        R"({"waivers":[{"subject":"a","check":"b","reason":"c","expires":"2027-01-01","bund":1}]})",
        R"({"waivers":[{"subject":"a","check":"b","reason":"c","expires":"2027-01-01","bound":"1"}]})",
        R"({"waivers":[{"subject":1,"check":"b","reason":"c","expires":"2027-01-01"}]})"})
    EXPECT_THROW(parse_waivers(bad), data::ArgumentError) << bad;
}

TEST(Waivers, MayNameARowThatHasBecomePartOfAnother) {
  const auto check = [](const std::string& named) {
    return parse_waivers(R"({"waivers":[{"subject":"a","check":")" + named +
                         R"(","reason":"c","expires":"2027-01-01"}]})")
        .at(0)
        .check;
  };
  EXPECT_EQ(check("extreme-scale"), "scaling");
  EXPECT_EQ(check("state"), "state");
}

TEST(Explain, KnowsEveryRowOnce) {
  std::set<std::string_view> rows{"tessellates",  "refined-positions", "recognised",
                                  "oracle-faces", "oracle-double",     "oracle-parts"},
      explained;
  for (const Check& c : checks()) rows.insert(c.rows.begin(), c.rows.end());
  rows.insert(relation_rows().begin(), relation_rows().end());
  for (const RowKind& e : row_kinds()) {
    if (e.check.starts_with("file-")) continue;  // those of files: verify/files/audit_files_test.cpp
    EXPECT_TRUE(explained.insert(e.check).second) << e.check;
    EXPECT_FALSE(e.meaning.empty() || e.bound.empty() || e.source.empty()) << e.check;
  }
  EXPECT_EQ(rows, explained);
}

TEST(JUnit, EscapesAndCounts) {
  Report r = report();
  r.results[0].message = "a < b & \"c\"\x01";
  r.results[1].status = Status::kNotSupported;
  const std::string xml = to_junit(r);
  EXPECT_TRUE(says(xml, "a &lt; b &amp; &quot;c&quot;"));
  EXPECT_FALSE(says(xml, "\x01"));
  EXPECT_TRUE(says(xml, "<testsuite name=\"mine\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"1\""));
}

AuditMesh named(const std::string& name, int depth) {
  AuditMesh m{name, data::named_mesh(name)};
  m.depth = depth;
  return m;
}

// A report of rows that judged positions, or could not.
Report report_of(const CoverageQuestion& question, Status status) {
  Report report{.subjects = {"s"}};
  for (const CaseCells& c : question.cases) {
    Result r;
    r.subject = "s", r.check = "positions", r.scheme = c.scheme;
    std::tie(r.mesh, r.depth, r.depths, r.sample) = c.at;
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
  EXPECT_FALSE(says(coverage_lines(whole), "never"));
  std::erase_if(plan, [](const AuditMesh& m) { return m.name.find("stars:") != std::string::npos; });
  const Report part = never();
  for (const Coverage& c : part.coverage) EXPECT_FALSE(c.never.empty());
  EXPECT_TRUE(says(coverage_lines(part), "; never: "));
}

}  // namespace

}  // namespace limitcheck::verify
