// SPDX-License-Identifier: MIT
// What rows say, number by number, against values found by hand; and a point that is NaN or infinite is one
// finding of one check, which all others leave out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/checks/checks.h"
#include "verify/evidence/test_script.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/relations/relation_row.h"
#include "verify/row/bounds.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using test::exact_script;
using test::Script;
using test::Scripted;

const data::ControlMesh& mesh() {
  static const data::ControlMesh tetrahedron = data::tetrahedron();
  return tetrahedron;
}

// All checks on a script of the tetrahedron.
std::vector<Result> look(const Script& s, int depth = 1) {
  const Scripted scripted(mesh(), std::vector<std::int32_t>(4, depth), s);
  std::vector<Result> results;
  for (const Check& check : checks())
    if (has_matter(check, mesh()))
      for (Result& r : check.run(*scripted)) results.push_back(std::move(r));
  return results;
}

Vector turned(const Vector& n, double radians) {
  Vector aside = cross(n, std::abs(n[0]) < .5 ? Vector{1, 0, 0} : Vector{0, 1, 0});
  for (double& x : aside)
    x *= std::tan(radians) / norm(cross(n, std::abs(n[0]) < .5 ? Vector{1, 0, 0} : Vector{0, 1, 0}));
  Vector t = n + aside;
  const double length = norm(t);
  for (double& x : t) x /= length;
  return t;
}

// Another vertex of the script at the same lattice point as vertex `of`.
std::size_t copy_of(const Script& s, std::size_t of) {
  const Lattice lattice(mesh(), 1);
  for (std::size_t v = 0; v < s.points.size(); ++v)
    if (v != of && lattice.id(place_of(s.points[v])) == lattice.id(place_of(s.points[of]))) return v;
  return of;
}

TEST(Rows, AllHoldOfTheExactSurface) {
  for (const Result& r : look(exact_script(mesh(), 1)))
    EXPECT_EQ(r.status, Status::kHeld) << r.check << ": " << r.message;
}

TEST(Rows, OfWhatIsCountedAllowNothing) {
  for (const Result& r : look(exact_script(mesh(), 1)))
    for (const char* exact : {"written", "finite", "orientation", "coverage", "shared-positions",
                              "shared-normals", "watertight", "t-vertices"})
      if (r.check == exact) {
        EXPECT_EQ(r.bound, 0.0) << exact;
      }
}

TEST(Rows, TheWorstPositionIsToldInDiagonalsInTheMeshsUnitAndInUlps) {
  for (const lc_precision precision : {LC_FLOAT32, LC_FLOAT64}) {
    Script s = exact_script(mesh(), 1);
    s.precision = precision;
    constexpr double kOff = 0x1p-10;
    const std::size_t v = 7;
    const Vector exact = s.positions[v];
    s.positions[v][2] += kOff;
    const double at = largest(exact);  // 2^k <= at < 2^(k + 1), and an ulp is 2^(k - 23) or 2^(k - 52)
    const double ulp = std::exp2(std::floor(std::log2(at)) - (precision == LC_FLOAT32 ? 23 : 52));
    const Result r = row(look(s), "positions");
    EXPECT_EQ(r.bad, 1);
    ASSERT_TRUE(r.worst && r.worst_absolute && r.worst_ulps);
    const double rounding = precision == LC_FLOAT32 ? 1e-7 : 1e-15;  // of the position itself
    EXPECT_NEAR(*r.worst, kOff, rounding) << "the script's diagonal is 1";
    EXPECT_NEAR(*r.worst_absolute, kOff, rounding);
    EXPECT_NEAR(*r.worst_ulps, kOff / ulp, rounding / ulp);
    EXPECT_EQ(r.witness->vertex, 7);
  }
}

TEST(Ulp, IsTheSpacingOfNumbersAlsoOfTheSmallestOnes) {
  EXPECT_EQ(ulp_at(1, LC_FLOAT64), 0x1p-52);
  EXPECT_EQ(ulp_at(1.999, LC_FLOAT32), 0x1p-23);
  EXPECT_EQ(ulp_at(8, LC_FLOAT32), 0x1p-20);
  for (const double tiny : {0.0, 1e-320})
    EXPECT_EQ(ulp_at(tiny, LC_FLOAT64), std::numeric_limits<double>::denorm_min());
  for (const double tiny : {0.0, 1e-43})
    EXPECT_EQ(ulp_at(tiny, LC_FLOAT32), static_cast<double>(std::numeric_limits<float>::denorm_min()));
}

TEST(Perimeter, IsTheSumOfThreeSides) {
  EXPECT_EQ(perimeter({0, 0, 0}, {3, 0, 0}, {3, 4, 0}), 12);
}

// One of two copies is off, by less and by more than two results may differ.
TEST(Rows, ContinuityAllowsTwoErrors) {
  const double position = position_bound(LC_FLOAT64, 1, 1, 1), normal = normal_bound(LC_FLOAT64, 1);
  for (const double times : {1.75, 2.25}) {
    Script s = exact_script(mesh(), 1);
    ASSERT_NE(copy_of(s, 1), 1U);
    s.positions[1][0] += times * position;
    const Result r = row(look(s), "continuity");
    EXPECT_EQ(r.status, times > 2 ? Status::kFinding : Status::kHeld) << times;
    // Positions are rounded to about 1e-16, the bound is 1e-14.
    EXPECT_NEAR(*r.worst, times / 2, 0.02);

    Script turned_normal = exact_script(mesh(), 1);
    turned_normal.normals[1] = turned(turned_normal.normals[1], times * normal / 57.295779513082320877);
    const Result n = row(look(turned_normal), "continuity");
    EXPECT_EQ(n.status, times > 2 ? Status::kFinding : Status::kHeld) << times;
    EXPECT_NEAR(*n.worst, times / 2, 0.001);
  }
}

// Points inside a face and points off the lattice are no business of two faces.
TEST(Rows, ContinuityLooksAtSharedPointsOnly) {
  Script s = exact_script(mesh(), 2);
  const Result whole = row(look(s, 2), "continuity");
  const auto inside = static_cast<std::size_t>(
      std::find_if(s.points.begin(), s.points.end(),
                   [](const auto& p) { return p.i > 0 && p.j > 0 && p.i + p.j < p.denominator; }) -
      s.points.begin());
  for (const lc_provenance& p : {s.points[inside], lc_provenance{0, 1, 2, 7}, lc_provenance{1, 1, 2, 7}}) {
    s.points.push_back(p);
    s.positions.push_back({5, 5, 5});
    s.normals.push_back({0, 0, 1});
  }
  const Result more = row(look(s, 2), "continuity");
  EXPECT_EQ(more.status, Status::kHeld) << more.message;
  EXPECT_EQ(more.of, whole.of);
}

TEST(Rows, NormalsAreJudgedWhereThereIsALimitPoint) {
  Script s = exact_script(mesh(), 1);
  const auto all = static_cast<std::int64_t>(s.points.size());
  s.points[3] = {0, 1, 2, 7};  // off the lattice
  const Result r = row(look(s), "normals");
  EXPECT_EQ(r.of, all - 1);
  EXPECT_EQ(row(look(s), "normal-length").of, all);

  Script refined = exact_script(mesh(), 1);
  refined.kind = LC_POINTS_REFINED;
  EXPECT_EQ(row(look(refined), "normals").status, Status::kNotRun);
  EXPECT_EQ(row(look(refined), "normal-length").status, Status::kHeld);
}

// The first vertex is a witness like any other.
TEST(Rows, TheFirstVertexMayBeTheWitness) {
  Script longer = exact_script(mesh(), 1), flipped = longer, moved = longer;
  for (double& x : longer.normals[0]) x *= 1.5;
  for (double& x : flipped.normals[0]) x *= -1;
  moved.positions[0][1] += 1e-3;
  const auto first = [](const Script& s, const char* check) {
    const Result r = row(look(s), check);
    EXPECT_EQ(r.status, Status::kFinding) << check;
    return r.witness ? r.witness->vertex : -1;
  };
  EXPECT_EQ(first(longer, "normal-length"), 0);
  EXPECT_EQ(first(flipped, "normals"), 0);
  EXPECT_EQ(first(flipped, "normals-against-positions"), 0);
  EXPECT_EQ(first(moved, "positions"), 0);
  const Result r = row(look(longer), "normal-length");
  EXPECT_NEAR(*r.worst, 0.5, 1e-15);
}

// Of all the triangles round a point of the tetrahedron at depth 0: the mean of three facets.
TEST(Rows, NormalsAgainstPositionsExpectTheMeanOfTheFacets) {
  Script s = exact_script(mesh(), 0);
  s.normals[0] = {-s.normals[0][0], -s.normals[0][1], -s.normals[0][2]};
  const Lattice lattice(mesh(), 0);
  Vector sum{};
  for (const auto& t : s.triangles)
    for (const std::uint32_t v : t)
      if (lattice.id(place_of(s.points[v])) == lattice.id(place_of(s.points[0])))
        sum = sum + cross(s.positions[t[1]] - s.positions[t[0]], s.positions[t[2]] - s.positions[t[0]]);
  const Result r = row(look(s, 0), "normals-against-positions");
  ASSERT_TRUE(r.witness.has_value());
  EXPECT_EQ(r.witness->vertex, 0);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(r.witness->expected[c], sum[c] / norm(sum), 1e-15);
}

TEST(Rows, WrittenCountsEveryFaceOfATriangleThatWasLeftOut) {
  Script s = exact_script(mesh(), 1);
  s.faces[2] = s.faces[5] = -1;
  const Result r = row(look(s), "written");
  EXPECT_TRUE(says(r.message, "2 control faces of triangles unwritten"));
  EXPECT_EQ(r.bad, 4) << "two unwritten, and the same two out of range: " << r.message;
}

TEST(Rows, WrittenCountsAWrongArrayOnce) {
  Script s = exact_script(mesh(), 1);
  s.points[4] = {0, 5, 0, 4};  // outside the face
  const Result r = row(look(s), "written");
  EXPECT_EQ(r.bad, 1) << r.message;
}

// A triangle that names a face which one of its corners does not touch is no hole in the surface.
TEST(Rows, WatertightIsNoMatterOfTheFaceThatATriangleNames) {
  Script s = exact_script(mesh(), 0);
  s.faces[0] = 1;
  const auto results = look(s, 0);
  EXPECT_EQ(row(results, "coverage").status, Status::kFinding);
  EXPECT_EQ(row(results, "watertight").status, Status::kHeld) << row(results, "watertight").message;

  // With a crack as well: its ends lie in no common face, and no point can be between them.
  s = exact_script(mesh(), 1);
  s.faces[0] = 1;
  s.positions[0][0] += 1e-3;
  const auto cracked = look(s);
  EXPECT_EQ(row(cracked, "watertight").status, Status::kFinding);
  EXPECT_EQ(row(cracked, "t-vertices").bad, 0) << row(cracked, "t-vertices").message;
}

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
      EXPECT_TRUE(says(row(results, normal ? "normals" : "positions").message,
                       normal ? "1 normals that are not finite are left out"
                              : "1 positions that are not finite are left out"));
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
