// SPDX-License-Identifier: MIT
// Independent methods, one surface: the paper's recursive subdivider, Stam's evaluator and OpenSubdiv's uniform
// refinement in double give the same limit points. What is known to be wrong in OpenSubdiv comes out by itself. And
// subjects with sharp edges and vertices on every shape that has a name.
#include <fmt/core.h>
#include <gtest/gtest.h>

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

}  // namespace

}  // namespace limitcheck::verify
