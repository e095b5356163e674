// SPDX-License-Identifier: MIT
#include "data/test_support/known_answers.h"

#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <fstream>

#include "data/error.h"
#include "data/validate.h"

namespace limitcheck::data {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Float50 = boost::multiprecision::mpfr_float_50;

TEST(Numeral, DecimalsAndFractionsAreExactInRationals) {
  EXPECT_EQ(parse<Rational>("0.0122"), Rational(122, 10000));
  EXPECT_EQ(parse<Rational>("-9/500"), Rational(-9, 500));
  EXPECT_EQ(parse<Rational>("-0.05/+0.25"), Rational(-1, 5));
  EXPECT_EQ(parse<Rational>("1/-3"), Rational(-1, 3));
  EXPECT_EQ(parse<Rational>("12e3"), Rational(12000));
  EXPECT_EQ(parse<Rational>("12.50E-3"), Rational(1, 80));
  EXPECT_EQ(parse<Rational>("0010"), Rational(10));  // not octal
  EXPECT_EQ(parse<Rational>("-0.000"), Rational(0));
  EXPECT_EQ(parse<Rational>(".5"), Rational(1, 2));
}

TEST(Numeral, DoublesAreTheNearest) {
  EXPECT_EQ(parse<double>("1/3"), 1.0 / 3.0);
  EXPECT_EQ(parse<double>("0.1"), 0x1.999999999999ap-4);
  EXPECT_EQ(parse<double>("-7"), -7.0);
  EXPECT_EQ(parse<float>("0.1"), 0.1F);
}

TEST(Numeral, FiftyDigitsKeepFortyTwo) {
  const Numeral text = "-0.192233284243823622105728876202756046452241";
  EXPECT_EQ(parse<Float50>(text).str(42, std::ios::fixed), text);
}

TEST(Numeral, WhatIsNotANumberIsRefused) {
  for (const char* text : {"", "-", "a", "1/0", "1/", "/2", "1/2/3", "1 ", " 1", "1e", "1e99999", "nan",
                           "inf", "0x10", "1.2.3", "--1", "1/0.0", "."}) {
    EXPECT_THROW(parse<Rational>(text), ArgumentError) << text;
    EXPECT_THROW(parse<double>(text), ArgumentError) << text;
  }
}

TEST(KnownAnswers, AllCasesAreLoaded) {
  const KnownAnswers answers = load_known_answers();
  EXPECT_EQ(answers.interior_rings.size(), 6u);
  EXPECT_EQ(answers.boundary_rings.size(), 4u);
  EXPECT_EQ(answers.surfaces.size(), 15u);
  EXPECT_EQ(answers.closed_meshes.size(), 2u);
  EXPECT_EQ(answers.basis.size(), 6u);
  for (const auto& ring : answers.interior_rings)
    EXPECT_EQ(ring.ring.size(), static_cast<std::size_t>(ring.valence));
  for (const auto& ring : answers.boundary_rings)
    EXPECT_EQ(ring.ring.size(), static_cast<std::size_t>(ring.faces) + 1);
}

TEST(KnownAnswers, EveryMeshIsValid) {
  const KnownAnswers answers = load_known_answers();
  for (const auto& surface : answers.surfaces) {
    const auto findings = validate(control_mesh(surface.vertices, surface.faces));
    EXPECT_TRUE(findings.empty()) << surface.id << ": " << findings[0].message;
    ASSERT_LT(static_cast<std::size_t>(surface.face), surface.faces.size());
  }
  for (const auto& mesh : answers.closed_meshes) {
    EXPECT_TRUE(validate(control_mesh(mesh.vertices, mesh.faces)).empty()) << mesh.id;
    EXPECT_EQ(mesh.step1_edge_points.size(), 3 * mesh.faces.size() / 2);
  }
}

// Identities that a number read from the wrong place would break.
TEST(KnownAnswers, TheNumbersAreInTheirPlaces) {
  const KnownAnswers answers = load_known_answers();
  for (const auto& basis : answers.basis) {
    Rational sum, sum_dalpha, sum_dbeta;
    for (std::size_t i = 0; i < 12; ++i) {
      sum += parse<Rational>(basis.b[i]);
      sum_dalpha += parse<Rational>(basis.db_dalpha[i]);
      sum_dbeta += parse<Rational>(basis.db_dbeta[i]);
    }
    EXPECT_EQ(sum, 1) << basis.id;
    EXPECT_EQ(sum_dalpha, 0) << basis.id;
    EXPECT_EQ(sum_dbeta, 0) << basis.id;
  }
  for (const auto& ring : answers.boundary_rings) {  // [D1] along = r_0 - r_K, limit = (4 v + r_0 + r_K) / 6
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto v = parse<Rational>(ring.center[axis]), first = parse<Rational>(ring.ring.front()[axis]),
                 last = parse<Rational>(ring.ring.back()[axis]);
      EXPECT_EQ(parse<Rational>(ring.along[axis]), first - last) << ring.id;
      EXPECT_LT(abs(parse<Rational>(ring.limit_position[axis]) - (4 * v + first + last) / 6),
                Rational("1/1" + std::string(40, '0')))
          << ring.id;
    }
  }
  const auto orthogonal = [](const Numeral3& a, const Numeral3& b) {
    const auto x = parse<Float50>(a), y = parse<Float50>(b);
    return abs(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) < Float50("1e-38");
  };
  for (const auto& ring : answers.interior_rings) {
    EXPECT_TRUE(orthogonal(ring.unit_normal, ring.c) && orthogonal(ring.unit_normal, ring.s)) << ring.id;
    // [C17] u1 = C, u2 = cos(2 pi / n) C + sin(2 pi / n) S
    const Float50 angle = 2 * boost::math::constants::pi<Float50>() / ring.valence;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto c = parse<Float50>(ring.c[axis]), s = parse<Float50>(ring.s[axis]);
      EXPECT_LT(abs(parse<Float50>(ring.paper_u1[axis]) - c), Float50("1e-38")) << ring.id;
      EXPECT_LT(abs(parse<Float50>(ring.paper_u2[axis]) - (cos(angle) * c + sin(angle) * s)),
                Float50("1e-38"))
          << ring.id;
    }
  }
  for (const auto& surface : answers.surfaces) {
    for (const auto& sample : surface.samples) {
      EXPECT_EQ(parse<Rational>(sample.barycentric[0]) + parse<Rational>(sample.barycentric[1]) +
                    parse<Rational>(sample.barycentric[2]),
                1);
      EXPECT_TRUE(orthogonal(sample.unit_normal, sample.d_dl1) &&
                  orthogonal(sample.unit_normal, sample.d_dl2))
          << surface.id;
    }
  }
}

TEST(KnownAnswers, AFileThatIsNotOneIsRefused) {
  EXPECT_THROW(load_known_answers("/nowhere/known_answers.json"), InputError);
  const std::string file = testing::TempDir() + "not_answers.json";
  for (const char* content :
       {"", "[", "{}", R"({"cases":[{"kind":"unheard_of"}]})", R"({"cases":[{"kind":"basis_values"}]})"}) {
    std::ofstream(file) << content;
    EXPECT_THROW(load_known_answers(file), InputError) << content;
  }
}

}  // namespace
}  // namespace limitcheck::data
