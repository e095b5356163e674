// SPDX-License-Identifier: MIT
// A point that is NaN or infinite is one finding of one check, and all other checks leave it out.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "data/shapes.h"
#include "verify/audit/audit.h"
#include "verify/checks/checks.h"
#include "verify/evidence/test_script.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/relations/relation_comparison.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::set<std::string> red(const std::vector<Result>& results) {
  std::set<std::string> names;
  for (const Result& r : results)
    if (is_bad(r)) names.insert(r.check);
  return names;
}

TEST(NotFinite, AConstantNaNOrInfinityIsTheFindingOfOneRow) {
  const AuditMesh mesh{"torus:3:4", data::torus(3, 4)};
  for (const char* base : {"model", "opensubdiv-far", "sliding-window"}) {
    const auto with = [&](const char* fault) {
      return Auditor(2, 1, {}, Level::kThorough)
          .run({lc_subject_faulty(), faulty_options(fault, base)}, mesh);
    };
    std::set<std::string> expected = red(with("none"));  // OpenSubdiv has findings of its own
    EXPECT_TRUE(expected.insert("finite").second);
    for (const char* fault : {"nan_position", "infinite_position", "nan_normal"}) {
      const auto results = with(fault);
      EXPECT_EQ(red(results), expected) << base << " " << fault;
      // Checks that leave it out say so.
      const bool normal = std::string(fault) == "nan_normal";
      EXPECT_NE(row(results, normal ? "normals" : "positions")
                    .message.find(normal ? "1 normals that are not finite are left out"
                                         : "1 positions that are not finite are left out"),
                std::string::npos);
    }
  }
}

TEST(NotFinite, WhatWasNeverWrittenIsTheFindingOfOneRow) {
  for (const char* fault : {"unwritten_position", "unwritten_normal"}) {
    const auto results =
        Auditor(2, 1, {}, Level::kThorough)
            .run({lc_subject_faulty(), faulty_options(fault, "model")}, {"torus:3:4", data::torus(3, 4)});
    EXPECT_EQ(red(results), std::set<std::string>{"written"}) << fault;
  }
}

TEST(NotFinite, ASubjectOfNothingButNaNIsNotConfirmedInAnything) {
  test::Script s = test::exact_script(data::tetrahedron(), 1);
  for (Vector& p : s.positions) p.fill(kNaN);
  for (Vector& n : s.normals) n.fill(kNaN);
  const test::Scripted scripted(data::tetrahedron(), {1, 1, 1, 1}, s);
  for (const char* name :
       {"positions", "normals", "normal-length", "normals-against-positions", "orientation"})
    for (const Check& check : checks()) {
      const auto results = check.run(*scripted);
      for (const Result& r : results)
        if (r.check == name) {
          EXPECT_EQ(r.status, Status::kNotRun) << name;
          EXPECT_EQ(r.of, 0) << name;
        }
    }
}

// Against a tessellation with one NaN: the same again, the NaN elsewhere, and one more.
TEST(NotFinite, OnlyMoreOfThemThanInTheOriginalAreAFindingOfARelation) {
  const data::ControlMesh mesh = data::tetrahedron();
  test::Script s = test::exact_script(mesh, 1);
  s.positions[2][1] = kNaN;
  test::Script elsewhere = test::exact_script(mesh, 1), more = s, other_bits = s;
  elsewhere.positions[9][0] = kNaN;
  more.normals[4][2] = std::numeric_limits<double>::infinity();
  other_bits.positions[5][0] = std::nextafter(other_bits.positions[5][0], 9.);
  const std::vector<std::int32_t> depth(4, 1);
  const test::Scripted original(mesh, depth, s);
  const Compared compared(*original);
  const auto against = [&](const test::Script& other) {
    const test::Scripted made(mesh, depth, other);
    return compared.with(made->tessellation, identity(*original), 0);
  };
  EXPECT_EQ(against(s).bad, 0);
  EXPECT_EQ(against(s).other_bits, 0);
  EXPECT_EQ(against(elsewhere).bad, 0);
  EXPECT_EQ(against(more).bad, 1);
  EXPECT_EQ(against(more).message, "2 points are not finite, 1 in the original");
  EXPECT_EQ(against(other_bits).other_bits, 1);
}

// Equal as numbers, and yet another result.
TEST(NotFinite, TheSignOfAZeroIsABit) {
  const data::ControlMesh mesh = data::triangle();
  test::Script s = test::exact_script(mesh, 0);
  for (Vector& n : s.normals) n = {0, 0, 1};
  test::Script negative = s;
  negative.normals[1][0] = -0.0;
  const test::Scripted original(mesh, {0}, s), other(mesh, {0}, negative);
  const Comparison c = Compared(*original).with(other->tessellation, identity(*original), 0);
  EXPECT_EQ(c.bad, 0);
  EXPECT_EQ(c.other_bits, 1);
}

}  // namespace
}  // namespace limitcheck::verify
