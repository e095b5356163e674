// SPDX-License-Identifier: MIT
// Every known answer of Catmull-Clark's scheme, and those of Loop's with sharp edges, to 39 digits with 100-digit
// arithmetic, by both evaluators and in balls.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "data/test_support/known_answers.h"
#include "reference/catmull_clark/stam.h"
#include "reference/catmull_clark/subdivision_evaluator.h"
#include "reference/loop/stam.h"
#include "reference/loop/subdivision_evaluator.h"
#include "reference/number/number_exact.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {
namespace {

using N = Decimal100;

SharpTags tags_of(const data::QuadAnswer& answer) {
  SharpTags tags;
  for (const auto& e : answer.sharp_edges) tags.edges.push_back({e.a, e.b, Parameter::parse(e.sharpness)});
  for (const auto& v : answer.sharp_vertices) tags.vertices.push_back({v.a, Parameter::parse(v.sharpness)});
  if (answer.boundary == "edge+corner") tags.boundary = data::Boundary::kEdgeAndCorner;
  if (answer.creasing == "chaikin") tags.creasing = data::Creasing::kChaikin;
  if (answer.triangles == "smooth") tags.triangles = data::TriangleRule::kSmooth;
  return tags;
}

template <class M>
Vec3<M> vec(const data::Numeral3& text) {
  return {data::parse<M>(text[0]), data::parse<M>(text[1]), data::parse<M>(text[2])};
}
template <class M>
std::vector<Vec3<M>> vecs(const std::vector<data::Numeral3>& texts) {
  std::vector<Vec3<M>> result;
  for (const auto& t : texts) result.push_back(vec<M>(t));
  return result;
}

/// An evaluator of each scheme.
template <template <class> class Evaluator>
struct OfLoop {
  static constexpr data::Scheme kScheme = data::Scheme::kLoop;
  static constexpr const char* kName = "loop";
  static constexpr std::size_t kAnswers = 8;
  Evaluator<N> evaluator;
  explicit OfLoop(const data::QuadAnswer& a)
      : evaluator(vecs<N>(a.vertices), data::Triangles(a.faces).to_vector(), Weights::kLoop, tags_of(a)) {}
  SurfacePoint<N> at(int face, int, const Parameter& u, const Parameter& v) const {
    return evaluator.evaluate(face, u, v, Derivatives::kSecond);
  }
};
template <template <class> class Evaluator>
struct OfCatmullClark {
  static constexpr data::Scheme kScheme = data::Scheme::kCatmullClark;
  static constexpr const char* kName = "catmull-clark";
  static constexpr std::size_t kAnswers = 50;
  Evaluator<N> evaluator;
  explicit OfCatmullClark(const data::QuadAnswer& a) : evaluator(a.faces, vecs<N>(a.vertices), tags_of(a)) {}
  SurfacePoint<N> at(int face, int corner, const Parameter& u, const Parameter& v) const {
    return evaluator.evaluate(face, corner, u, v, Derivatives::kSecond);
  }
};

template <class Of>
const std::vector<data::QuadAnswer>& answers() {
  static const auto loaded = [] {
    std::vector<data::QuadAnswer> all;
    for (auto& a : data::load_quad_answers())
      if (a.scheme == Of::kName) all.push_back(std::move(a));
    return all;
  }();
  return loaded;
}

// Decimal digits in which two vectors agree, relative to the larger of 1 and the expected one's size.
double digits(const Vec3<N>& got, const Vec3<N>& expected) {
  const double scale = std::max(1.0, magnitude(expected).convert_to<double>());
  const double error = magnitude(got - expected).convert_to<double>() / scale;
  return error == 0 ? 100 : -std::log10(error);
}

template <class Of>
class KnownAnswers : public ::testing::Test {};
using Evaluators = ::testing::Types<OfLoop<SubdivisionEvaluator>, OfLoop<StamEvaluator>,
                                    OfCatmullClark<catmull_clark::SubdivisionEvaluator>,
                                    OfCatmullClark<catmull_clark::StamEvaluator>>;
TYPED_TEST_SUITE(KnownAnswers, Evaluators);

TYPED_TEST(KnownAnswers, AreFoundToThirtyNineDigits) {
  ASSERT_EQ(answers<TypeParam>().size(), TypeParam::kAnswers);
  double fewest = 100;
  for (const auto& a : answers<TypeParam>()) {
    const TypeParam evaluator(a);
    for (const auto& s : a.samples) {
      const auto p = evaluator.at(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]));
      const auto check = [&](const char* what, const Vec3<N>& got, const data::Numeral3& expected) {
        const double d = digits(got, vec<N>(expected));
        fewest = std::min(fewest, d);
        EXPECT_GE(d, 39) << a.id << " (" << s.uv[0] << ", " << s.uv[1] << ") " << what << ": " << got.x << " "
                         << got.y << " " << got.z;
      };
      check("position", p.position, s.position);
      if (s.normal) check("normal", p.normal, *s.normal);
      EXPECT_EQ(p.at_corner, s.at_vertex) << a.id;
      EXPECT_TRUE(p.first_exist || !s.du) << a.id;
      if (s.no_tangent_plane && TypeParam::kScheme == data::Scheme::kCatmullClark) {
        EXPECT_EQ(p.normal_kind, NormalKind::kNoTangentPlane) << a.id;
      }
      if (s.du) check("d1", p.d1, *s.du), check("d2", p.d2, *s.dv);
      if (s.dudu) check("d11", p.d11, *s.dudu), check("d12", p.d12, *s.dudv), check("d22", p.d22, *s.dvdv);
    }
  }
  std::printf("fewest digits: %.1f\n", fewest);
}

template <class Of>
void expect_inside_enclosures(double largest_radius) {
  for (const auto& a : answers<Of>()) {
    if (a.faces.size() > 100) continue;  // balls at valence 50 take their time
    const CertifiedEvaluator evaluator(a.vertices, a.faces, Of::kScheme, tags_of(a));
    for (const auto& s : a.samples) {
      const auto p =
          evaluator.evaluate(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]), 45);
      const auto check = [&](const Enclosure3& got, const data::Numeral3& expected) {
        for (std::size_t i = 0; i < 3; ++i) {
          const N want = data::parse<N>(expected[i]), value(got[i].value);
          const N rounding = magnitude(want) * N("1e-41") + N("1e-43");  // of the answer's own 42 digits
          EXPECT_LE(magnitude(want - value), N(got[i].radius.to_string(17)) + rounding)
              << a.id << " " << s.uv[0] << " " << s.uv[1];
          EXPECT_LE(got[i].radius.as_double(), largest_radius) << a.id << " " << s.uv[0];
        }
      };
      check(p.position, s.position);
      if (s.normal) check(p.normal, *s.normal);
      if (s.du) check(p.d1, *s.du), check(p.d2, *s.dv);
      if (s.dudu) {
        ASSERT_TRUE(p.d11.has_value()) << a.id;
        check(*p.d11, *s.dudu), check(*p.d12, *s.dudv), check(*p.d22, *s.dvdv);
      }
      EXPECT_TRUE(p.first_exist || !s.du) << a.id;
    }
  }
}
TEST(KnownAnswersOfLoop, AreInsideTheCertifiedEnclosures) {
  expect_inside_enclosures<OfLoop<StamEvaluator>>(1e-40);
}
TEST(KnownAnswersOfCatmullClark, AreInsideTheCertifiedEnclosures) {
  expect_inside_enclosures<OfCatmullClark<catmull_clark::StamEvaluator>>(HUGE_VAL);
}

// Rational points and sharpnesses give rational positions everywhere, and derivatives but at special
// vertices: the difference from the answer is the answer's rounding to 42 digits.
TEST(KnownAnswersOfCatmullClark, AreTheRoundedRationals) {
  const auto expect_rounded = [](const Vec3<Rational>& got, const data::Numeral3& expected,
                                 const std::string& what) {
    const Vec3<Rational> want = vec<Rational>(expected);
    EXPECT_LE(magnitude(got - want),
              (magnitude(want) + Rational(1)) / Rational(Integer("1" + std::string(40, '0'))))
        << what;
  };
  for (const auto& a : answers<OfCatmullClark<catmull_clark::StamEvaluator>>()) {
    const catmull_clark::SubdivisionEvaluator<Rational> evaluator(a.faces, vecs<Rational>(a.vertices),
                                                                  tags_of(a));
    for (const auto& s : a.samples) {
      const auto p =
          evaluator.evaluate(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]));
      expect_rounded(p.position, s.position, a.id);
      EXPECT_EQ(p.first_exist, s.du.has_value()) << a.id;
      if (s.du) expect_rounded(p.d1, *s.du, a.id), expect_rounded(p.d2, *s.dv, a.id);
      if (!s.dudu) continue;
      expect_rounded(p.d11, *s.dudu, a.id), expect_rounded(p.d12, *s.dudv, a.id);
      expect_rounded(p.d22, *s.dvdv, a.id);
    }
  }
}

}  // namespace
}  // namespace limitcheck::reference
