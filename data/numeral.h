// SPDX-License-Identifier: MIT
// Numbers written as text, turned into any number type without losing a digit the type can hold.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

namespace limitcheck::data {

/// A number as text: an integer "-3", a fraction "-9/500", or a decimal "0.0122", "1e-3".
using Numeral = std::string;
/// A point or vector of them.
using Numeral3 = std::array<Numeral, 3>;

/// The same number as a quotient of two integers in plain digits (no leading zeros or '+', denominator > 0).
struct IntegerQuotient {
  std::string numerator;
  std::string denominator;
};

/// Exact for every fraction and decimal.
///   throws   ArgumentError: not a numeral, a zero denominator, or an exponent beyond +-10000
IntegerQuotient integer_quotient(std::string_view text);

/// The numeral as an `N`.
///   float, double, long double   decimals correctly rounded; fractions are one division of two rounded
///                                integers
///   anything else                N(numerator) / N(denominator), N made from digit strings: exact in
///                                rationals, one rounding in multiprecision floats wide enough for the digits
/// Throws as integer_quotient does.
template <class N>
N parse(std::string_view text) {
  if constexpr (std::is_floating_point_v<N>) {
    if (text.find('/') == std::string_view::npos) {
      N value{};
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
    }
    const IntegerQuotient quotient = integer_quotient(text);
    N numerator{}, denominator{1};
    std::from_chars(quotient.numerator.data(), quotient.numerator.data() + quotient.numerator.size(),
                    numerator);
    std::from_chars(quotient.denominator.data(), quotient.denominator.data() + quotient.denominator.size(),
                    denominator);
    return numerator / denominator;
  } else {
    const IntegerQuotient quotient = integer_quotient(text);
    if (quotient.denominator == "1") return N(quotient.numerator);
    return N(N(quotient.numerator) / N(quotient.denominator));
  }
}

/// Each component by itself; throws as that does.
template <class N>
std::array<N, 3> parse(const Numeral3& text) {
  return {parse<N>(text[0]), parse<N>(text[1]), parse<N>(text[2])};
}

/// How many numbers a text "A" or "A:B", with this separator, has; 0: it is something else.
template <class First, class Second>
int read_numbers(const std::string& text, char separator, First& first, Second& second) {
  const char* const last = text.data() + text.size();
  std::from_chars_result read = std::from_chars(text.data(), last, first);
  const bool both = read.ec == std::errc() && read.ptr != last && *read.ptr == separator;
  if (both) read = std::from_chars(read.ptr + 1, last, second);
  return read.ec != std::errc() || read.ptr != last ? 0 : both ? 2 : 1;
}

}  // namespace limitcheck::data
