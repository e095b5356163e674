// SPDX-License-Identifier: MIT
// What makes a mask right, whatever its numbers: a step of subdivision leaves a limit where it is and shrinks
// a tangent by its eigenvalue. And the numbers that are known.
// The two evaluators of Catmull-Clark against each other, over valences,
// boundaries, faces of many corners and points very near a vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/splitmix64.h"
#include "reference/catmull_clark/patch.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/stam.h"
#include "reference/catmull_clark/vertex_limit.h"
#include "reference/loop/refine.h"
#include "reference/number/number_exact.h"
#include "reference/point/normal.h"
#include "reference/surface/test_methods.h"

namespace limitcheck::reference::catmull_clark {
namespace {

enum class Kind { kInside, kBoundary, kDart };

template <class N>
RingedCorner<Vec3<N>> random_corner(int faces, Kind kind) {
  data::SplitMix64 random(static_cast<std::uint64_t>(faces) + (kind == Kind::kBoundary ? 1000 : 0));
  const auto point = [&] {
    const auto number = [&] { return N(static_cast<int>(random.next() % 2001) - 1000) / N(64); };
    Vec3<N> p;
    p.x = number(), p.y = number(), p.z = number();
    return p;
  };
  RingedCorner<Vec3<N>> c;
  c.on_boundary = kind != Kind::kInside;
  if (kind == Kind::kDart) c.state = VertexState::kDart;
  c.point = point();
  for (int i = 0; i < faces + (kind == Kind::kBoundary ? 1 : 0); ++i) c.edges.push_back(point());
  if (kind == Kind::kDart) c.edges.push_back(Vec3<N>(c.edges.front()));
  for (int i = 0; i < faces; ++i) c.faces.push_back(point());
  return c;
}

TEST(CatmullClark_LimitMasks, StayExactlyWhereTheyAreInAStep) {
  for (const Kind kind : {Kind::kInside, Kind::kBoundary, Kind::kDart})
    for (int n = kind == Kind::kBoundary ? 1 : 3; n <= (kind == Kind::kDart ? 20 : 60); ++n) {
      const auto c = random_corner<Rational>(n, kind);
      EXPECT_EQ(limit_position(c), limit_position(subdivide<Rational>(c))) << n;
    }
}

TEST(CatmullClark_TangentMasks, ShrinkByTheirEigenvalueInAStep) {
  using N = Decimal100;
  const auto expect_shrunk = [](const Vec3<N>& after, const Vec3<N>& before, const N& lambda,
                                const std::string& what) {
    EXPECT_LE(magnitude(after - before * lambda), N("1e-94"))
        << what;  // some hundred roundings of numbers below 1000
    EXPECT_GT(magnitude(before), N("1e-3")) << what;
  };
  for (int n = 3; n <= 60; ++n) {
    const auto c = random_corner<N>(n, Kind::kInside);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N lambda = (four_lambda_minus_one<N>(n) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, lambda, "C at valence " + std::to_string(n));
    expect_shrunk(after.second, before.second, lambda, "S at valence " + std::to_string(n));
  }
  for (int k = 1; k <= 60; ++k) {
    const auto c = random_corner<N>(k, Kind::kBoundary);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N lambda = (four_lambda_minus_one<N>(2 * k) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, N(1) / N(2), "along " + std::to_string(k) + " faces");
    expect_shrunk(after.second, before.second, lambda, "across " + std::to_string(k) + " faces");
  }
  for (int n = 3; n <= 30; ++n) {
    const auto c = random_corner<N>(n, Kind::kDart);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N along = dot(after.first, before.first) / dot(before.first, before.first);
    const N lambda = (four_lambda_minus_one<N>(n) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, along, "along a dart of " + std::to_string(n));
    expect_shrunk(after.second, before.second, lambda, "across a dart of " + std::to_string(n));
    const double shrinks = along.convert_to<double>();
    const double known = n == 3   ? .462060590538
                         : n == 4 ? .5
                         : n == 5 ? .526424362162
                         : n == 8 ? .581909960445
                                  : shrinks;
    EXPECT_NEAR(shrinks, known, 1e-12) << n;
  }
}

// The table of the specification, to the digits it has.
TEST(CatmullClark_Eigenvalues, AreTheKnownOnes) {
  const auto lambda = [](long q) { return (four_lambda_minus_one<double>(q) + 1) / 4; };
  EXPECT_NEAR(lambda(3), .410097050800551892, 1e-15);
  EXPECT_NEAR(lambda(4), .5, 1e-15);
  EXPECT_NEAR(lambda(5), .549988354518297177, 1e-15);
  EXPECT_NEAR(lambda(12), .634796412353932187, 1e-15);
  EXPECT_NEAR(lambda(20), .647331902641664092, 1e-15);
}

// The masks at valence 4 are those of the bicubic B-spline.
TEST(CatmullClark_RegularVertex, IsTheBicubicSpline) {
  const auto c = random_corner<Rational>(4, Kind::kInside);
  Patch<Rational> p{};  // the vertex at (0, 0) of the patch; what lies beyond the ring has no weight there
  p[5] = c.point;
  p[6] = c.edges[0], p[9] = c.edges[1], p[4] = c.edges[2], p[1] = c.edges[3];
  p[10] = c.faces[0], p[8] = c.faces[1], p[0] = c.faces[2], p[2] = c.faces[3];
  const auto s = evaluate_patch<Rational>(p, Rational(0), Rational(0), Derivatives::kSecond);
  EXPECT_EQ(s.position, limit_position(c));
  // d/du is (4 (e_0 - e_2) + f_0 - f_1 - f_2 + f_3) / 12.
  EXPECT_EQ(s.a,
            ((c.edges[0] - c.edges[2]) * Rational(4) + c.faces[0] - c.faces[1] - c.faces[2] + c.faces[3]) *
                Rational(1, 12));
  EXPECT_EQ(s.ab, (c.faces[0] - c.faces[1] + c.faces[2] - c.faces[3]) * Rational(1, 4));
}

struct Case {
  std::string name;
  data::ControlMesh mesh;
  int faces;  // so many are looked at
};

std::vector<Case> cases() {
  std::vector<Case> all{{"cube", data::quad_cube(), 6}, {"torus", data::quad_torus(6, 5), 4}};
  for (const int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 50})
    all.push_back({"wheel " + std::to_string(n), data::quad_wheel(n, 7), 4});
  for (int k = 1; k <= 6; ++k)
    all.push_back({"fan " + std::to_string(k), data::quad_fan(k, 11), std::min(4 * k, 8)});
  for (int n = 3; n <= 8; ++n) all.push_back({"prism " + std::to_string(n), data::polygon_prism(n), 4});
  return all;
}

int corners_of(const Case& c, int face) {
  const auto n = static_cast<int>(c.mesh.faces[static_cast<std::size_t>(face)].size());
  return n == 4 ? 1 : n;
}

/// A unit in the last place of the largest coordinate.
double unit_of(const data::ControlMesh& mesh) {
  double largest = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  return largest * 0x1p-52;
}

// Parameters inside, on edges and at corners, ordinary and very near corner 0, 1 and 2. The nearest is for
// Stam's evaluator alone: subdivision would take a thousand steps and lose 300 digits.
std::vector<std::array<Parameter, 2>> parameters(bool nearest) {
  const auto p = [](const char* text) { return Parameter::parse(text); };
  std::vector<std::array<Parameter, 2>> all{
      {p("1/3"), p("1/4")},  {p("1/2"), p("1/8")},      {p("3/4"), p("1")},       {p("1/1000"), p("1/3000")},
      {p("0"), p("1/7")},    {p("2/7"), p("0")},        {p("1e-30"), p("3e-31")}, {p("0"), p("1e-12")},
      {p("1"), p("1/1024")}, {p("0.999"), p("0.9995")}, {p("1/2"), p("1/2")},     {p("0"), p("0")},
      {p("1"), p("1")},      {p("1"), p("1e-9")}};
  if (nearest) all.push_back({p("1e-300"), p("1e-299")});
  return all;
}

double size(const Vec3<Decimal50>& a) {
  return magnitude(a).convert_to<double>();
}
Vec3<Decimal50> to_decimal(const Vec3<double>& a) {
  return {Decimal50(a.x), Decimal50(a.y), Decimal50(a.z)};
}

// At 1e-30 from a vertex subdivision takes 101 steps.
TEST(CatmullClark_Evaluators, AgreeToWhatSubdivisionLoses) {
  for (const Case& c : cases()) {
    const Methods<Decimal100> by(c.mesh, data::Scheme::kCatmullClark);
    for (int face = 0; face < c.faces; ++face)
      for (int corner = 0; corner < corners_of(c, face); ++corner)
        for (const auto& [u, v] : parameters(false))
          expect_same(by.by_steps(face, corner, u, v), by.stam(face, corner, u, v), 101,
                      c.name + " face " + std::to_string(face) + ":" + std::to_string(corner) + " (" +
                          u.to_string().substr(0, 12) + ", " + v.to_string().substr(0, 12) + ")");
  }
}

// In double, against a hundred digits of the same mesh, in units of the last place of its largest coordinate.
TEST(CatmullClark_Evaluators, InDoubleWithinAFewUnits) {
  for (const Case& c : cases()) {
    const double ulp = unit_of(c.mesh);
    const StamEvaluator<Decimal50> exact(c.mesh.faces, positions_of<Decimal50>(c.mesh));
    const StamEvaluator<double> stam(c.mesh.faces, positions_of<double>(c.mesh));
    const SubdivisionEvaluator<double> steps(c.mesh.faces, positions_of<double>(c.mesh));
    double position = 0, by_steps = 0, promised = 0, normal = 0, turned = 0;
    for (int face = 0; face < c.faces; ++face)
      for (int corner = 0; corner < corners_of(c, face); ++corner)
        for (const auto& [u, v] : parameters(true)) {
          const auto want = exact.evaluate(face, corner, u, v);
          const auto got = stam.evaluate(face, corner, u, v), other = steps.evaluate(face, corner, u, v);
          position = std::max(position, size(to_decimal(got.position) - want.position) / ulp);
          by_steps = std::max(by_steps, size(to_decimal(other.position) - want.position) / ulp);
          if (want.first_exist) {
            // What t1_terms promises, and the J-th power of a rounded eigenvalue, J steps towards a corner.
            const double x = u.as_double(), y = v.as_double();
            const double steps_to_corner = 2 - std::log2(std::max(std::min(x, 1 - x), std::min(y, 1 - y)));
            const auto off = [&](const Vec3<double>& d, const Vec3<Decimal50>& truth, double terms) {
              return size(to_decimal(d) - truth) / (0x1p-53 * (terms + steps_to_corner * size(truth)));
            };
            promised =
                std::max({promised, off(got.d1, want.d1, got.t1_terms), off(got.d2, want.d2, got.t2_terms)});
          }
          if (got.normal_kind != NormalKind::kRegular || want.normal_kind != NormalKind::kRegular) continue;
          const double error = size(to_decimal(got.normal) - want.normal) / 0x1p-52;
          normal = std::max(normal, error);
          turned = std::max(turned, error / std::max(1., got.normal_condition));
        }
    std::printf(
        "%-9s position %.2f (by steps %.2f), derivatives %.3g, normal %.3g, over its condition %.3g\n",
        c.name.c_str(), position, by_steps, promised, normal, turned);
    EXPECT_LE(position, 1) << c.name;  // as stam.h says
    EXPECT_LE(by_steps, 4) << c.name;
    EXPECT_LE(promised, 4) << c.name;  // as stam.h says
    EXPECT_LE(turned, kRoundingsOfATangent) << c.name;
  }
}

// Four ways to one point: the recursion, the refinement of the whole mesh, both evaluators. In units of the
// last place of the largest coordinate; normals, where the tangents are not parallel, against their
// condition.
TEST(CatmullClark_Tessellations, AreTheEvaluatorsPoints) {
  double worst = 0, worst_normal = 0;
  for (const Case& c : cases()) {
    const double unit = unit_of(c.mesh);
    for (int depth = 0; depth <= 3; ++depth)
      each_lattice_point<double>(
          c.mesh, data::Scheme::kCatmullClark, depth,
          [&](const auto& naive, const auto& limits, std::size_t v, const auto& want) {
            worst = std::max({worst, magnitude(naive.position - want.position) / unit,
                              magnitude(limits.positions[v] - want.position) / unit});
            EXPECT_EQ(naive.normal_kind, limits.kinds[v]) << c.name;
            if (naive.normal_kind != NormalKind::kRegular || want.normal_kind != NormalKind::kRegular) return;
            const double bound = 0x1p-52 * std::max(8., want.normal_condition);
            worst_normal = std::max({worst_normal, magnitude(naive.normal - want.normal) / bound,
                                     magnitude(limits.normals[v] - want.normal) / bound});
          });
  }
  std::printf("position %.2f, normal over its condition %.2f\n", worst, worst_normal);
  EXPECT_LE(worst, 4);
  EXPECT_LE(worst_normal, kRoundingsOfATangent);
}

// Meshes that nobody draws: all points in one place, a quad without width, a hub of a thousand faces.
TEST(CatmullClark_Evaluators, NeverGiveNaN) {
  data::ControlMesh point = data::quad_wheel(5, 1), needle = data::quad_fan(3, 1);
  for (auto& p : point.positions) p = {1, 2, 3};
  for (auto& p : needle.positions) p[1] = p[2] = 0;
  for (const auto& mesh : {point, needle, data::quad_wheel(1000, 1), data::quad_fan(40, 1)}) {
    const StamEvaluator<double> stam(mesh.faces, positions_of<double>(mesh));
    const SubdivisionEvaluator<double> steps(mesh.faces, positions_of<double>(mesh));
    for (const auto& [u, v] : parameters(false)) {
      const auto a = stam.evaluate(0, 0, u, v), b = steps.evaluate(0, 0, u, v);
      for (const auto& p : {a, b}) {
        EXPECT_NEAR(dot(p.normal, p.normal), 1, 1e-14);
        EXPECT_TRUE(std::isfinite(dot(p.position, p.position)));
      }
      EXPECT_LE(magnitude(a.position - b.position), 16 * 0x1p-52 * 4);  // coordinates below 4
    }
  }
  const StamEvaluator<double> stam(point.faces, positions_of<double>(point));
  EXPECT_EQ(stam.evaluate(0, 0, 0., 0.).normal_kind, NormalKind::kArbitrary);
  EXPECT_EQ(stam.evaluate(0, 0, 0.3, 0.7).position, (Vec3<double>{1, 2, 3}));
}

}  // namespace
}  // namespace limitcheck::reference::catmull_clark
