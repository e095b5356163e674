// SPDX-License-Identifier: MIT
// Certified points hold the truth, print no digit they cannot vouch for, and say what does not exist.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "data/generators/random_mesh.h"
#include "data/shapes.h"
#include "reference/number/number_exact.h"
#include "reference/surface/test_methods.h"

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
        const Big size = magnitude(want);
        expect_inside(got, want, size * Big("1e-80"), what);
        for (const Enclosure& x : got)
          EXPECT_LE(Big(x.radius.to_string(17)), 10 * size * pow(Big(10), -digits))
              << what << " to " << digits;
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

TEST(Certified, ExtraordinaryCornersHaveTheDerivativesThatExist) {
  const auto at_corner = [](const data::ControlMesh& mesh) {
    return CertifiedEvaluator(mesh).evaluate(0, 0.0, 0.0, 20);
  };
  const CertifiedPoint three = at_corner(data::tetrahedron());
  EXPECT_TRUE(three.first_exist && three.d11 && three.t1);
  EXPECT_EQ(three.position[0].value, "0.20000000000000000000");  // of the known answers
  EXPECT_EQ(three.normal_kind, NormalKind::kRegular);
  for (const Enclosure& zero : three.d1) EXPECT_TRUE(zero.value == "0" && zero.radius.is_zero());
  EXPECT_FALSE(three.gaussian_curvature);  // not by first derivatives that vanish
  const CertifiedPoint five = at_corner(data::icosahedron());
  EXPECT_TRUE(five.first_exist && five.t1);
  EXPECT_FALSE(five.d11);
  const CertifiedPoint seven = at_corner(data::wheel(7));
  EXPECT_TRUE(seven.t1);
  EXPECT_FALSE(seven.first_exist || seven.d11);
  const CertifiedPoint inside = CertifiedEvaluator(data::wheel(7)).evaluate(0, 0.25, 0.25, 20);
  EXPECT_TRUE(inside.first_exist && inside.d11);
  EXPECT_FALSE(inside.t1);
}

// The faces around one face need not be a manifold by themselves: two of them may touch in a vertex alone.
TEST(Certified, EveryFaceOfATightMeshHasTheSurfaceOfTheWhole) {
  std::vector<data::ControlMesh> meshes{
      data::tetrahedron(), data::octahedron(), data::torus(3, 3),
      data::bipyramid(3),  data::bipyramid(4), data::bipyramid(5),
      data::cube(),        data::holes(),      data::random_mesh(360, {60, 50})};
  for (const data::ControlMesh& mesh : meshes) {
    const CertifiedEvaluator certified(mesh);
    const SubdivisionEvaluator<Big> whole(mesh);
    for (int face = 0; face < whole.face_count(); ++face)
      for (const auto& [a, b] : {std::pair{"1/5", "2/7"}, {"0", "1"}}) {
        const Parameter l1 = Parameter::parse(a), l2 = Parameter::parse(b);
        const CertifiedPoint p = certified.evaluate(face, l1, l2, 30);
        const SurfacePoint<Big> s = whole.evaluate(face, l1, l2);
        const std::string what = std::to_string(mesh.faces.size()) + " faces, face " + std::to_string(face);
        expect_inside(p.position, s.position, Big("1e-80"), what);
        expect_inside(p.d1, s.d1, Big("1e-80"), what);
        expect_inside(p.normal, s.normal, Big("1e-80"), what);
      }
  }
}

// Two strips of faces over a tent, its ridge semi-sharp: 5, 1/2, 5 by Chaikin's creasing. The sharpness of the
// middle edge lasts by what lies at its ends, one face farther than the points of a face at the other end see.
TEST(Certified, ChaikinsCreasingReadsTheFarEndsOfEdges) {
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    data::ControlMesh tent;
    for (int row = 0; row < 3; ++row)
      for (int i = 0; i < 5; ++i) tent.positions.push_back({double(i), double(row), row == 1 ? 1. : 0.});
    for (std::int32_t row = 0; row < 2; ++row)
      for (std::int32_t i = 0; i < 4; ++i) {
        const std::int32_t a = 5 * row + i;
        if (scheme == data::Scheme::kCatmullClark) {
          tent.faces.push_back({a, a + 1, a + 6, a + 5});
        } else {
          tent.faces.push_back({a, a + 1, a + 6});
          tent.faces.push_back({a, a + 6, a + 5});
        }
      }
    tent.sharpness.edges = {{5, 6, 5}, {6, 7, .5}, {7, 8, 5}};
    tent.sharpness.creasing = data::Creasing::kChaikin;
    const CertifiedEvaluator certified(tent, scheme);
    for (const std::int32_t v : {6, 7}) {
      std::vector<Enclosure> heights;
      for (std::size_t f = 0; f < tent.faces.size(); ++f)
        for (std::size_t k = 0; k < tent.faces[f].size(); ++k)
          if (std::as_const(tent).faces[f][k] == v) {
            const bool far = k == 2 && scheme == data::Scheme::kCatmullClark;
            heights.push_back(
                certified
                    .evaluate(static_cast<int>(f), k == 1 || far ? 1. : 0., k == 2 || k == 3 ? 1. : 0., 20)
                    .position[2]);
          }
      ASSERT_GE(heights.size(), 4U);
      for (const Enclosure& h : heights)
        EXPECT_LE(abs(Big(h.value) - Big(heights[0].value)),
                  Big(h.radius.to_string(17)) + Big(heights[0].radius.to_string(17)))
            << data::name_of(scheme) << " vertex " << v << ": " << h.value << ", " << heights[0].value;
    }
  }
}

TEST(Certified, HasWarrensSurfaceToo) {
  const data::ControlMesh mesh = data::octahedron();
  const CertifiedEvaluator certified(mesh, Weights::kWarren);
  EXPECT_EQ(Big(certified.evaluate(0, 0.0, 0.0, 10).position[0].value),
            Big(mesh.positions[mesh.faces[0][0]][0]) / 2);
  const SurfacePoint<Big> s = SubdivisionEvaluator<Big>(mesh, Weights::kWarren).evaluate(3, 0.25, 0.125);
  const CertifiedPoint p = certified.evaluate(3, 0.25, 0.125, 40);
  EXPECT_LE(abs(Big(p.position[1].value) - s.position.y), Big(p.position[1].radius.to_string(17)));
  EXPECT_LE(abs(Big(p.mean_curvature->value)), Big(100));
}

TEST(Certified, NumbersAreWrittenPlainlyWhereThatIsShort) {
  // The limit of a mesh whose points coincide is that point.
  data::ControlMesh point = data::octahedron();
  for (auto& p : point.positions) p = {128, -4.3, 0.0078125};
  const auto text = [&](int digits) {
    const Enclosure3 p = CertifiedEvaluator(point).evaluate(0, 0.25, 0.25, digits).position;
    return p[0].value + " " + p[1].value + " " + p[2].value;
  };
  EXPECT_EQ(text(2), "1.3e2 0 0");
  EXPECT_EQ(text(3), "128 -4 0");
  EXPECT_EQ(text(4), "128.0 -4.3 0");
  EXPECT_EQ(text(5), "128.00 -4.30 0.01");
  EXPECT_EQ(text(8), "128.00000 -4.30000 0.00781");
  for (auto& p : point.positions) p = {123, 456, -789};
  EXPECT_EQ(text(3), "123 456 -789");
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
  // Points all but on the line x = y: t1 x t2 cancels 80 or 130 bits, more than the first attempt
  // has to spare.
  for (const std::string offset : {"1e-24", "1e-40"}) {
    std::vector<std::array<std::string, 3>> positions;
    const data::ControlMesh mesh = data::octahedron();
    for (const auto& p : mesh.positions) {
      const Big x(p[0]), y = x + Big(offset) * Big(p[1]);
      positions.push_back({x.str(), y.str(90), Big(0).str()});
    }
    const CertifiedPoint p =
        CertifiedEvaluator(positions, mesh.faces, data::Scheme::kLoop).evaluate(0, 0.25, 0.25, 10);
    EXPECT_EQ(p.normal_kind, NormalKind::kRegular) << offset;
    EXPECT_EQ(abs(Big(p.normal[2].value)), 1) << offset;
    EXPECT_LE(p.normal[2].radius.as_double(), 1e-9) << offset;
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
      EXPECT_LE(Big(curvature->radius.to_string(17)), abs(Big(curvature->value)) * Big("1e-11")) << distance;
    }
  }
}

// Sizes near the ends of the range of double. Curvatures go with the inverse of the length, and its square: what
// a mesh of size 1 has is known, and a power of two scales it exactly.
TEST(Certified, AMeshOfAnySizeHasRadiiThatFitIt) {
  const data::ControlMesh unit = data::wheel(7);
  const CertifiedPoint one = CertifiedEvaluator(unit).evaluate(0, 0.25, 0.125, 16);
  for (const int exponent : {-996, 0, 996}) {  // 1e-300, 1e300
    data::ControlMesh mesh = unit;
    for (auto& p : mesh.positions)
      for (double& x : p) x = std::ldexp(x, exponent);
    const CertifiedPoint p = CertifiedEvaluator(mesh).evaluate(0, 0.25, 0.125, 16);
    const Big size = pow(Big(2), exponent);
    const auto check = [&](const Enclosure& got, const Enclosure& of_one, const Big& scale,
                           const Big& least) {
      EXPECT_LE(abs(Big(got.value) - scale * Big(of_one.value)),
                Big(got.radius.to_string(17)) + scale * Big(of_one.radius.to_string(17)))
          << exponent;
      EXPECT_LE(Big(got.radius.to_string(17)),
                Big("1e-14") * std::max(Big(abs(Big(got.value))), Big(scale * least)));
    };
    for (std::size_t c = 0; c < 3; ++c) {
      check(p.position[c], one.position[c], size, 1);
      check(p.d1[c], one.d1[c], size, 1);
      check((*p.d11)[c], (*one.d11)[c], size, 1);
      check(p.normal[c], one.normal[c], 1, 1);
    }
    check(*p.gaussian_curvature, *one.gaussian_curvature, 1 / (size * size), 0);
    check(*p.mean_curvature, *one.mean_curvature, 1 / size, 0);
  }
}

TEST(Radius, IsADecimalWithAnExponentOfItsOwnAndNeverLess) {
  EXPECT_EQ(Radius().to_string(), "0");
  EXPECT_TRUE(Radius(0, 5).is_zero());
  EXPECT_EQ(Radius(4.21, -20).to_string(), "4.3e-20");
  EXPECT_EQ(Radius(9.96, -301).to_string(), "1.0e-300");
  EXPECT_EQ(Radius(250, 598).to_string(), "2.6e+600");  // 2.5, and rounded upwards
  EXPECT_EQ(Radius(.25, 0).to_string(3), "2.51e-01");
  EXPECT_EQ(Radius(std::numeric_limits<double>::infinity(), 0).to_string(), "inf");
  EXPECT_GT(Radius(1, -600).as_double(), 0);
  EXPECT_GT(Radius(1, 600).as_double(), std::numeric_limits<double>::max());
  for (const double x : {1e-300, 1.2345678901234567e-5, 1., 9.999999999999999e299}) {
    EXPECT_GE(Radius(x, 0).as_double(), x);
    EXPECT_LE(Radius(x, 0).as_double(), x * (1 + 1e-11));  // 300 divisions by 10
  }
  EXPECT_LT(Radius(), Radius(1, -600));
  EXPECT_LT(Radius(9, -600), Radius(1, -599));
  EXPECT_LT(Radius(9, 600), Radius(std::numeric_limits<double>::infinity(), 0));
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
  EXPECT_THROW(e.evaluate(8, 0.0, 0.0, 10), data::ArgumentError);
  EXPECT_THROW(e.evaluate(0, 0.6, 0.6, 10), data::ArgumentError);
  EXPECT_THROW(e.evaluate(0, 0.0, 0.0, 0), data::ArgumentError);
  EXPECT_THROW(e.evaluate(0, 0.0, 0.0, 100000), data::ArgumentError);
  data::ControlMesh infinite = data::octahedron();
  infinite.positions[2][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(CertifiedEvaluator{infinite}, data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::reference
