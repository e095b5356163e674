// SPDX-License-Identifier: MIT
// What a row measures; its verdict; and the bound of positions against the worst order of long sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/splitmix64.h"
#include "verify/audit/audit.h"
#include "verify/evidence/reference_surface.h"
#include "verify/evidence/vector.h"
#include "verify/report/forms.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"
#include "verify/row/test_rows.h"
#include "verify/row/visible_text.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Statistics, WorstRmsAndTheNinetyNinthPercentile) {
  std::vector<double> errors;
  for (int k = 1; k <= 200; ++k) errors.push_back(k);
  const Statistics s = summarise(errors, 150);
  EXPECT_EQ(s.of, 200);
  EXPECT_EQ(s.bad, 50);
  EXPECT_EQ(s.worst_at, 199);
  EXPECT_EQ(s.worst, 200);
  EXPECT_EQ(s.p99, 198);
  EXPECT_DOUBLE_EQ(*s.rms, std::sqrt(201 * 401 / 6.0));
}

TEST(Statistics, WhatCouldNotBeMeasuredIsBadAndTheWorst) {
  const Statistics s = summarise({1, kInfinity, -1, 2}, 10);
  EXPECT_EQ(s.of, 3);
  EXPECT_EQ(s.bad, 1);
  EXPECT_EQ(s.worst_at, 1);
  EXPECT_FALSE(s.worst.has_value());
  EXPECT_EQ(s.p99, 2);
}

TEST(Statistics, NothingLookedAtIsNoConfirmation) {
  const Statistics s = summarise({-1, -1}, 0);
  EXPECT_EQ(s.of, 0);
  EXPECT_EQ(s.worst_at, -1);
  EXPECT_FALSE(s.rms.has_value());
}

// A stored row whose status was altered, or whose numbers were, does not say any more what its numbers say.
TEST(Verdict, OfARowIsWhatItsNumbersSay) {
  using enum Status;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const struct {
    Status stored;
    std::int64_t bad, of;
    std::optional<double> worst, bound;
    Status verdict;
  } rows[] = {{kHeld, 0, 9, 1e-15, 1e-14, kHeld},
              {kHeld, 0, 9, 1e-14, 1e-14, kHeld},
              {kHeld, 0, 0, {}, 0, kHeld},  // as t-vertices, where there is no open edge
              {kHeld, 0, 9, .5, 1e-14, kFinding},
              {kHeld, 0, 9, none, 1e-14, kFinding},
              {kHeld, 1, 9, 1e-15, 1e-14, kFinding},
              {kFinding, 1, 9, {}, 1e-14, kFinding},  // the worst is not finite
              {kFinding, 1, 9, 0, 0, kFinding},       // zeros of another sign
              {kFinding, 0, 9, 1e-15, 1e-14, kHeld},
              {kQualityWarning, 3, 9, {}, 0, kQualityWarning},
              {kQualityWarning, 0, 9, 2, 1, kFinding},
              {kUnexpectedPass, 0, 9, 2, 1, kFinding},
              {kNotRun, 0, 0, {}, {}, kNotRun},
              {kNotRun, 0, 9, {}, {}, kHeld},
              {kNotRun, 2, 9, {}, {}, kFinding},
              {kNotSupported, 1, 1, {}, 0, kNotSupported},  // a request of several
              {kWaived, 1, 9, .5, 1e-14, kWaived},
              {kCrash, 0, 0, {}, {}, kCrash}};
  for (const auto& [stored, bad, of, worst, bound, verdict] : rows) {
    Result r;
    r.status = stored, r.bad = bad, r.of = of, r.worst = worst, r.bound = bound;
    EXPECT_EQ(word(verdict_of(r)), word(verdict)) << word(stored) << ": " << bad << " of " << of;
  }
}

TEST(Angle, IsAccurateNearZeroAndNearAHalfTurn) {
  const double tiny = 1e-12;
  EXPECT_NEAR(angle_degrees({1, 0, 0}, {2 * std::cos(tiny), 2 * std::sin(tiny), 0}) / 57.295779513082320877,
              tiny, 1e-22);
  EXPECT_EQ(angle_degrees({0, 3, 0}, {0, -1, 0}), 180);
  EXPECT_NEAR(angle_degrees({0, 0, 1}, {0, 1, 0}), 90, 1e-13);
  EXPECT_EQ(angle_degrees({0, 0, 0}, {0, 1, 0}), kInfinity);
}

// The error of a sum in this order, exactly: that of each addition is a number of the same precision (Knuth).
template <class T>
double error_of_sum(const std::vector<T>& terms) {
  T sum = 0;
  double error = 0;
  for (const T x : terms) {
    const T next = sum + x, part = next - sum;
    error += static_cast<double>((sum - (next - part)) + (x - part));
    sum = next;
  }
  return std::abs(error);
}

// The vertex first, with nearly all of the weight, as at a high valence of Catmull-Clark's scheme; then its ring,
// each point of which is rounded up from just above the middle between two numbers. All coordinates alike.
template <class T>
double worst_error(std::int64_t terms, lc_precision precision) {
  std::vector<T> products(static_cast<std::size_t>(terms), static_cast<T>(1.02 * unit_roundoff(precision)));
  products[0] = 1;
  return std::sqrt(3.0) * error_of_sum(products);
}

// M and the diagonal are 1, and there is one mask, at depth 0.
TEST(PositionBound, HoldsForTheWorstOrderOfSumsAtAnyValence) {
  for (std::int64_t valence = 100; valence <= 1'000'000; valence *= 10)
    for (const std::int64_t terms : {valence + 1, 2 * valence + 1}) {
      const double in_float = worst_error<float>(terms, LC_FLOAT32),
                   in_double = worst_error<double>(terms, LC_FLOAT64);
      EXPECT_LE(in_float, position_bound(LC_FLOAT32, 0, 1, 1, terms)) << terms;
      EXPECT_LE(in_double, position_bound(LC_FLOAT64, 0, 1, 1, terms)) << terms;
      EXPECT_GT(in_float, position_bound(LC_FLOAT32, 0, 1, 1, terms) / 3)
          << "the bound is no wider than it must be";
      EXPECT_GT(in_float, position_bound(LC_FLOAT32, 0, 1, 1)) << "eight roundings are not enough";
    }
}

// Up to kOrdinaryTerms a step stays below eight roundings, with points of a mesh in any order.
TEST(PositionBound, OfOrdinaryValencesIsEightRoundingsAStep) {
  data::SplitMix64 random(1);
  for (std::int64_t terms = 3; terms <= kOrdinaryTerms; ++terms) {
    for (const int depth : {0, 1, 5})
      for (const lc_precision precision : {LC_FLOAT32, LC_FLOAT64}) {
        const double old = std::sqrt(3.0) * 8 * (depth + 2) * unit_roundoff(precision) * .3;
        EXPECT_EQ(position_bound(precision, depth, .3, 1, terms),
                  precision == LC_FLOAT32 ? old : std::max(old, 1e-14));
      }
    double worst = 0;
    for (int k = 0; k < 2000; ++k) {
      std::vector<float> products;
      for (std::int64_t n = 0; n < terms; ++n)
        products.push_back(static_cast<float>(static_cast<double>(random.next() >> 11) * 0x1p-53) /
                           static_cast<float>(terms));
      worst = std::max(worst, error_of_sum(products));
    }
    EXPECT_LE(worst, 8 * unit_roundoff(LC_FLOAT32)) << terms;
  }
}

TEST(PositionBound, KnowsTheValenceOfThePlace) {
  const auto mesh = data::named_mesh("bipyramid:100");
  const ReferenceSurface surface(mesh, 1, LC_POINTS_LIMIT);
  EXPECT_EQ(surface.terms_at(0), 101);
  const auto ordinary = data::named_mesh("bumpy:60");
  EXPECT_EQ(ReferenceSurface(ordinary, 1, LC_POINTS_LIMIT).terms_at(0), kOrdinaryTerms);

  const auto rows = Auditor(1, 2).run({lc_subject_naive(), ""}, {"bipyramid:100", mesh});
  const Result& positions = row(rows, "positions");
  EXPECT_EQ(positions.status, Status::kHeld);
  ASSERT_TRUE(positions.ill_conditioned) << "at vertices of high valence";
  EXPECT_EQ(positions.ill_conditioned->count, positions.of);
  EXPECT_GT(positions.ill_conditioned->bound, 1e-14);
}

TEST(VisibleText, ShowsWhatATerminalOrXmlWouldNotTake) {
  const std::string none = "\xef\xbf\xbd";
  const struct {
    std::string is, shown;
  } cases[] = {{"Größe 网格 \U0001f600\n\tx", "Größe 网格 \U0001f600\n\tx"},
               {"\x1b[31mred", "\xe2\x90\x9b[31mred"},  // ESC
               {std::string("\0\r\x7f", 3), "\xe2\x90\x80\xe2\x90\x8d\xe2\x90\xa1"},
               {"caf\xe9.obj", "caf" + none + ".obj"},  // Latin-1
               {"\xc2\x9b"
                "2J",
                none + "2J"},                                     // U+009B opens sequences as ESC [ does
               {"\xef\xbf\xbe|\xef\xb7\x90", none + "|" + none},  // U+FFFE, U+FDD0
               {"\xed\xa0\x80", none + none + none},              // a lone surrogate
               {"\xc0\xaf|\xf4\x90\x80\x80|\xe2\x82",
                none + none + "|" + none + none + none + none + "|" + none + none}};
  for (const auto& [is, shown] : cases) EXPECT_EQ(visible_text(is), shown) << is;
}

TEST(VisibleText, OfAnyBytesIsUtf8WithoutControlCharactersAndStaysAsItIs) {
  data::SplitMix64 random(1);
  for (int k = 0; k < 20000; ++k) {
    std::string bytes(random.next() % 12, '\0');
    for (char& c : bytes)
      c = static_cast<char>(random.next() % 4 == 0 ? random.next() % 0x20 : random.next());
    const std::string shown = visible_text(bytes), xml = xml_text(bytes);
    EXPECT_EQ(visible_text(shown), shown);
    EXPECT_NO_THROW((void)nlohmann::json(shown).dump()) << shown;  // which takes nothing but UTF-8
    EXPECT_NO_THROW((void)nlohmann::json(xml).dump()) << xml;
    const auto is_control = [](char c) {
      return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    };
    EXPECT_TRUE(std::none_of(shown.begin(), shown.end(), is_control));
    EXPECT_EQ(xml.find_first_of("<>\"\n\t\x1b"), std::string::npos);
  }
}

}  // namespace
}  // namespace limitcheck::verify
