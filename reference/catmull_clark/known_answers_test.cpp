// SPDX-License-Identifier: MIT
// Every known answer, smooth and sharp, to 39 digits with 100-digit arithmetic, by both evaluators.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "data/test_support/known_answers.h"
#include "reference/catmull_clark/stam.h"
#include "reference/catmull_clark/subdivision_evaluator.h"
#include "reference/mesh/test_tags.h"
#include "reference/number/number_exact.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference::catmull_clark {
namespace {

using N = Decimal100;

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

// All of this scheme.
const std::vector<data::QuadAnswer>& answers() {
  static const auto loaded = [] {
    std::vector<data::QuadAnswer> all;
    for (auto& a : data::load_quad_answers())
      if (a.scheme == "catmull-clark") all.push_back(std::move(a));
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

constexpr double kDigits = 39;

template <class Evaluator>
void check_all() {
  ASSERT_EQ(answers().size(), 50U);
  double fewest = 100;
  for (const auto& a : answers()) {
    const Evaluator evaluator(a.faces, vecs<N>(a.vertices), tags_of(a));
    for (const auto& s : a.samples) {
      const auto p = evaluator.evaluate(s.face, s.corner, Parameter::parse(s.uv[0]),
                                        Parameter::parse(s.uv[1]), Order::kSecond);
      const auto check = [&](const char* what, const Vec3<N>& got, const data::Numeral3& expected) {
        const double d = digits(got, vec<N>(expected));
        fewest = std::min(fewest, d);
        EXPECT_GE(d, kDigits) << a.id << " (" << s.uv[0] << ", " << s.uv[1] << ") " << what << ": " << got.x
                              << " " << got.y << " " << got.z;
      };
      check("position", p.position, s.position);
      if (s.normal) check("normal", p.normal, *s.normal);
      EXPECT_EQ(p.at_corner, s.at_vertex) << a.id;
      EXPECT_TRUE(p.first_exist || !s.du) << a.id;
      if (s.no_tangent_plane) {
        EXPECT_EQ(p.normal_kind, NormalKind::kNoTangentPlane) << a.id;
      }
      if (s.du) check("du", p.d1, *s.du), check("dv", p.d2, *s.dv);
      if (s.dudu) check("duu", p.d11, *s.dudu), check("duv", p.d12, *s.dudv), check("dvv", p.d22, *s.dvdv);
    }
  }
  std::printf("fewest digits: %.1f\n", fewest);
}

TEST(CatmullClark_KnownAnswers, BySubdivisionToThirtyNineDigits) {
  check_all<SubdivisionEvaluator<N>>();
}
TEST(CatmullClark_KnownAnswers, ByStamToThirtyNineDigits) {
  check_all<StamEvaluator<N>>();
}

// Rational points and sharpnesses give rational positions everywhere, and derivatives but at special
// vertices: the difference from the answer is the answer's rounding to 42 digits.
TEST(CatmullClark_KnownAnswers, AreTheRoundedRationals) {
  const auto expect_rounded = [](const Vec3<Rational>& got, const data::Numeral3& expected,
                                 const std::string& what) {
    const Vec3<Rational> want = vec<Rational>(expected);
    EXPECT_LE(magnitude(got - want),
              (magnitude(want) + Rational(1)) / Rational(Integer("1" + std::string(40, '0'))))
        << what;
  };
  for (const auto& a : answers()) {
    const SubdivisionEvaluator<Rational> evaluator(a.faces, vecs<Rational>(a.vertices), tags_of(a));
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

TEST(CatmullClark_KnownAnswers, AreInsideTheCertifiedEnclosures) {
  for (const auto& a : answers()) {
    if (a.faces.size() > 100) continue;  // balls at valence 50 take their time
    const CertifiedEvaluator evaluator(a.vertices, a.faces, data::Scheme::kCatmullClark, tags_of(a));
    for (const auto& s : a.samples) {
      const auto p =
          evaluator.evaluate(s.face, s.corner, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]), 45);
      const auto check = [&](const Enclosure3& got, const data::Numeral3& expected) {
        for (std::size_t i = 0; i < 3; ++i) {
          const N want = data::parse<N>(expected[i]), value(got[i].value);
          const N rounding = magnitude(want) * N("1e-41") + N("1e-43");  // of the answer's own 42 digits
          EXPECT_LE(magnitude(want - value), N(got[i].radius.to_string(17)) + rounding)
              << a.id << " " << s.uv[0] << " " << s.uv[1];
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

}  // namespace
}  // namespace limitcheck::reference::catmull_clark
