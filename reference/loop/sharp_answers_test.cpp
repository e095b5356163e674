// SPDX-License-Identifier: MIT
// Every known answer with sharp edges on Loop's surfaces, to 39 digits with 100-digit arithmetic, by both
// evaluators.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "data/test_support/known_answers.h"
#include "reference/loop/stam.h"
#include "reference/loop/subdivision_evaluator.h"
#include "reference/mesh/test_tags.h"
#include "reference/number/number_exact.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {
namespace {

using N = Decimal100;

Vec3<N> vec(const data::Numeral3& text) {
  return {data::parse<N>(text[0]), data::parse<N>(text[1]), data::parse<N>(text[2])};
}

double digits(const Vec3<N>& got, const Vec3<N>& expected) {
  const double scale = std::max(1.0, magnitude(expected).convert_to<double>());
  const double error = magnitude(got - expected).convert_to<double>() / scale;
  return error == 0 ? 100 : -std::log10(error);
}

constexpr double kDigits = 39;

template <class Evaluator>
void check_all() {
  double fewest = 100;
  int cases = 0;
  for (const auto& a : data::load_quad_answers()) {
    if (a.scheme != "loop") continue;
    ++cases;
    std::vector<Vec3<N>> positions;
    for (const auto& v : a.vertices) positions.push_back(vec(v));
    const Evaluator evaluator(positions, data::Triangles(a.faces).to_vector(), Weights::kLoop, tags_of(a));
    for (const auto& s : a.samples) {
      const auto p =
          evaluator.evaluate(s.face, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]), Order::kSecond);
      const auto check = [&](const char* what, const Vec3<N>& got, const data::Numeral3& expected) {
        const double d = digits(got, vec(expected));
        fewest = std::min(fewest, d);
        EXPECT_GE(d, kDigits) << a.id << " (" << s.uv[0] << ", " << s.uv[1] << ") " << what << ": " << got.x
                              << " " << got.y << " " << got.z;
      };
      check("position", p.position, s.position);
      if (s.normal) check("normal", p.normal, *s.normal);
      EXPECT_EQ(p.at_corner, s.at_vertex) << a.id;
      EXPECT_TRUE(p.first_exist || !s.du) << a.id;
      if (s.du) check("d1", p.d1, *s.du), check("d2", p.d2, *s.dv);
      if (s.dudu) check("d11", p.d11, *s.dudu), check("d12", p.d12, *s.dudv), check("d22", p.d22, *s.dvdv);
    }
  }
  EXPECT_EQ(cases, 8);
  std::printf("fewest digits: %.1f\n", fewest);
}

TEST(Loop_SharpKnownAnswers, BySubdivisionToThirtyNineDigits) {
  check_all<SubdivisionEvaluator<N>>();
}
TEST(Loop_SharpKnownAnswers, ByStamToThirtyNineDigits) {
  check_all<StamEvaluator<N>>();
}

TEST(Loop_SharpKnownAnswers, AreInsideTheCertifiedEnclosures) {
  for (const auto& a : data::load_quad_answers()) {
    if (a.scheme != "loop") continue;
    const CertifiedEvaluator evaluator(a.vertices, a.faces, data::Scheme::kLoop, tags_of(a));
    for (const auto& s : a.samples) {
      const auto p = evaluator.evaluate(s.face, Parameter::parse(s.uv[0]), Parameter::parse(s.uv[1]), 45);
      const auto check = [&](const Enclosure3& got, const data::Numeral3& expected) {
        for (std::size_t i = 0; i < 3; ++i) {
          const N want = data::parse<N>(expected[i]), value(got[i].value);
          const N rounding = magnitude(want) * N("1e-41") + N("1e-43");  // of the answer's own 42 digits
          EXPECT_LE(magnitude(want - value), N(got[i].radius.to_string(17)) + rounding)
              << a.id << " " << s.uv[0];
          EXPECT_LE(got[i].radius.as_double(), 1e-40) << a.id << " " << s.uv[0];
        }
      };
      check(p.position, s.position);
      if (s.normal) check(p.normal, *s.normal);
      if (s.du) check(p.d1, *s.du), check(p.d2, *s.dv);
      if (s.dudu) {
        ASSERT_TRUE(p.d11.has_value()) << a.id;
        check(*p.d11, *s.dudu), check(*p.d12, *s.dudv), check(*p.d22, *s.dvdv);
      }
    }
  }
}

}  // namespace
}  // namespace limitcheck::reference
