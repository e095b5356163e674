// SPDX-License-Identifier: MIT
#include "reference/point/radius.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace limitcheck::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// More than the roundings of a few operations in double.
constexpr double kUpward = 1 + 1e-14;

}  // namespace

Radius::Radius(double digits, long exponent) {
  if (digits == 0) return;
  if (!(digits < kInfinity)) {
    exponent_ = 1L << 40;
    digits_ = kInfinity;
    return;
  }
  for (; digits >= 10; ++exponent) digits = digits / 10 * kUpward;
  for (; digits < 1; --exponent) digits = digits * 10 * kUpward;
  if (digits >= 10) digits /= 10, ++exponent;  // 1 at last, and more by rounding upwards
  exponent_ = exponent;
  digits_ = digits;
}

double Radius::as_double() const {
  if (digits_ == 0 || digits_ == kInfinity) return digits_;
  if (exponent_ < -400) return std::numeric_limits<double>::denorm_min();
  if (exponent_ > 400) return kInfinity;
  return std::nextafter(std::strtod(to_string(17).c_str(), nullptr), kInfinity);
}

std::string Radius::to_string(int digits) const {
  if (digits_ == 0) return "0";
  if (digits_ == kInfinity) return "inf";
  const double unit = std::pow(10.0, digits - 1);
  double shown = digits < 17 ? std::ceil(digits_ * unit) / unit : digits_;
  long exponent = exponent_;
  if (shown >= 10) shown /= 10, ++exponent;
  char text[64];
  std::snprintf(text, sizeof text, "%.*fe%+03ld", digits - 1, shown, exponent);
  return text;
}

}  // namespace limitcheck::reference
