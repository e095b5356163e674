// SPDX-License-Identifier: MIT
// What makes a mask right, whatever its numbers: a step of subdivision leaves a limit where it is and shrinks
// a tangent by its eigenvalue. And the numbers that are known.
// The two evaluators of Catmull-Clark against each other and against exact rationals, over valences,
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

namespace limitcheck::reference::catmull_clark {
namespace {

template <class N>
RingedCorner<Vec3<N>> random_corner(int faces, bool on_boundary) {
  data::SplitMix64 random(static_cast<std::uint64_t>(faces) + (on_boundary ? 1000 : 0));
  const auto point = [&] {
    const auto number = [&] { return N(static_cast<int>(random.next() % 2001) - 1000) / N(64); };
    Vec3<N> p;
    p.x = number(), p.y = number(), p.z = number();
    return p;
  };
  RingedCorner<Vec3<N>> c;
  c.on_boundary = on_boundary;
  c.point = point();
  for (int i = 0; i < faces + (on_boundary ? 1 : 0); ++i) c.edges.push_back(point());
  for (int i = 0; i < faces; ++i) c.faces.push_back(point());
  return c;
}

TEST(CatmullClark_LimitMasks, StayExactlyWhereTheyAreInAStep) {
  for (int n = 3; n <= 60; ++n) {
    const auto c = random_corner<Rational>(n, false);
    EXPECT_EQ(limit_position(c), limit_position(subdivide<Rational>(c))) << n;
  }
  for (int k = 1; k <= 60; ++k) {
    const auto c = random_corner<Rational>(k, true);
    EXPECT_EQ(limit_position(c), limit_position(subdivide<Rational>(c))) << k;
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
    const auto c = random_corner<N>(n, false);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N lambda = (four_lambda_minus_one<N>(n) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, lambda, "C at valence " + std::to_string(n));
    expect_shrunk(after.second, before.second, lambda, "S at valence " + std::to_string(n));
  }
  for (int k = 1; k <= 60; ++k) {
    const auto c = random_corner<N>(k, true);
    const auto before = limit_tangents(c), after = limit_tangents(subdivide<N>(c));
    const N lambda = (four_lambda_minus_one<N>(2 * k) + N(1)) / N(4);
    expect_shrunk(after.first, before.first, N(1) / N(2), "along " + std::to_string(k) + " faces");
    expect_shrunk(after.second, before.second, lambda, "across " + std::to_string(k) + " faces");
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
  const auto c = random_corner<Rational>(4, false);
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
template <class N>
Vec3<Decimal50> to_decimal(const Vec3<N>& a) {
  const auto number = [](const N& x) {
    if constexpr (std::is_same_v<N, Rational>)
      return NumberTraits<Decimal50>::from_rational(x);
    else
      return Decimal50(x);
  };
  return {number(a.x), number(a.y), number(a.z)};
}

// To what subdivision loses in a hundred digits, relative to the size of what is compared, or to 1: at 1e-30
// from a vertex it takes 101 steps, and differences of order d between points 2^-101 apart lose d * 30.4
// digits. A few roundings make two digits more.
TEST(CatmullClark_Evaluators, AgreeToWhatSubdivisionLoses) {
  double worst_position = 0, worst_first = 0, worst_second = 0, worst_normal = 0;
  for (const Case& c : cases()) {
    const SubdivisionEvaluator<Decimal100> one(c.mesh.faces, positions_of<Decimal100>(c.mesh));
    const StamEvaluator<Decimal100> other(c.mesh.faces, positions_of<Decimal100>(c.mesh));
    for (int face = 0; face < c.faces; ++face)
      for (int corner = 0; corner < corners_of(c, face); ++corner)
        for (const auto& [u, v] : parameters(false)) {
          const auto a = one.evaluate(face, corner, u, v), b = other.evaluate(face, corner, u, v);
          const auto error = [](const Vec3<Decimal100>& x, const Vec3<Decimal100>& y,
                                const Decimal100& scale) {
            return (magnitude(x - y) / scale).convert_to<double>();
          };
          const Decimal100 first = std::max({magnitude(a.d1), magnitude(a.d2), Decimal100(1)});
          const Decimal100 second =
              std::max({magnitude(a.d11), magnitude(a.d12), magnitude(a.d22), Decimal100(1)});
          const std::string id = c.name + " face " + std::to_string(face) + ":" + std::to_string(corner) +
                                 " (" + u.to_string().substr(0, 12) + ", " + v.to_string().substr(0, 12) +
                                 ")";
          const double position = error(a.position, b.position, Decimal100(1));
          const double d = std::max(error(a.d1, b.d1, first), error(a.d2, b.d2, first));
          const double dd = std::max(
              {error(a.d11, b.d11, second), error(a.d12, b.d12, second), error(a.d22, b.d22, second)});
          EXPECT_LE(position, 1e-98) << id;
          EXPECT_LE(d, 1e-100 * 0x1p101 * 100) << id;
          EXPECT_LE(dd, 1e-100 * 0x1p202 * 100) << id;
          EXPECT_EQ(a.normal_kind, b.normal_kind) << id;
          EXPECT_EQ(a.at_corner, b.at_corner) << id;
          EXPECT_EQ(a.first_exist, b.first_exist) << id;
          EXPECT_EQ(a.second_exist, b.second_exist) << id;
          if (a.normal_kind == NormalKind::kRegular && b.normal_kind == NormalKind::kRegular)
            worst_normal = std::max(worst_normal, error(a.normal, b.normal, Decimal100(1)));
          worst_position = std::max(worst_position, position);
          worst_first = std::max(worst_first, d);
          worst_second = std::max(worst_second, dd);
        }
  }
  // Next to a boundary corner of one face the tangents close like the distance, 1e-30, and the normal loses
  // as much.
  EXPECT_LE(worst_normal, 1e-100 * 0x1p101 * 100 / 1e-30);
  std::printf("worst: position %.1e, first %.1e, second %.1e, normal %.1e\n", worst_position, worst_first,
              worst_second, worst_normal);
}

// Catmull-Clark's weights are rational at every valence: all but normals is exact, and one method in
// rationals tells of the other in balls or decimals whether it is right.
TEST(CatmullClark_Evaluators, InRationalsAreExactAtEveryValence) {
  for (const Case& c : cases()) {
    const SubdivisionEvaluator<Rational> exact(c.mesh.faces, positions_of<Rational>(c.mesh));
    const StamEvaluator<Decimal100> other(c.mesh.faces, positions_of<Decimal100>(c.mesh));
    for (int face = 0; face < std::min(c.faces, 2); ++face)
      for (const auto& [u, v] : {std::array{Parameter::fraction(1, 3), Parameter::fraction(1, 4)},
                                 {Parameter::fraction(1, 1000), Parameter::fraction(1, 3000)},
                                 {Parameter(0.), Parameter(0.)}}) {
        const auto a = exact.evaluate(face, 0, u, v);
        const auto b = other.evaluate(face, 0, u, v);
        const auto close = [&](const Vec3<Rational>& x, const Vec3<Decimal100>& y) {
          const auto number = [](const Rational& r) { return NumberTraits<Decimal100>::from_rational(r); };
          const Vec3<Decimal100> wide{number(x.x), number(x.y), number(x.z)};
          EXPECT_LE(magnitude(wide - y), Decimal100("1e-90") * (Decimal100(1) + magnitude(wide))) << c.name;
        };
        close(a.position, b.position);
        if (!a.first_exist) continue;
        close(a.d1, b.d1), close(a.d2, b.d2);
        close(a.d11, b.d11), close(a.d12, b.d12), close(a.d22, b.d22);
      }
  }
}

// In double, against a hundred digits of the same mesh, in units of the last place of its largest coordinate.
TEST(CatmullClark_Evaluators, InDoubleWithinAFewUnits) {
  for (const Case& c : cases()) {
    double largest = 0;
    for (const auto& p : c.mesh.positions)
      largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    const double ulp = largest * 0x1p-52;
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
  std::size_t looked_at = 0;
  for (const Case& c : cases()) {
    double largest = 0;
    for (const auto& p : c.mesh.positions)
      largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    const auto positions = positions_of<double>(c.mesh);
    const NaiveSubdivider<double> naive(c.mesh.faces, positions);
    const StamEvaluator<double> stam(c.mesh.faces, positions);
    RefinedMesh<double> refined(c.mesh.faces, positions);
    for (int depth = 0; depth <= 3; ++depth) {
      if (depth > 0) refined.refine();
      const auto limits = refined.limits();
      for (int face = 0; face < c.faces; ++face)
        for (int corner = 0; corner < corners_of(c, face); ++corner) {
          const bool is_quad = corners_of(c, face) == 1;
          if (!is_quad && depth == 0) continue;
          const int side = 1 << (is_quad ? depth : depth - 1);
          std::size_t leaves = 0;
          const auto f = static_cast<std::size_t>(face), k = static_cast<std::size_t>(corner);
          naive.tessellate(f, k, depth, [&](const LeafQuad<double>& leaf) {
            ++leaves;
            for (const auto& p : leaf) {
              ++looked_at;
              const auto want = stam.evaluate(face, corner, static_cast<double>(p.i) / side,
                                              static_cast<double>(p.j) / side, Derivatives::kFirst);
              const auto v = static_cast<std::size_t>(refined.vertex(f, k, p.i, p.j));
              const double unit = largest * 0x1p-52;
              worst = std::max({worst, magnitude(p.position - want.position) / unit,
                                magnitude(limits.positions[v] - want.position) / unit});
              ASSERT_EQ(p.normal_kind, limits.kinds[v]) << c.name;
              if (p.normal_kind != NormalKind::kRegular || want.normal_kind != NormalKind::kRegular) continue;
              const double bound = 0x1p-52 * std::max(8., want.normal_condition);
              worst_normal = std::max({worst_normal, magnitude(p.normal - want.normal) / bound,
                                       magnitude(limits.normals[v] - want.normal) / bound});
            }
          });
          EXPECT_EQ(leaves, static_cast<std::size_t>(side * side)) << c.name;
        }
    }
  }
  std::printf("%zu corners: position %.2f, normal over its condition %.2f\n", looked_at, worst, worst_normal);
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
