// SPDX-License-Identifier: MIT
#include "reference/point/parameter.h"
#include "data/error.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace {

constexpr std::size_t kMaxCharacters = 10000;
constexpr int kMaxExponent = 10000;

[[noreturn]] void refuse(std::string_view text, const char* why) {
  throw data::ArgumentError("'" + std::string(text.substr(0, 60)) + "' " + why);
}

bool all_digits(std::string_view s) {
  for (const char c : s)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return false;
  return true;
}

/// [+-] digits [. digits] [e [+-] digits]
Rational parse_decimal(std::string_view whole, std::string_view text) {
  std::string_view s = text;
  bool negative = false;
  if (!s.empty() && (s.front() == '-' || s.front() == '+')) {
    negative = s.front() == '-';
    s.remove_prefix(1);
  }
  int exponent = 0;
  if (const auto e = s.find_first_of("eE"); e != std::string_view::npos) {
    std::string_view digits = s.substr(e + 1);
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (error == std::errc::result_out_of_range || std::abs(exponent) > kMaxExponent)
      refuse(whole, "has an exponent beyond 10000");
    if (error != std::errc() || end != digits.data() + digits.size()) refuse(whole, "is not a number");
    s = s.substr(0, e);
  }
  std::string digits(s);
  if (const auto point = digits.find('.'); point != std::string::npos) {
    exponent -= static_cast<int>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  if (digits.empty() || !all_digits(digits)) refuse(whole, "is not a number");
  digits.erase(0,
               std::min(digits.find_first_not_of('0'), digits.size() - 1));  // a leading 0 would mean octal
  Integer mantissa(digits);
  const Integer power = boost::multiprecision::pow(Integer(10), static_cast<unsigned>(std::abs(exponent)));
  if (negative) mantissa = -mantissa;
  return exponent < 0 ? Rational(mantissa, power) : Rational(mantissa * power);
}

}  // namespace

Parameter Parameter::fraction(std::int64_t numerator, std::int64_t denominator) {
  if (denominator == 0) throw data::ArgumentError("denominator is zero");
  Parameter p(static_cast<double>(numerator) / static_cast<double>(denominator));
  Rational value = Rational(numerator) / Rational(denominator);
  p.exact_ = std::make_shared<RationalParameter>(RationalParameter{std::move(value)});
  return p;
}

Parameter Parameter::parse(std::string_view text) {
  if (text.size() > kMaxCharacters) refuse(text, "... is longer than 10000 characters");
  const auto slash = text.find('/');
  Rational value = parse_decimal(text, text.substr(0, slash));
  if (slash != std::string_view::npos) {
    const Rational denominator = parse_decimal(text, text.substr(slash + 1));
    if (denominator == 0) refuse(text, "divides by zero");
    value /= denominator;
  }
  Parameter p(value.convert_to<double>());
  p.exact_ = std::make_shared<RationalParameter>(RationalParameter{std::move(value)});
  return p;
}

Parameter Parameter::complement(const Parameter& l1, const Parameter& l2) {
  Rational value = 1 - exact_value(l1) - exact_value(l2);
  Parameter p(value.convert_to<double>());
  p.exact_ = std::make_shared<RationalParameter>(RationalParameter{std::move(value)});
  return p;
}

std::string Parameter::to_string() const {
  return exact_value(*this).str();
}

}  // namespace limitcheck::reference
