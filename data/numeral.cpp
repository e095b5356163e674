// SPDX-License-Identifier: MIT
#include "data/numeral.h"

#include <algorithm>
#include <cstdlib>

#include "data/error.h"

namespace limitcheck::data {
namespace {

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw ArgumentError("'" + std::string(text.substr(0, 60)) + "' " + why);
}
[[noreturn]] void malformed(std::string_view text) {
  refuse(text, "is not a number");
}

/// One side of a fraction: mantissa digits without the point, times 10^exponent.
struct Decimal {
  bool negative = false;
  std::string digits;
  long exponent = 0;
};

Decimal decimal(std::string_view text, std::string_view whole) {
  Decimal result;
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) {
    result.negative = text[0] == '-';
    text.remove_prefix(1);
  }
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view exponent = text.substr(e + 1);
    if (!exponent.empty() && exponent[0] == '+') exponent.remove_prefix(1);
    const auto [end, error] =
        std::from_chars(exponent.data(), exponent.data() + exponent.size(), result.exponent);
    if (error == std::errc::result_out_of_range || std::labs(result.exponent) > 10000)
      refuse(whole, "has an exponent beyond 10000");
    if (error != std::errc() || end != exponent.data() + exponent.size()) malformed(whole);
    text = text.substr(0, e);
  }
  const std::size_t point = text.find('.');
  result.digits = text.substr(0, point);
  if (point != std::string_view::npos) {
    result.digits += text.substr(point + 1);
    result.exponent -= static_cast<long>(text.size() - point - 1);
  }
  const bool only_digits =
      std::all_of(result.digits.begin(), result.digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (result.digits.empty() || !only_digits) malformed(whole);
  result.digits.erase(0, std::min(result.digits.find_first_not_of('0'), result.digits.size()));
  return result;
}

}  // namespace

IntegerQuotient integer_quotient(std::string_view text) {
  const std::size_t slash = text.find('/');
  Decimal top = decimal(text.substr(0, slash), text);
  Decimal bottom{.negative = false, .digits = "1", .exponent = 0};
  if (slash != std::string_view::npos) bottom = decimal(text.substr(slash + 1), text);
  if (bottom.digits.empty()) refuse(text, "divides by zero");
  if (top.digits.empty()) return {"0", "1"};

  // What powers of ten remain goes to the side where it stays an integer.
  const long shift = top.exponent - bottom.exponent;
  (shift >= 0 ? top : bottom).digits.append(static_cast<std::size_t>(std::labs(shift)), '0');
  if (top.negative != bottom.negative) top.digits.insert(0, 1, '-');
  return {std::move(top.digits), std::move(bottom.digits)};
}

}  // namespace limitcheck::data
