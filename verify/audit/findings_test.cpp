// SPDX-License-Identifier: MIT
// Independent methods, one surface: the paper's recursive subdivider, Stam's evaluator and OpenSubdiv's uniform
// refinement in double give the same limit points. What is known to be wrong in OpenSubdiv comes out by itself. And
// subjects with sharp edges and vertices on every shape that has a name.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/peers/test_sharp_shapes.h"
#include "verify/row/test_rows.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

std::vector<Result> audit(const char* subject, const std::string& options, const std::string& mesh,
                          int depth) {
  return Auditor(depth, 2).run({find_subject(subject), options}, {mesh, data::named_mesh(mesh)});
}

// The recursive subdivider in double against Stam's evaluator. Its points are those of the surface
// everywhere; only their bits depend on the face they are computed from (the paper sums in whatever order the
// face has). C60
TEST(Findings, TheNaiveSubdividerIsRightOnEveryShapeButNotBitwise) {
  std::vector<std::string> meshes = data::stock_shapes();
  meshes.insert(meshes.end(), {"bumpy:200", "bumpy:800", "bumpy:4000"});
  std::string worst_mesh;
  double worst = -1;
  for (const std::string& mesh : meshes) {
    const auto results = audit("naive", "", mesh, 3);
    for (const char* check :
         {"tessellates", "written", "finite", "positions", "normal-length", "orientation", "coverage"})
      EXPECT_EQ(row(results, check).status, Status::kHeld)
          << mesh << " " << check << " " << row(results, check).message;
    // Points that have no normal at all leave nothing to compare on the one-triangle shapes, never a finding.
    EXPECT_FALSE(is_bad(row(results, "normals"))) << mesh;
    EXPECT_LE(row(results, "shared-positions").worst.value_or(0), 1e-15) << mesh;
    if (row(results, "positions").worst.value_or(-1) > worst) {
      worst = *row(results, "positions").worst;
      worst_mesh = mesh;
    }
  }
  EXPECT_LE(worst, 1e-14);
  RecordProperty("worst_position", fmt::format("{:.2e} of the box on {}", worst, worst_mesh));
}

// Bound 1e-14 of the box (the check's own); boundary shapes
// included, where only OpenSubdiv's tangents are at fault.
TEST(Findings, OpenSubdivsUniformRefinementInDoubleHasTheRightPositionsOnEveryShape) {
  std::vector<std::string> meshes = data::stock_shapes();
  meshes.insert(meshes.end(), {"bumpy:200", "bumpy:800", "bumpy:4000"});
  for (const std::string& mesh : meshes) {
    const auto results = audit("opensubdiv-far", "precision=double", mesh, 3);
    EXPECT_EQ(row(results, "positions").status, Status::kHeld) << mesh;
    EXPECT_EQ(row(results, "positions").bound, 1e-14);
    EXPECT_EQ(row(results, "watertight").status, Status::kHeld) << mesh;
  }
}

TEST(Findings, BfrIsApproximateAtItsDefaultLevelAndExactAtLatticePointsWhenIsolatedAsDeep) {
  const auto by_default = audit("opensubdiv-bfr", "", "bumpy:200", 4);
  EXPECT_EQ(row(by_default, "positions").status, Status::kFinding);
  EXPECT_GT(row(by_default, "positions").worst, 1e-4);
  EXPECT_GT(row(by_default, "normals").worst, 5);
  ASSERT_TRUE(row(by_default, "positions").witness.has_value());
  const auto isolated = audit("opensubdiv-bfr", "approx-level=4", "bumpy:200", 4);
  EXPECT_EQ(row(isolated, "positions").status, Status::kHeld);
}

TEST(Findings, BfrGivesSharedPointsDifferentBitsOnTheTwoSidesOfAnEdge) {
  const auto results = audit("opensubdiv-bfr", "", "bumpy:800", 4);
  const Result& positions = row(results, "shared-positions");
  const Result& normals = row(results, "shared-normals");
  EXPECT_EQ(positions.status, Status::kFinding);
  EXPECT_GT(static_cast<double>(positions.bad), 0.75 * static_cast<double>(positions.of));
  EXPECT_GT(static_cast<double>(normals.bad), 0.95 * static_cast<double>(normals.of));
  EXPECT_LT(positions.worst, 1e-6) << "roundings, no gaps";
  EXPECT_EQ(row(results, "watertight").status, Status::kFinding);
}

TEST(Findings, OpenSubdivsTangentMaskIsWrongAtBoundaryVerticesOfFourAndFiveFacesOnly) {
  for (int faces = 1; faces <= 5; ++faces) {
    const auto results = audit("opensubdiv-far", "precision=double", fmt::format("fan:{}:1", faces), 1);
    const Result& normals = row(results, "normals");
    EXPECT_EQ(row(results, "positions").status, Status::kHeld) << faces;
    EXPECT_EQ(normals.status, faces >= 4 ? Status::kFinding : Status::kHeld) << faces;
    if (faces < 4) continue;
    EXPECT_GT(normals.worst, 0.1) << faces;
    ASSERT_TRUE(normals.witness.has_value());
    EXPECT_TRUE(normals.witness->l1 == "0" && normals.witness->l2 == "0")
        << "at the hub, corner 0 of its faces";
  }
}

TEST(Findings, BfrIsDegenerateAtBoundaryCornersOfOneFace) {
  for (const char* options : {"", "approx-level=3"}) {
    const auto results = audit("opensubdiv-bfr", options, "fan:1", 3);
    const Result& normals = row(results, "normals");
    EXPECT_EQ(normals.status, Status::kFinding);
    EXPECT_TRUE(!normals.worst || *normals.worst > 90) << *normals.worst;
  }
}

TEST(Findings, RefinementLibrariesDeliverNoLimitPointsAndAreRightInWhatTheyDeliver) {
  for (const char* subject : {"cgal", "openmesh"}) {
    const auto results = audit(subject, "", "bumpy:200", 3);
    EXPECT_EQ(row(results, "positions").status, Status::kNotSupported) << subject;
    EXPECT_EQ(row(results, "refined-positions").status, Status::kHeld) << subject;
    EXPECT_LE(row(results, "refined-positions").worst, 1e-14) << subject;
    EXPECT_EQ(row(results, "watertight").status, Status::kHeld) << subject;
  }
}

std::vector<Result> audited(const AuditSubject& subject, const test::Named& shape) {
  Auditor auditor(2, 1, {}, Level::kQuick);
  return auditor.run(subject, {shape.first, shape.second});
}

bool corners_held(const data::ControlMesh& mesh) {
  return mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner;
}

// Whether all edges are of one whole sharpness that falls, and vertices of whole ones.
bool falls_in_whole_steps(const data::ControlMesh& mesh) {
  std::set<float> of_edges, whole;
  for (const data::SharpEdge& e : mesh.sharpness.edges) of_edges.insert(e.sharpness);
  whole = of_edges;
  for (const data::SharpVertex& v : mesh.sharpness.vertices) whole.insert(v.sharpness);
  return of_edges.size() <= 1 && !of_edges.contains(test::kInfinite) &&
         std::all_of(whole.begin(), whole.end(), [](float s) { return s == std::floor(s); });
}

// Neither engine of ours does semi-sharp edges of triangles: they say so, and are not asked.
TEST(SharpSubjects, OurEnginesHaveNoFindingOnTriangles) {
  int asked = 0;
  for (const AuditSubject& subject : {AuditSubject{find_subject("sliding-window"), "precision=double"},
                                      AuditSubject{find_subject("sliding-window"), "output=indexed"},
                                      AuditSubject{find_subject("row-stream"), ""}})
    for (const test::Named& shape : test::sharp_triangles()) {
      const bool does = (sharp_kinds(shape.second, data::Scheme::kLoop) & LC_SHARP_SEMI) == 0;
      const std::vector<Result> results = audited(subject, shape);
      EXPECT_EQ(row(results, "tessellates").status, does ? Status::kHeld : Status::kNotSupported)
          << subject.subject->name << " on " << shape.first << ": " << row(results, "tessellates").message;
      for (const Result& r : results)
        EXPECT_NE(r.status, Status::kFinding)
            << subject.subject->name << " on " << shape.first << ", " << r.check << ": " << r.message;
      asked += does;
    }
  EXPECT_GT(asked, 150);
}

// Row streaming takes each of them.
TEST(SharpSubjects, OfOursHaveNoFindingOnPolygonsAndNaiveNoneOnTrianglesEither) {
  using Shapes = std::vector<test::Named>;
  for (const auto& [subject, shapes] : {std::pair<const char*, Shapes>{"row-stream", test::sharp_polygons()},
                                        {"quad-model", test::sharp_polygons()},
                                        {"naive", test::sharp_polygons()},
                                        {"naive", test::sharp_triangles()}})
    for (const test::Named& shape : shapes)
      for (const Result& r : audited({find_subject(subject), ""}, shape)) {
        EXPECT_NE(r.status, Status::kFinding) << subject << " on " << shape.first << ", " << r.check
                                              << ", worst " << r.worst.value_or(-1) << ": " << r.message;
        if (r.check == "tessellates" && std::string(subject) == "row-stream") {
          EXPECT_EQ(r.status, Status::kHeld) << shape.first;
        }
      }
}

TEST(SharpSubjects, OpenSubdivsPatchesAreRightButAtDarts) {
  int held = 0, darts = 0;
  std::vector<test::Named> shapes = test::sharp_polygons(), of_triangles = test::sharp_triangles();
  shapes.insert(shapes.end(), of_triangles.begin(), of_triangles.end());
  for (const test::Named& shape : shapes) {
    if (!corners_held(shape.second)) continue;  // bfr-smooth-corner-normals, far-patches-smooth-corner
    for (const AuditSubject& subject :
         {AuditSubject{find_subject("opensubdiv-bfr"), "precision=double,approx-level=5"},
          AuditSubject{find_subject("opensubdiv-far-patches"), "precision=double,level=5,inf-sharp=on"}}) {
      const auto results = audited(subject, shape);
      const Result& positions = row(results, "positions");
      const bool dart = has_darts(shape.second);  // bfr-dart-position
      EXPECT_EQ(positions.status, dart ? Status::kFinding : Status::kHeld)
          << subject.label() << " on " << shape.first << ", worst " << positions.worst.value_or(-1);
      ++(dart ? darts : held);
    }
  }
  EXPECT_GT(held, 300);
  EXPECT_GT(darts, 60);
}

TEST(SharpSubjects, EmbreeIsRightWhereSharpnessFallsInWholeSteps) {
  int judged = 0;
  for (const test::Named& shape : test::sharp_polygons()) {
    if (!corners_held(shape.second) || !falls_in_whole_steps(shape.second)) continue;
    const auto results = audited({find_subject("embree"), ""}, shape);
    const Result& positions = row(results, "positions");
    EXPECT_EQ(positions.status, Status::kHeld) << shape.first << ", worst " << positions.worst.value_or(-1);
    ++judged;
  }
  EXPECT_GT(judged, 30);
}

}  // namespace

}  // namespace limitcheck::verify
