// SPDX-License-Identifier: MIT
// Tilings that are not the regular one: those of repaired cracks, and those of mistakes.
#include <gtest/gtest.h>

#include <vector>

#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "verify/audit/audit.h"
#include "verify/checks/checks.h"
#include "verify/evidence/test_script.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using test::Script;
using test::Scripted;

// The pair: face 0 with the scripted triangles at depth 1, its neighbour at depth 2 with none.
Result coverage_of_face_0(Script s) {
  s.faces.assign(s.triangles.size(), 0);
  return check_coverage(*Scripted(data::triangle_pair(), {1, 2}, std::move(s))).at(0);
}

// The edge of face 0 that it shares with the finer face 1, as the corner it begins at.
int shared_edge() {
  const data::ControlMesh mesh = data::triangle_pair();
  const Lattice lattice(mesh, 2);
  for (int k = 0; k < 3; ++k)
    if (lattice.across(0, k) >= 0) return k;
  return -1;
}

// A fan round one point, out to the border.
Script fan_round(lc_provenance middle, const std::vector<lc_provenance>& rim) {
  Script s{.points = rim};
  const auto count = static_cast<std::uint32_t>(rim.size());
  s.points.push_back(middle);
  for (std::uint32_t k = 0; k < count; ++k) s.triangles.push_back({count, k, (k + 1) % count});
  return s;
}

// Counter-clockwise round face 0, in steps of 1/n; of 1/(2 n) along the edge that begins at corner `fine`.
std::vector<lc_provenance> rim(std::uint32_t n, int fine) {
  std::vector<lc_provenance> points;
  const std::uint32_t m = 2 * n;
  for (int k = 0; k < 3; ++k)
    for (std::uint32_t a = 0; a < m; a += k == fine ? 1 : 2)
      points.push_back(k == 0   ? lc_provenance{0, a, 0, m}
                       : k == 1 ? lc_provenance{0, m - a, a, m}
                                : lc_provenance{0, 0, m - a, m});
  return points;
}

// Two points per coarse side and four on the shared one, fanned out from the centre.
Script fan() {
  return fan_round({0, 1, 1, 3}, rim(2, shared_edge()));
}

TEST(Coverage, AFanRoundTheCentreTilesAFaceNextToAFinerOne) {
  const Result r = coverage_of_face_0(fan());
  EXPECT_EQ(r.bad, 1) << "face 1 only, which has no triangles: " << r.message;
  EXPECT_EQ(r.witness->face, 1);
}

TEST(Coverage, AMissingARepeatedOrAnOverlappingTriangleOfAFanIsSeen) {
  Script missing = fan();
  missing.triangles.pop_back();
  EXPECT_EQ(coverage_of_face_0(missing).bad, 2);

  Script repeated = fan();
  repeated.triangles.push_back(repeated.triangles[1]);
  EXPECT_EQ(coverage_of_face_0(repeated).bad, 2);

  Script folded = fan();  // the same area is covered, but one triangle reaches over its neighbour
  folded.triangles[0][2] =
      (folded.triangles[0][2] + 1) % static_cast<std::uint32_t>(folded.points.size() - 1);
  EXPECT_EQ(coverage_of_face_0(folded).bad, 2);
}

// One face of depth d, alone.
Result coverage_of_triangle(int depth, Script s) {
  s.faces.assign(s.triangles.size(), 0);
  return check_coverage(*Scripted(data::triangle(), {depth}, std::move(s))).at(0);
}

// The lattice of one face of depth d, row by row in l2, and the number of a point in it.
std::vector<lc_provenance> lattice_points(std::uint32_t n) {
  std::vector<lc_provenance> points;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i + j <= n; ++i) points.push_back({0, i, j, n});
  return points;
}
std::uint32_t point(std::uint32_t n, std::uint32_t i, std::uint32_t j) {
  return j * (n + 1) - j * (j - 1) / 2 + i;
}

// Unit triangles, or the same points with every rhombus inside cut along its long diagonal: up (i, j) and the
// down triangle to its left make (i, j) (i+1, j) (i-1, j+1) (i, j+1).
Script tiling(std::uint32_t n, bool other_diagonals) {
  Script s{.points = lattice_points(n)};
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return point(n, i, j); };
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i + j < n; ++i) {
      if (!other_diagonals || i == 0) s.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (other_diagonals && i > 0) {
        s.triangles.push_back({at(i, j), at(i + 1, j), at(i - 1, j + 1)});
        s.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i - 1, j + 1)});
      }
      if (!other_diagonals && i + j + 1 < n)
        s.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return s;
}

TEST(Coverage, TakesATilingAlongTheOtherDiagonals) {
  for (const int depth : {1, 2, 3}) {
    const std::uint32_t n = 1U << depth;
    ASSERT_EQ(tiling(n, true).triangles.size(), n * n);
    EXPECT_NE(tiling(n, true).triangles, tiling(n, false).triangles);
    for (const bool other : {false, true}) {
      const Result r = coverage_of_triangle(depth, tiling(n, other));
      EXPECT_EQ(r.status, Status::kHeld) << depth << " " << other << " " << r.message;
    }
  }
}

TEST(Coverage, SeesAHoleAnOverlapAndBothAmongOtherDiagonals) {
  Script hole = tiling(8, true), overlap = tiling(8, true), both = tiling(8, true);
  hole.triangles.erase(hole.triangles.begin() + 20);
  overlap.triangles.push_back(overlap.triangles[20]);
  both.triangles[20] = both.triangles[21];
  const Result missing = coverage_of_triangle(3, hole), twice = coverage_of_triangle(3, overlap),
               mixed = coverage_of_triangle(3, both);
  EXPECT_EQ(missing.message, "1 faces with holes");
  EXPECT_EQ(twice.message, "1 faces covered more than once");
  EXPECT_EQ(mixed.message, "1 faces with holes; 1 faces covered more than once");
  for (const Result& r : {missing, twice, mixed}) {
    EXPECT_EQ(r.bad, 1);
    EXPECT_EQ(r.of, 1);
    ASSERT_TRUE(r.witness.has_value());
    EXPECT_FALSE(r.witness->l1.empty());
  }
}

// What is wrong is counted in faces, however many triangles are.
TEST(Coverage, CountsFaces) {
  Script s = tiling(8, false);
  s.triangles.resize(10);
  EXPECT_EQ(coverage_of_triangle(3, s).bad, 1);
  Script stray = tiling(8, false);  // all triangles are said to lie in the face next to theirs
  stray.faces.assign(stray.triangles.size(), 1);
  const Result r = check_coverage(*Scripted(data::triangle_pair(), {3, 3}, stray)).at(0);
  EXPECT_EQ(r.bad, 2) << r.message;
  EXPECT_EQ(r.of, 2);
}

TEST(Coverage, AFaceDisplayedLessDeepThanAskedLacksLatticePoints) {
  Script s = tiling(4, false);
  for (lc_provenance& p : s.points) p = {0, 2 * p.i, 2 * p.j, 8};
  const Result r = coverage_of_triangle(3, s);
  EXPECT_EQ(r.status, Status::kFinding);
  EXPECT_EQ(r.message, "1 faces without all lattice points of their depth");
}

TEST(Coverage, AFaceDisplayedDeeperThanAnyNeighbourIsFoundOut) {
  Script s = tiling(4, false);
  s.faces.assign(s.triangles.size(), 0);
  // On a mesh whose other face is asked for depth 2 too, but culled: no reason to be deeper than 1.
  const Result r =
      check_coverage(*Scripted(
                         data::two_components(),
                         [] {
                           std::vector<std::int32_t> depth(data::two_components().faces.size(), 2);
                           std::fill(depth.begin(), depth.begin() + 4, 1);
                           return depth;
                         }(),
                         s))
          .at(0);
  EXPECT_TRUE(says(r.message, "1 faces with corners between the lattice points of their depth"));
}

// Asked for depth 2, beside a face of depth 3: a fan leaves out the points inside, all of them if it is the
// paper's fan round the centre.
TEST(Coverage, AFanBesideADeeperFaceLacksThePointsInside) {
  const lc_provenance centre{0, 1, 1, 3}, inside{0, 1, 1, 4};
  const auto of_face_0 = [](Script s) {
    s.faces.assign(s.triangles.size(), 0);
    return check_coverage(*Scripted(data::triangle_pair(), {2, 3}, std::move(s))).at(0);
  };
  const Result paper = of_face_0(fan_round(centre, rim(4, shared_edge())));
  EXPECT_EQ(paper.bad, 2) << "face 1 too, which has no triangles: " << paper.message;
  EXPECT_EQ(
      paper.message,
      "1 faces with holes; 2 faces without all lattice points of their depth; 1 faces of these fans round "
      "their centre, as the paper repairs cracks");
  EXPECT_EQ(paper.witness->face, 0);
  EXPECT_EQ(paper.witness->l1 + " " + paper.witness->l2, "1/4 1/4") << "the first of those missing";

  const Result one_point = of_face_0(fan_round(inside, rim(4, shared_edge())));
  EXPECT_EQ(one_point.bad, 2) << one_point.message;
  EXPECT_EQ(one_point.witness->face, 0);
  EXPECT_EQ(one_point.witness->l1 + " " + one_point.witness->l2, "1/2 1/4");
}

TEST(Coverage, AFanWithoutThePointsOfItsBorderIsFoundOut) {
  Script s = fan();  // asked for 2, its border has depth 1
  s.faces.assign(s.triangles.size(), 0);
  const Result r = check_coverage(*Scripted(data::triangle_pair(), {2, 3}, s)).at(0);
  EXPECT_EQ(r.bad, 2) << r.message;
}

// Fans are right where there is nothing inside: up to depth 1.
TEST(Coverage, HoldsForStitchedBordersAndForFansOfShallowFaces) {
  const auto coverage = [](const char* subject, const char* options, int most) {
    AuditMesh mesh{"wheel:7", data::wheel(7)};
    for (std::size_t f = 0; f < mesh.mesh.faces.size(); ++f) {
      const auto depth = static_cast<std::int32_t>((5 * f) % 6) - 1;
      mesh.face_depth.push_back(depth > most && depth < 4 ? most : depth);
    }
    const auto results = Auditor(4, 1).run({find_subject(subject), options}, mesh);
    EXPECT_EQ(row(results, "watertight").status, Status::kHeld) << row(results, "watertight").message;
    return row(results, "coverage");
  };
  for (const char* subject : {"sliding-window", "row-stream"}) {
    EXPECT_EQ(coverage(subject, "", 4).status, Status::kHeld) << coverage(subject, "", 4).message;
    EXPECT_EQ(coverage(subject, "repair=fan", 1).status, Status::kHeld)
        << coverage(subject, "repair=fan", 1).message;
    EXPECT_EQ(coverage(subject, "repair=fan", 4).status, Status::kFinding);
  }
}

}  // namespace
}  // namespace limitcheck::verify
