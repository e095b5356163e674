// SPDX-License-Identifier: MIT
// Independent methods, one surface: the paper's recursive subdivider, Stam's evaluator and OpenSubdiv's
// uniform refinement in double give the same limit points. And what is known to be wrong in OpenSubdiv comes
// out by itself.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/generators/named_mesh.h"
#include "reference/naive.h"
#include "reference/stam.h"
#include "verify/audit/audit.h"
#include "verify/audit/vector.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

Vector vector(const reference::Vec3<double>& v) {
  return {v.x, v.y, v.z};
}

double diagonal(const data::ControlMesh& mesh) {
  Vector low = mesh.positions[0], high = low;
  for (const Vector& p : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  return norm(high - low);
}

const Result& row(const std::vector<Result>& results, const std::string& check) {
  static const Result none;
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const Result& r) { return r.check == check; });
  EXPECT_NE(found, results.end()) << check;
  return found == results.end() ? none : *found;
}

std::vector<Result> audit(const char* subject, const std::string& options, const std::string& mesh,
                          int depth) {
  return Auditor(depth, 2).run({find_subject(subject), options}, {mesh, data::named_mesh(mesh)});
}

class Agreement : public testing::TestWithParam<const char*> {};

// Bound: 1e-14 of the box, some 45 roundings; worst seen 4e-16.
TEST_P(Agreement, TheNaiveSubdividerAndStamsEvaluatorGiveOneSurface) {
  const data::ControlMesh mesh = data::named_mesh(GetParam());
  const reference::NaiveSubdivider<double> naive(mesh);
  const reference::StamEvaluator<double> stam(mesh);
  const double box = diagonal(mesh);
  double worst = 0, worst_angle = 0;
  std::string where;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    naive.tessellate(f, 3, [&](const reference::LeafTriangle<double>& leaf) {
      for (const auto& corner : leaf) {
        const auto exact =
            stam.evaluate(static_cast<int>(f), corner.i / 8.0, corner.j / 8.0, reference::Order::kFirst);
        const double distance = norm(vector(exact.position) - vector(corner.position)) / box;
        if (!(distance <= worst)) {
          worst = distance;
          where = fmt::format("face {} ({}/8, {}/8)", f, corner.i, corner.j);
        }
        if (exact.normal_kind == reference::NormalKind::kRegular)
          worst_angle = std::max(worst_angle, angle_degrees(vector(exact.normal), vector(corner.normal)));
      }
    });
  RecordProperty("worst_position", fmt::format("{:.2e}", worst));
  RecordProperty("worst_normal_degrees", fmt::format("{:.2e}", worst_angle));
  EXPECT_LE(worst, 1e-14) << where;
  EXPECT_LE(worst_angle, 1e-9);
}

TEST_P(Agreement, OpenSubdivsUniformRefinementInDoubleGivesTheSame) {
  const auto results = audit("opensubdiv-far", "precision=double", GetParam(), 3);
  const Result& positions = row(results, "positions");
  ASSERT_EQ(positions.status, Status::kHeld) << positions.message;
  EXPECT_GT(positions.of, 0);
  EXPECT_EQ(positions.bound, 1e-14);
  RecordProperty("worst_position", fmt::format("{:.2e}", positions.worst.value_or(-1)));
}

INSTANTIATE_TEST_SUITE_P(Meshes, Agreement,
                         testing::Values("bumpy:200", "bumpy:800", "bumpy:4000", "tetrahedron", "bipyramid:7",
                                         "wheel:12", "wheel:200", "fan:1", "fan:2", "fan:3", "fan:4", "fan:5",
                                         "fan:8", "strip:6", "ragged-disc", "holes", "triangle",
                                         "two-components"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return c == ':' || c == '-'; }, '_');
                           return name;
                         });

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

}  // namespace
}  // namespace limitcheck::verify
