// SPDX-License-Identifier: MIT
// The naive recursion, uniform refinement and Stam's evaluator find the same surface, in double.
#include <gtest/gtest.h>

#include <cmath>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "reference/surface/test_methods.h"

namespace limitcheck::reference {
namespace {

void compare(const std::string& name, int depth) {
  const data::ControlMesh mesh = data::named_mesh(name);
  double position = 0, normal = 0;
  each_lattice_point<double>(mesh, data::Scheme::kLoop, depth,
                             [&](const auto& naive, const auto& limits, std::size_t v, const auto& stam) {
                               position = std::max({position, magnitude(naive.position - limits.positions[v]),
                                                    magnitude(naive.position - stam.position)});
                               // A boundary corner of many faces has a normal that tangents near it need not share (D5).
                               normal = std::max({normal, magnitude(naive.normal - limits.normals[v]),
                                                  magnitude(naive.normal - stam.normal)});
                               EXPECT_EQ(naive.normal_kind, limits.kinds[v]) << name;
                               EXPECT_EQ(naive.normal_kind, stam.normal_kind) << name;
                             });
  position /= data::box_diagonal(mesh);
  EXPECT_LE(position, NaiveError::kPosition) << name;
  EXPECT_LE(normal, NaiveError::kNormal) << name;
  std::printf("%-16s depth %d: position %.2g of the box, normal %.2g\n", name.c_str(), depth, position,
              normal);
}

TEST(Sec4_NaiveSubdivider, EqualsRefinementAndStamOnBumpySpheres) {
  for (const char* name : {"bumpy:200", "bumpy:800", "bumpy:4000"}) compare(name, 3);
}

TEST(Sec4_NaiveSubdivider, EqualsRefinementAndStamOnEveryStockShapeAndFan) {
  std::vector<std::string> names = data::stock_shapes();
  for (int k = 1; k <= 9; ++k) names.push_back("fan:" + std::to_string(k));
  names.push_back("wheel:200:1");
  for (const auto& name : names)
    for (const int depth : {0, 1, 4}) compare(name, depth);
}

TEST(Refinement, KeepsTheControlVerticesFirstAndTheMeshManifold) {
  const data::ControlMesh mesh = data::named_mesh("bumpy:200");
  const auto refined = refine<double>(mesh, 3);
  EXPECT_EQ(refined.triangles().size(), mesh.faces.size() * 64);
  EXPECT_EQ(refined.positions().size() - refined.topology().edges().size() + refined.triangles().size(),
            2U);  // Euler
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    EXPECT_EQ(refined.vertex(f, 0, 0), mesh.faces[f][0]);
    EXPECT_EQ(refined.vertex(f, 8, 0), mesh.faces[f][1]);
    EXPECT_EQ(refined.vertex(f, 0, 8), mesh.faces[f][2]);
  }
}

TEST(Refinement, ListsTheTrianglesInTheOrderItPromises) {
  const auto refined = refine<double>(data::named_mesh("octahedron"), 2);
  std::size_t next = 0;
  for (std::size_t f = 0; f < 8; ++f) {
    const auto at = [&](int i, int j) { return refined.vertex(f, i, j); };
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i + j < 4; ++i)
        EXPECT_EQ(refined.triangles()[next++], (Triangle{at(i, j), at(i + 1, j), at(i, j + 1)}));
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i + j < 3; ++i)
        EXPECT_EQ(refined.triangles()[next++], (Triangle{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}));
  }
}

TEST(Refinement, LeavesIsolatedVerticesWhereTheyAre) {
  data::ControlMesh mesh = data::named_mesh("octahedron");
  mesh.positions.push_back({7, 8, 9});
  const auto refined = refine<double>(mesh, 2);
  const auto limits = refined.limits();
  EXPECT_EQ(refined.positions()[6], (Vec3<double>{7, 8, 9}));
  EXPECT_EQ(limits.positions[6], (Vec3<double>{7, 8, 9}));
  EXPECT_EQ(limits.kinds[6], NormalKind::kArbitrary);
}

TEST(Parameters, OutsideTheFaceAreRefused) {
  const StamEvaluator<double> stam(data::named_mesh("icosahedron"));
  for (const auto& [l1, l2] : {std::pair{-0.1, 0.5},
                               {0.5, -1e-300},
                               {0.6, 0.5},
                               {std::nan(""), 0.0},
                               {0.0, std::nan("")},
                               {HUGE_VAL, 0.0}})
    EXPECT_THROW(stam.evaluate(0, l1, l2), data::ArgumentError) << l1 << " " << l2;
  EXPECT_THROW(stam.evaluate(20, 0.0, 0.0), data::ArgumentError);
  EXPECT_THROW(stam.evaluate(-1, 0.0, 0.0), data::ArgumentError);
}

TEST(Parameters, WhoseSumIsRoundedToOneLieOnTheEdge) {
  const data::ControlMesh mesh = data::named_mesh("tetrahedron");
  const StamEvaluator<double> stam(mesh);
  const SubdivisionEvaluator<double> subdivision(mesh);
  // Exactly, l1 + l2 exceeds 1, by 0.75 2^-53. Next to a corner it matters that the point is not taken for
  // one outside the face: the derivatives hang on the direction.
  const double l1 = 0x1.cp-53, l2 = 1 - 0x1p-53;
  ASSERT_EQ(l1 + l2, 1);
  const auto s = stam.evaluate(0, l1, l2), edge = stam.evaluate(0, 0x1p-53, l2);
  EXPECT_EQ(s.position, edge.position);
  EXPECT_EQ(s.d1, edge.d1);
  EXPECT_EQ(subdivision.evaluate(0, l1, l2).position, subdivision.evaluate(0, 0x1p-53, l2).position);
}

TEST(Parameters, AreReadExactlyOrRefused) {
  EXPECT_EQ(Parameter::parse("1/3").to_string(), "1/3");
  EXPECT_EQ(Parameter::parse("0.25").to_string(), "1/4");
  EXPECT_EQ(Parameter::parse("010").to_string(), "10");  // not octal
  EXPECT_EQ(Parameter::parse("2.5e-1").to_string(), "1/4");
  EXPECT_EQ(Parameter::parse(".5/2").to_string(), "1/4");
  EXPECT_EQ(Parameter::parse("-1.50").to_string(), "-3/2");
  EXPECT_EQ(Parameter::parse("2e+2").to_string(), "200");
  EXPECT_EQ(Parameter::fraction(-2, 6).to_string(), "-1/3");
  EXPECT_EQ(Parameter::complement(Parameter::parse("0.1"), Parameter::parse("1/5")).to_string(), "7/10");
  EXPECT_EQ(Parameter(0.1).to_string(), "3602879701896397/36028797018963968");
  EXPECT_THROW(Parameter::parse("1 2"), data::ArgumentError);
}

TEST(DegenerateSurfaces, HaveFiniteNormals) {
  data::ControlMesh point = data::named_mesh("octahedron"), line = point;
  for (auto& p : point.positions) p = {1, 2, 3};
  for (std::size_t v = 0; v < line.positions.size(); ++v) line.positions[v] = {static_cast<double>(v), 0, 0};
  for (const auto& mesh : {point, line}) {
    const StamEvaluator<double> stam(mesh);
    for (int f = 0; f < 8; ++f)
      for (const double l : {0.0, 1e-300, 1e-3, 0.25, 1.0 / 3}) {
        const auto s = stam.evaluate(f, l, l);
        EXPECT_NEAR(dot(s.normal, s.normal), 1, 1e-15);
        EXPECT_EQ(s.normal_kind, NormalKind::kArbitrary) << l;
      }
  }
}

/// A sheet whose surface is a line, to first order, at the centre of a face: there y's gradient is zero.
TEST(DegenerateSurfaces, FallBackToTheControlFacesNormal) {
  data::ControlMesh mesh = data::named_mesh("octahedron");
  const int face = 0;
  const Triangle t = triangles_of(mesh)[0];
  const auto gradient = [&](std::size_t vertex) {
    data::ControlMesh bump = mesh;
    for (auto& p : bump.positions) p = {};
    bump.positions[vertex][1] = 1;
    const auto s = StamEvaluator<double>(bump).evaluate(face, 0.25, 0.375);
    return std::array{s.d1.y, s.d2.y};
  };
  const auto corner = [&](std::size_t k) -> std::size_t { return t[k]; };
  std::vector<std::size_t> others;
  for (std::size_t v = 0; v < 6; ++v)
    if (v != corner(0) && v != corner(1) && v != corner(2)) others.push_back(v);
  const auto a = gradient(corner(0)), b = gradient(others[0]), c = gradient(others[1]);
  const double det = b[0] * c[1] - b[1] * c[0];
  for (auto& p : mesh.positions) p[1] = p[2] = 0;
  for (std::size_t v = 0; v < 6; ++v) mesh.positions[v][0] = static_cast<double>(v * v);
  mesh.positions[corner(0)][1] = 1;
  mesh.positions[others[0]][1] = (a[1] * c[0] - a[0] * c[1]) / det;
  mesh.positions[others[1]][1] = (a[0] * b[1] - a[1] * b[0]) / det;
  // y is 1 at corner 0, 0 at the others: twice the face's area is x(2) - x(1).
  const double up = mesh.positions[corner(2)][0] > mesh.positions[corner(1)][0] ? 1 : -1;
  const auto check = [&](const SurfacePoint<double>& s) {
    EXPECT_LE(std::abs(s.d1.y) + std::abs(s.d2.y), 1e-14);
    EXPECT_EQ(s.normal_kind, NormalKind::kFallback);
    EXPECT_EQ(s.normal, (Vec3<double>{0, 0, up}));
  };
  check(StamEvaluator<double>(mesh).evaluate(face, 0.25, 0.375));
  check(SubdivisionEvaluator<double>(mesh).evaluate(face, 0.25, 0.375));
}

}  // namespace
}  // namespace limitcheck::reference
