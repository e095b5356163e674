// SPDX-License-Identifier: MIT
// Certified points hold the truth, print no digit they cannot vouch for, and say what does not exist.
#include <gtest/gtest.h>

#include "data/shapes.h"
#include "reference/certified.h"
#include "reference/number_exact.h"
#include "reference/subdivision_evaluator.h"

namespace limitcheck::reference {
namespace {

using Big = Decimal100;

TEST(Certified, EnclosuresHoldTheOtherMethodsValuesAtEveryPrecision) {
  const data::ControlMesh mesh = data::wheel(7);
  const CertifiedEvaluator certified(mesh);
  const SubdivisionEvaluator<Big> truth(mesh);
  for (const int digits : {1, 5, 16, 60})
    for (const auto& [a, b] :
         {std::pair{"1/3", "1/3"}, {"1e-9", "2e-9"}, {"1/7", "0"}, {"0.5", "0.5"}, {"0", "1"}}) {
      const Parameter l1 = Parameter::parse(a), l2 = Parameter::parse(b);
      const CertifiedPoint p = certified.evaluate(0, l1, l2, digits);
      const SurfacePoint<Big> s = truth.evaluate(0, l1, l2);
      const auto check = [&](const Enclosure3& got, const Vec3<Big>& want, const char* what) {
        const std::array<Big, 3> coordinates{want.x, want.y, want.z};
        Big largest = 0;
        for (const Big& c : coordinates) largest = std::max(largest, Big(abs(c)));
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_LE(abs(Big(got[i].value) - coordinates[i]), Big(got[i].radius) + largest * Big("1e-80"))
              << what << " to " << digits;
          EXPECT_LE(Big(got[i].radius), 10 * largest * pow(Big(10), -digits)) << what << " to " << digits;
        }
      };
      check(p.position, s.position, "position");
      check(p.d1, s.d1, "d1");
      check(p.d2, s.d2, "d2");
      check(p.normal, s.normal, "normal");
      ASSERT_TRUE(p.d11.has_value());
      check(*p.d11, s.d11, "d11");
      check(*p.d12, s.d12, "d12");
      check(*p.d22, s.d22, "d22");
    }
}

TEST(Certified, ExtraordinaryCornersHaveNoSecondDerivatives) {
  const CertifiedPoint p = CertifiedEvaluator(data::tetrahedron()).evaluate(0, 0.0, 0.0, 20);
  EXPECT_FALSE(p.first_exist);
  EXPECT_FALSE(p.d11 || p.gaussian_curvature);
  EXPECT_EQ(p.position[0].value, "0.20000000000000000000");  // of the known answers
  EXPECT_EQ(p.normal_kind, NormalKind::kRegular);
}

TEST(Certified, ConvexSurfacesHavePositiveCurvatures) {
  // At the centre of an icosahedron's face symmetry makes all normal curvatures equal: K = H^2.
  const CertifiedPoint p = CertifiedEvaluator(data::icosahedron())
                               .evaluate(0, Parameter::fraction(1, 3), Parameter::fraction(1, 3), 40);
  const Big k(p.gaussian_curvature->value), h(p.mean_curvature->value);
  EXPECT_GT(h, 0);
  EXPECT_LE(abs(k - h * h), Big("1e-38"));
}

TEST(Certified, CurvaturesAreThoseOfTheFundamentalForms) {
  // At a point without symmetry, from the other method's derivatives, by way of the shape operator I^-1 II.
  const data::ControlMesh mesh = data::wheel(7);
  const Parameter l1 = Parameter::fraction(1, 5), l2 = Parameter::fraction(2, 7);
  const SurfacePoint<Big> s = SubdivisionEvaluator<Big>(mesh).evaluate(0, l1, l2);
  const Big e = dot(s.d1, s.d1), f = dot(s.d1, s.d2), g = dot(s.d2, s.d2), det = e * g - f * f;
  const Big l = dot(s.d11, s.normal), m = dot(s.d12, s.normal), n = dot(s.d22, s.normal);
  const Big shape[2][2] = {{(g * l - f * m) / det, (g * m - f * n) / det},
                           {(e * m - f * l) / det, (e * n - f * m) / det}};
  const Big k = shape[0][0] * shape[1][1] - shape[0][1] * shape[1][0];
  const Big h = -(shape[0][0] + shape[1][1]) / 2;  // positive where convex
  const CertifiedPoint p = CertifiedEvaluator(mesh).evaluate(0, l1, l2, 40);
  EXPECT_NE(e, g);
  EXPECT_LE(abs(Big(p.gaussian_curvature->value) - k), abs(k) * Big("1e-38"));
  EXPECT_LE(abs(Big(p.mean_curvature->value) - h), abs(h) * Big("1e-38"));
}

TEST(Certified, PrecisionRisesUntilTheNormalIsKnown) {
  // Points all but on the line x = y: t1 x t2 cancels 80
  // or 130 bits, more than the first attempt has to spare.
  for (const std::string offset : {"1e-24", "1e-40"}) {
    std::vector<std::array<std::string, 3>> positions;
    const data::ControlMesh mesh = data::octahedron();
    for (const auto& p : mesh.positions) {
      const Big x(p[0]), y = x + Big(offset) * Big(p[1]);
      positions.push_back({x.str(), y.str(90), Big(0).str()});
    }
    const CertifiedPoint p = CertifiedEvaluator(positions, mesh.triangles).evaluate(0, 0.25, 0.25, 10);
    EXPECT_EQ(p.normal_kind, NormalKind::kRegular) << offset;
    EXPECT_EQ(abs(Big(p.normal[2].value)), 1) << offset;
    EXPECT_LE(p.normal[2].radius, 1e-9) << offset;
  }
}

// Curvatures near an extraordinary corner take more bits than everything else: they have their digits, too.
TEST(Certified, PrecisionRisesUntilTheCurvaturesAreKnown) {
  const CertifiedEvaluator certified(data::wheel(7));
  for (const char* distance : {"1e-10", "1e-20", "1e-40"}) {
    const Parameter l = Parameter::parse(distance);
    const CertifiedPoint p = certified.evaluate(0, l, l, 12);
    for (const auto& curvature : {p.gaussian_curvature, p.mean_curvature}) {
      ASSERT_TRUE(curvature.has_value()) << distance;
      ASSERT_FALSE(curvature->value.empty()) << distance;
      EXPECT_LE(Big(curvature->radius), abs(Big(curvature->value)) * Big("1e-11")) << distance;
    }
  }
}

TEST(Certified, NumbersWithoutDecimalsArePrintedWithoutAnExponent) {
  data::ControlMesh mesh = data::octahedron();
  for (auto& p : mesh.positions) p = {123, 456, -789};
  const CertifiedPoint p = CertifiedEvaluator(mesh).evaluate(0, 0.25, 0.25, 3);
  EXPECT_EQ(p.position[0].value, "123");
  EXPECT_EQ(p.position[1].value, "456");
  EXPECT_EQ(p.position[2].value, "-789");
}

TEST(Certified, DegenerateMeshesAreSaidToBeSo) {
  data::ControlMesh point = data::octahedron();
  for (auto& p : point.positions) p = {1, 2, 3};
  const CertifiedPoint p = CertifiedEvaluator(point).evaluate(0, 0.25, 0.25, 10);
  EXPECT_EQ(p.normal_kind, NormalKind::kArbitrary);
  EXPECT_EQ(p.position[2].value, "3.000000000");
  EXPECT_EQ(p.d1[0].value, "0");
  EXPECT_FALSE(p.gaussian_curvature.has_value());
}

TEST(Certified, BadRequestsAreRefused) {
  const CertifiedEvaluator e(data::octahedron());
  EXPECT_THROW(e.evaluate(8, 0.0, 0.0, 10), std::out_of_range);
  EXPECT_THROW(e.evaluate(0, 0.6, 0.6, 10), std::invalid_argument);
  EXPECT_THROW(e.evaluate(0, 0.0, 0.0, 0), std::invalid_argument);
  EXPECT_THROW(e.evaluate(0, 0.0, 0.0, 100000), std::invalid_argument);
}

}  // namespace
}  // namespace limitcheck::reference
