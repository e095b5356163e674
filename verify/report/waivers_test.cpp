// SPDX-License-Identifier: MIT
// What a waiver covers, and what is said of one that is of no use. And what is printed about checks.
#include "verify/report/waivers.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "data/error.h"
#include "verify/checks/checks.h"
#include "verify/relations/relations.h"
#include "verify/report/junit.h"
#include "verify/row/explain.h"

namespace limitcheck::verify {
namespace {

Report report() {
  Report r;
  r.subjects = {"mine", "mine:level=2"};
  for (const char* subject : {"mine", "mine:level=2"})
    for (const char* mesh : {"bumpy:60", "fan:4"}) {
      Result row;
      row.subject = subject;
      row.mesh = mesh;
      row.check = "positions";
      row.status = Status::kFinding;
      row.bad = 1;
      row.of = 2;
      row.worst = 1e-3;
      r.results.push_back(row);
    }
  return r;
}

Waiver waiver() {
  Waiver w;
  w.subject = "mine";
  w.check = "positions";
  w.shape = "bumpy:*";
  w.reason = "known";
  w.expires = "2027-01-31";
  return w;
}

TEST(Waivers, CoverASubjectACheckAndAShapeAndNothingElse) {
  Report r = report();
  apply_waivers(r, {waiver()}, {}, "2026-11-21");
  ASSERT_EQ(r.results.size(), 4U);
  EXPECT_EQ(r.results[0].status, Status::kWaived);
  EXPECT_NE(r.results[0].message.find("known"), std::string::npos);
  for (std::size_t k = 1; k < 4; ++k) EXPECT_EQ(r.results[k].status, Status::kFinding);
  EXPECT_FALSE(r.held());
}

TEST(Waivers, AreGoodUpToTheirOwnBoundOnly) {
  Report r = report();
  Waiver w = waiver();
  w.bound = 1e-4;
  apply_waivers(r, {w}, {}, "2026-11-21");
  EXPECT_EQ(r.results[0].status, Status::kFinding);
  EXPECT_NE(r.results[0].message.find("beyond the waiver"), std::string::npos);
  r = report();
  r.results[0].worst.reset();  // not finite
  w.bound = 1;
  apply_waivers(r, {w}, {}, "2026-11-21");
  EXPECT_EQ(r.results[0].status, Status::kFinding);
}

TEST(Waivers, EndWithTheirLastDay) {
  Report r = report();
  apply_waivers(r, {waiver()}, {}, "2027-01-31");
  EXPECT_EQ(r.results[0].status, Status::kWaived);
  r = report();
  apply_waivers(r, {waiver()}, {}, "2027-02-01");
  EXPECT_EQ(r.results[0].status, Status::kFinding);
  ASSERT_EQ(r.results.size(), 5U);
  EXPECT_EQ(r.results[4].status, Status::kQualityWarning);
  EXPECT_NE(r.results[4].message.find("expired"), std::string::npos);
}

TEST(Waivers, HoldForARangeOfVersions) {
  for (const auto& [version, covered] : {std::pair{"3.4.9", false},
                                         {"3.5", true},
                                         {"3.5.1", true},
                                         {"3.10", true},
                                         {"4", false},
                                         {"", false}}) {
    Report r = report();
    Waiver w = waiver();
    w.from = "3.5";
    w.before = "4";
    apply_waivers(r, {w}, {{"mine", version}}, "2026-11-21");
    EXPECT_EQ(r.results[0].status == Status::kWaived, covered) << version;
  }
  EXPECT_EQ(version_in("OpenSubdiv 3.5 Far: uniform"), "3.5");
  EXPECT_EQ(version_in("our own"), "");
}

TEST(Waivers, WithoutAnythingToCoverAreReported) {
  Report r = report();
  Waiver w = waiver();
  w.shape = "torus";
  apply_waivers(r, {w}, {}, "2026-11-21");
  ASSERT_EQ(r.results.size(), 5U);
  EXPECT_NE(r.results[4].message.find("covers nothing"), std::string::npos);
  r = report();
  r.results[0].status = Status::kHeld;
  apply_waivers(r, {waiver()}, {}, "2026-11-21");
  EXPECT_EQ(r.results[0].status, Status::kUnexpectedPass);
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
  for (const Explanation& e : explanations()) {
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
  EXPECT_NE(xml.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos) << xml;
  EXPECT_EQ(xml.find('\x01'), std::string::npos);
  EXPECT_NE(xml.find("<testsuite name=\"mine\" tests=\"2\" failures=\"1\" errors=\"0\" skipped=\"1\""),
            std::string::npos)
      << xml;
}

}  // namespace
}  // namespace limitcheck::verify
