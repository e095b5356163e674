// SPDX-License-Identifier: MIT
// Findings that share a cause are one, and none is lost.
#include "verify/causes/causes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/evidence/cells.h"
#include "verify/report/forms.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

Result red(const std::string& subject, const std::string& mesh, const std::string& check, double worst) {
  Result r{.subject = subject,
           .mesh = mesh,
           .check = check,
           .status = Status::kFinding,
           .bad = 1,
           .of = 10,
           .worst = worst,
           .bound = 1e-6,
           .unit = check == "normals" ? "degrees" : "diagonal"};
  return r;
}

Report report_of(std::vector<Result> rows) {
  Report report;
  for (const Result& r : rows) {
    if (std::find(report.subjects.begin(), report.subjects.end(), r.subject) == report.subjects.end())
      report.subjects.push_back(r.subject);
    report.meshes.push_back({r.mesh, 4, 4});
  }
  report.results = std::move(rows);
  return report;
}

// Every red row is in one cause, and every cause has one that shows it.
void expect_partition(const Report& report, const std::vector<Cause>& all) {
  std::multiset<std::size_t> rows;
  for (const Cause& c : all) {
    ASSERT_FALSE(c.rows.empty()) << c.title;
    EXPECT_FALSE(c.title.empty());
    EXPECT_TRUE(is_bad(report.results[c.example])) << c.title;
    EXPECT_LE(c.cases, c.of) << c.title;
    EXPECT_GE(c.cases, 1) << c.title;
    for (const std::size_t k : c.rows) {
      rows.insert(k);
      EXPECT_NE(std::find(c.subjects.begin(), c.subjects.end(), report.results[k].subject), c.subjects.end());
    }
  }
  for (const Result& r : report.results)
    EXPECT_EQ(verdict_of(r), r.status) << r.subject << " / " << r.check << " on " << r.mesh;
  for (std::size_t k = 0; k < report.results.size(); ++k)
    EXPECT_EQ(rows.count(k), is_bad(report.results[k]) ? 1U : 0U)
        << report.results[k].subject << " / " << report.results[k].check << " on " << report.results[k].mesh;
}

TEST(Causes, RowsThatFollowFromOthersAreTheirConsequences) {
  Result positions = red("s", "m", "positions", 1e-2);
  positions.places = {{PlaceKind::kRegularVertex, 0, 0, 5},
                      {PlaceKind::kBoundaryVertex, 3, 0, 2},
                      {PlaceKind::kBoundaryVertex, 4, 2, 2},
                      {PlaceKind::kBoundaryVertex, 5, 1, 1}};
  const Report report =
      report_of({positions, red("s", "m", "mirror", 50), red("s", "m", "normals-against-positions", 3)});
  const std::vector<Cause> all = causes(report);
  expect_partition(report, all);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].title,
            "Positions are off by up to 1.0e-02 diagonals, only at boundary vertices of 4 or more faces");
  EXPECT_EQ(all[0].consequences, (std::vector<std::string>{"mirror", "normals-against-positions"}));
}

TEST(Causes, WrongPointsExplainNothingOfChannels) {
  const auto of = [](const char* check) {
    return sorted_into_causes(report_of({red("s", "m", "positions", 1e-2), red("s", "m", check, 1e-2)}))
        .size();
  };
  EXPECT_EQ(of("continuity"), 1U);
  EXPECT_EQ(of("channel-positions"), 2U);
}

TEST(Causes, NumbersThatAreNoneAreOneCauseOfALibrary) {
  Result finite = red("lib-a", "m", "finite", 0), line = red("lib-b", "m", "degenerate-geometry", 0);
  Result scaled = red("lib-b", "m", "scaling", 0);
  scaled.worst.reset();
  scaled.not_finite = 7;
  Report report = report_of({finite, line, scaled});
  report.descriptions = {{"lib-a", "Lib 3.5 A: this"}, {"lib-b", "Lib 3.5 B: that"}};
  const std::vector<Cause> all = causes(report);
  expect_partition(report, all);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].kind, CauseKind::kNotFinite);
  EXPECT_EQ(all[0].who, "Lib");
}

TEST(Causes, OfLengthsAloneSayNothingOfNumbersThatAreNone) {
  for (const auto& [check, begin] : {std::pair{"normal-length", "Normals that are not of unit length"},
                                     {"finite", "NaN, infinity or a normal of length 0"}}) {
    Report report = report_of({red("s", "m", check, 0.68)});
    report.meshes[0].diagonal = 0x1p60;
    EXPECT_TRUE(causes(report)[0].title.starts_with(begin)) << causes(report)[0].title;
  }
}

TEST(Causes, DifferentPlacesAreDifferentCauses) {
  Result a = red("s", "a", "normals", 3), b = red("s", "b", "normals", 2), both = red("s", "c", "normals", 4);
  a.places = {{PlaceKind::kDart, 0, 1, 1}};
  b.places = {{PlaceKind::kExtraordinaryVertex, 5, 1, 1}};
  both.places = {{PlaceKind::kExtraordinaryVertex, 5, 1, 1}, {PlaceKind::kDart, 0, 1, 1}};
  const Report report = report_of({a, b, both});
  const std::vector<Cause> all = causes(report);
  expect_partition(report, all);
  EXPECT_EQ(all.size(), 2U);
}

// The rule at the end of a sharp edge is one of its own; what is wrong along the edge is wrong at its end, too.
TEST(Causes, OfDartsAreTheirOwnUnlessTheWholeEdgeIsWrong) {
  Result dart = red("s", "a", "positions", 3), edge = red("s", "b", "positions", 2);
  dart.places = {{PlaceKind::kSharpEdge, 0, 0, 5}, {PlaceKind::kDart, 0, 1, 1}};
  edge.places = {{PlaceKind::kSharpEdge, 0, 2, 5}, {PlaceKind::kDart, 0, 1, 1}};
  const Report report = report_of({dart, edge});
  const std::vector<Cause> all = causes(report);
  expect_partition(report, all);
  ASSERT_EQ(all.size(), 2U);
  for (const Cause& c : all) {
    const bool along = c.title.find("on sharp edges") != std::string::npos;
    EXPECT_EQ(report.results[c.rows[0]].mesh, along ? "b" : "a") << c.title;
  }
}

// A mesh without regular places cannot tell "everywhere" from "only in irregular faces".
TEST(Causes, AreComparedOnlyInPlacesThatAMeshHas) {
  Result regular = red("s", "sheet", "positions", 3), irregular = red("s", "tetrahedron", "positions", 2),
         vertices = red("s", "octahedron", "positions", 2);
  regular.places = {{PlaceKind::kRegularFace, 0, 5, 9}, {PlaceKind::kBoundaryFace, 0, 2, 9}};
  irregular.places = {{PlaceKind::kIrregularFace, 0, 9, 9}, {PlaceKind::kExtraordinaryVertex, 3, 4, 4}};
  vertices.places = {{PlaceKind::kExtraordinaryVertex, 4, 6, 6}};
  const std::vector<Cause> one = causes(report_of({regular, irregular, vertices}));
  ASSERT_EQ(one.size(), 1U) << one[0].title << " and " << one[1].title;
  EXPECT_TRUE(says(one[0].title, "everywhere, in regular faces, too"));

  const std::vector<Cause> alone = causes(report_of({irregular}));
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_TRUE(alone[0].title.ends_with("only in irregular faces; nothing regular was looked at"))
      << alone[0].title;

  // What a mesh has and is right there is no part of it.
  Result only = red("s", "bumpy", "positions", 2), dart = red("s", "dart", "positions", 2);
  only.places = {{PlaceKind::kRegularFace, 0, 0, 9}, {PlaceKind::kIrregularFace, 0, 9, 9}};
  dart.places = {{PlaceKind::kIrregularFace, 0, 0, 9}, {PlaceKind::kDart, 0, 1, 1}};
  EXPECT_EQ(causes(report_of({regular, only})).size(), 2U);
  EXPECT_EQ(causes(report_of({regular, dart})).size(), 2U);
}

// Wrong in a and b, right in c: only one kind of neighbourhood is in both and not in the third.
TEST(Causes, NameTheOneKindOfNeighbourhoodWhereTheyShow) {
  const auto number_of = [](const char* name) {
    const auto& all = cells(data::Scheme::kLoop);
    return std::find_if(all.begin(), all.end(), [&](const Cell& c) { return c.name() == name; }) -
           all.begin();
  };
  Report report = report_of({red("s", "a", "positions", 3), red("s", "b", "positions", 2),
                             red("s", "c", "positions", 0), red("s", "a", "mirror", 9)});
  report.results[2].status = Status::kHeld;
  const auto looks_at = [&](const char* mesh, std::initializer_list<const char*> names) {
    CaseCells& c = report.cases.emplace_back(CaseCells{{mesh, 0, "", ""}, data::Scheme::kLoop, {}});
    c.cells.resize(cells(data::Scheme::kLoop).size());
    for (const char* name : names) c.cells.at(static_cast<std::size_t>(number_of(name))) = true;
  };
  looks_at("a", {"3 faces", "2 infinite edges", "2 infinite edges, 3 faces", "inside"});
  looks_at("b", {"3 faces", "2 infinite edges", "2 infinite edges, 3 faces", "depth 1"});
  looks_at("c", {"3 faces", "2 infinite edges", "inside", "depth 1"});
  const std::vector<Cause> all = causes(report);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].only_with, "2 infinite edges, 3 faces");
  EXPECT_TRUE(all[0].title.ends_with("; of all neighbourhoods only with 2 infinite edges, 3 faces"))
      << all[0].title;

  // Two that tell them apart name nothing, and so does a report in which everything is wrong.
  for (CaseCells& c : report.cases)
    c.cells.at(static_cast<std::size_t>(number_of("depth 2, some faces culled"))) =
        c.at != report.cases[2].at;
  EXPECT_EQ(causes(report)[0].only_with, "");
  report.results[2].status = Status::kFinding;
  report.results[2].bad = 1;
  EXPECT_EQ(causes(report)[0].only_with, "");
}

TEST(Causes, CoverEveryRedRowOfRealSubjects) {
  std::vector<AuditSubject> subjects;
  for (const char* name : {"opensubdiv-far", "opensubdiv-bfr", "openmesh", "cgal"})
    if (const lc_subject* s = find_subject(name)) subjects.push_back({s, ""});
  std::vector<AuditMesh> meshes;
  for (const char* name : {"fan:5", "quad-fan:3", "tetrahedron", "prism:5", "quad-dart:4"}) {
    meshes.push_back({name, data::named_mesh(name)});
    meshes.back().depth = 2;
  }
  Report report;
  for (const AuditSubject& s : subjects) {
    report.subjects.push_back(s.label());
    report.descriptions[s.label()] = s.subject->description;
  }
  for (const AuditMesh& m : meshes)
    report.meshes.push_back({m.name, 0, static_cast<std::int64_t>(m.mesh.faces.size()), m.scheme(), "", 1});
  report.results = Auditor(2, 2, {}, Level::kStandard).run(subjects, meshes);
  const std::vector<Cause> all = causes(report);
  expect_partition(report, all);
  EXPECT_GE(all.size(), 4U);
  const std::string screen = to_overview(report, all, {}, "scheme: both", "standard", "");
  EXPECT_LE(std::count(screen.begin(), screen.end(), '\n'), kScreen) << screen;
}

TEST(Overview, HasEveryCheckOnceAndCountsCases) {
  std::set<std::string_view> seen;
  for (const char* depths : {"uniform", "file"}) {
    Report of;
    of.depths = depths;
    for (const CheckGroup& g : check_groups(of))
      for (const std::string_view check : g.checks) EXPECT_TRUE(seen.insert(check).second) << check;
  }
  Report report = report_of({red("s", "a", "positions", 1), red("s", "b", "positions", 1)});
  report.results[1].status = Status::kHeld;
  EXPECT_EQ(verdict_of(report, "s", check_groups(report)[2]).text(), "1/2");
  EXPECT_EQ(verdict_of(report, "s", check_groups(report)[3]).text(), "not asked");
}

}  // namespace
}  // namespace limitcheck::verify
