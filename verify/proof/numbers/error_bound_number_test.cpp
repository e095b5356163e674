// SPDX-License-Identifier: MIT
// Single expressions: small enough that real floats come near the bound.
#include "verify/proof/numbers/error_bound_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "data/splitmix64.h"

namespace limitcheck::verify {
namespace {

struct Expression {
  const char* name;
  std::function<BoundFloat(const BoundFloat&, const BoundFloat&)> bound;
  std::function<float(float, float)> computed;
  std::function<double(double, double)> exact;
  bool RoundingModel::*what;  // forgetting this must show
};

BoundFloat ratio(int p, int q) {
  return fast::NumberTraits<BoundFloat>::ratio(p, q);
}

std::vector<Expression> expressions() {
  using N = const BoundFloat&;
  return {
      {"x + y", [](N x, N y) { return x + y; }, [](float x, float y) { return x + y; },
       [](double x, double y) { return x + y; }, &RoundingModel::sums},
      {"3 x", [](N x, N) { return BoundFloat(3) * x; }, [](float x, float) { return 3 * x; },
       [](double x, double) { return 3 * x; }, &RoundingModel::products},
      {"x / 12", [](N x, N) { return ratio(1, 12) * x; }, [](float x, float) { return 1.f / 12 * x; },
       [](double x, double) { return x / 12; }, &RoundingModel::constants},
      {"fma(3, x, y)",
       [](N x, N y) { return BoundFloat(BoundForm::fused(BoundFloat(3).form(), x.form(), 1, y.form())); },
       [](float x, float y) { return std::fma(3.f, x, y); }, [](double x, double y) { return 3 * x + y; },
       &RoundingModel::fused},
      {"float(double(x) + double(y))", [](N x, N y) { return BoundFloat(BoundDouble(x) + BoundDouble(y)); },
       [](float x, float y) { return static_cast<float>(static_cast<double>(x) + static_cast<double>(y)); },
       [](double x, double y) { return x + y; }, &RoundingModel::narrowing},
      {"(x + y) - y, where errors leave",
       [](N x, N y) {
         const BoundFloat s = x + y;
         return s - (s - x);
       },
       [](float x, float y) {
         const float s = x + y;
         return s - (s - x);
       },
       [](double x, double) { return x; }, &RoundingModel::sums},
  };
}

double bound_of(const Expression& e, double reach, const RoundingModel& model) {
  const BoundScope scope(reach, model);
  const BoundFloat x{BoundForm::variable()}, y{BoundForm::variable()};
  return e.bound(x, y).error();
}

double worst_of(const Expression& e, double reach) {
  data::SplitMix64 random(11);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const auto draw = [&] {
      const double near = k % 2 == 0 ? 1 : 0x1p-8;
      return static_cast<float>((random.next() % 2 == 0 ? 1 : -1) * reach * (1 - near * random.unit()));
    };
    const float x = draw(), y = draw();
    worst = std::max(worst, std::abs(static_cast<double>(e.computed(x, y)) - e.exact(x, y)));
  }
  return worst;
}

TEST(BoundNumber, IsReachedByRealFloatsWithinAFewPercent) {
  for (const Expression& e : expressions()) {
    if (std::string(e.name) == "(x + y) - y, where errors leave") continue;
    for (const double reach : {.5, .7, 1., 3.}) {
      const double share = worst_of(e, reach) / bound_of(e, reach, {});
      EXPECT_LE(share, 1) << e.name << " reach " << reach;
      // x / 12 comes in thirds of a rounding
      EXPECT_GT(share, .6) << e.name << " reach " << reach;
    }
  }
}

TEST(BoundNumber, IsExceededWhenAnythingIsForgotten) {
  for (const Expression& e : expressions()) {
    RoundingModel model;
    model.*e.what = false;
    EXPECT_GT(worst_of(e, .5), bound_of(e, .5, model)) << e.name;
    model = {};
    model.unit /= 2;
    if (std::string(e.name) != "(x + y) - y, where errors leave") {
      EXPECT_GT(worst_of(e, .5), bound_of(e, .5, model)) << e.name;
    }
  }
}

TEST(BoundNumber, TakesPowersOfTwoZeroAndCopiesAsExact) {
  const BoundScope scope(.5);
  const BoundFloat x{BoundForm::variable()}, zero;
  EXPECT_LT((BoundFloat(.125) * x).error(), 0x1p-140);
  EXPECT_EQ((x + zero).error(), 0);
  EXPECT_EQ((zero - x).error(), 0);
  EXPECT_EQ((-x).error(), 0);
  EXPECT_TRUE((zero * x).form().is_zero());
}

TEST(BoundNumber, LetsAnErrorLeaveAgain) {
  const BoundScope scope(.5);
  const BoundFloat x{BoundForm::variable()}, y{BoundForm::variable()}, magic(0x1.8p11);
  const BoundFloat origin = (x + magic) - magic;
  EXPECT_GE(origin.error(), 0x1p-13);
  EXPECT_LT(origin.error(), 0x1.01p-13);
  EXPECT_LT(((y - origin) + origin).error(), 0x1p-23);
}

TEST(BoundNumber, HasNoBoundForWhatIsNotLinear) {
  const BoundScope scope(.5);
  const BoundFloat x{BoundForm::variable()}, y{BoundForm::variable()};
  EXPECT_FALSE((x * y).form().bounded());
  EXPECT_FALSE((x / y).form().bounded());
  EXPECT_FALSE((x * y + x).form().bounded());
  EXPECT_FALSE(sqrt(x).form().bounded());
  EXPECT_FALSE(sqrt(x) <= y || sqrt(x) >= y);
}

}  // namespace
}  // namespace limitcheck::verify
