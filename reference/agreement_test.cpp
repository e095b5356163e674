// SPDX-License-Identifier: MIT
// The naive recursion, uniform refinement and Stam's evaluator find the same surface, in double.
#include <gtest/gtest.h>

#include <cmath>

#include "data/generators/named_mesh.h"
#include "reference/naive.h"
#include "reference/refine.h"
#include "reference/stam.h"

namespace limitcheck::reference {
namespace {

double diagonal(const data::ControlMesh& mesh) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = mesh.positions[0][k], high = low;
    for (const auto& p : mesh.positions) low = std::min(low, p[k]), high = std::max(high, p[k]);
    sum += (high - low) * (high - low);
  }
  return std::sqrt(sum);
}
double distance(const Vec3<double>& a, const Vec3<double>& b) {
  return std::sqrt(dot(a - b, a - b));
}

/// At every lattice point of every face: naive against refined mesh against evaluator. Returns the leaves
/// seen.
void compare(const std::string& name, int depth) {
  const data::ControlMesh mesh = data::named_mesh(name);
  const double box = diagonal(mesh), size = 1 << depth;
  const NaiveSubdivider<double> naive(mesh);
  const RefinedMesh<double> refined = refine<double>(mesh, depth);
  const auto limits = refined.limits();
  const StamEvaluator<double> stam(mesh);
  double position = 0, normal = 0;
  std::size_t leaves = 0, corners = 0;
  for (std::size_t f = 0; f < naive.face_count(); ++f) {
    naive.tessellate(f, depth, [&](const LeafTriangle<double>& leaf) {
      ++leaves;
      for (const auto& c : leaf) {
        const auto at = static_cast<std::size_t>(refined.vertex(f, c.i, c.j));
        const auto s = stam.evaluate(static_cast<int>(f), c.i / size, c.j / size, Order::kFirst);
        position = std::max(
            {position, distance(c.position, limits.positions[at]), distance(c.position, s.position)});
        // A boundary corner of many faces has a normal that tangents near it need not share (D5).
        normal = std::max({normal, distance(c.normal, limits.normals[at]), distance(c.normal, s.normal)});
        ++corners;
      }
    });
  }
  EXPECT_EQ(leaves, naive.face_count() << (2 * depth));
  EXPECT_LE(position, 1e-14 * box) << name;
  EXPECT_LE(normal, 1e-11) << name;
  testing::Test::RecordProperty(name + " position / box", std::to_string(position / box));
  std::printf("%-16s depth %d: position %.2g of the box, normal %.2g\n", name.c_str(), depth, position / box,
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
  EXPECT_EQ(refined.triangles().size(), mesh.triangles.size() * 64);
  EXPECT_EQ(refined.positions().size() - refined.topology().edges().size() + refined.triangles().size(),
            2U);  // Euler
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    EXPECT_EQ(refined.vertex(f, 0, 0), mesh.triangles[f][0]);
    EXPECT_EQ(refined.vertex(f, 8, 0), mesh.triangles[f][1]);
    EXPECT_EQ(refined.vertex(f, 0, 8), mesh.triangles[f][2]);
  }
}

TEST(Topology, RefusesWhatIsNotManifold) {
  const auto refuse = [](std::size_t vertices, std::vector<Triangle> triangles) {
    EXPECT_THROW(Topology(vertices, triangles), std::invalid_argument);
  };
  refuse(3, {{0, 1, 3}});                                          // no such vertex
  refuse(3, {{0, 1, 1}});                                          // repeated vertex
  refuse(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});                    // three faces at an edge, or a clash
  refuse(4, {{0, 1, 2}, {0, 1, 3}});                               // orientation clash
  refuse(5, {{0, 1, 2}, {0, 3, 4}});                               // bow-tie
  refuse(3, {{0, 1, 2}, {1, 0, 2}});                               // pillow: interior valence 2
  EXPECT_NO_THROW(Topology(5, std::vector<Triangle>{{0, 1, 2}}));  // isolated vertices are inert
}

TEST(Parameters, OutsideTheFaceAreRefused) {
  const StamEvaluator<double> stam(data::named_mesh("icosahedron"));
  for (const auto& [l1, l2] : {std::pair{-0.1, 0.5},
                               {0.5, -1e-300},
                               {0.6, 0.5},
                               {std::nan(""), 0.0},
                               {0.0, std::nan("")},
                               {HUGE_VAL, 0.0}})
    EXPECT_THROW(stam.evaluate(0, l1, l2), std::invalid_argument) << l1 << " " << l2;
  EXPECT_THROW(stam.evaluate(20, 0.0, 0.0), std::out_of_range);
  EXPECT_THROW(stam.evaluate(-1, 0.0, 0.0), std::out_of_range);
}

TEST(Parameters, AreReadExactlyOrRefused) {
  EXPECT_EQ(Parameter::parse("1/3").to_string(), "1/3");
  EXPECT_EQ(Parameter::parse("0.25").to_string(), "1/4");
  EXPECT_EQ(Parameter::parse("010").to_string(), "10");  // not octal
  EXPECT_EQ(Parameter::parse("2.5e-1").to_string(), "1/4");
  EXPECT_EQ(Parameter::parse(".5/2").to_string(), "1/4");
  EXPECT_EQ(Parameter(0.1).to_string(), "3602879701896397/36028797018963968");
  for (const char* bad : {"", "abc", "1/0", "1/", "/2", ".", "1e", "1e99999", "1e-999999999999", "0x10",
                          "1 2", "nan", "--1", "1/2/3", "1.2.3"})
    EXPECT_THROW(Parameter::parse(bad), std::invalid_argument) << bad;
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

}  // namespace
}  // namespace limitcheck::reference
