// SPDX-License-Identifier: MIT
#include "data/test_support/known_answers.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <fstream>

#include "data/error.h"

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
  for (const char* text : {"", "-", "a", "1/0", "1/", "/2", "1/2/3", "1 ", " 1", "1e", "1e99999",
                           "1e-999999999999", "nan", "inf", "0x10", "1.2.3", "--1", "1/0.0", "."}) {
    EXPECT_THROW(parse<Rational>(text), ArgumentError) << text;
    EXPECT_THROW(parse<double>(text), ArgumentError) << text;
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
