// SPDX-License-Identifier: MIT
// Subjects with sharp edges and vertices on every shape that has a name: ours without a finding, the others
// wherever the register of findings has nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "verify/audit/audit.h"
#include "verify/peers/test_sharp_shapes.h"
#include "verify/row/test_rows.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

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

TEST(SharpSubjects, RowStreamingHasNoFindingOnPolygons) {
  int asked = 0;
  for (const test::Named& shape : test::sharp_polygons())
    for (const Result& r : audited({find_subject("row-stream"), ""}, shape)) {
      EXPECT_NE(r.status, Status::kFinding)
          << shape.first << ", " << r.check << ", worst " << r.worst.value_or(-1) << ": " << r.message;
      if (r.check == "tessellates" && r.status == Status::kHeld) ++asked;
    }
  EXPECT_EQ(asked, static_cast<int>(test::sharp_polygons().size()));
}

TEST(SharpSubjects, NaiveHasNoFinding) {
  for (const auto& shapes : {test::sharp_polygons(), test::sharp_triangles()})
    for (const test::Named& shape : shapes)
      for (const Result& r : audited({find_subject("naive"), ""}, shape))
        EXPECT_NE(r.status, Status::kFinding)
            << shape.first << ", " << r.check << ", worst " << r.worst.value_or(-1) << ": " << r.message;
}

TEST(SharpSubjects, QuadModelHasNoFinding) {
  for (const test::Named& shape : test::sharp_polygons())
    for (const Result& r : audited({find_subject("quad-model"), ""}, shape))
      EXPECT_NE(r.status, Status::kFinding)
          << shape.first << ", " << r.check << ", worst " << r.worst.value_or(-1) << ": " << r.message;
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
