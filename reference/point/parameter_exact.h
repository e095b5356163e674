// SPDX-License-Identifier: MIT
// The exact value behind a Parameter, and parameters as numbers. P is the type of a parameter: double or
// Rational. Heavy: include from .cpp files.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "reference/number/number_exact.h"
#include "reference/point/parameter.h"

namespace limitcheck::reference {

struct RationalParameter {
  Rational value;
};

inline Rational exact_value(const Parameter& p) {
  return p.exact() ? p.exact()->value : Rational(p.as_double());
}

/// a as a number: rounded, where N is.
template <class N, class P>
N number_from(const P& a) {
  if constexpr (std::is_same_v<N, P>)
    return a;
  else if constexpr (std::is_same_v<P, double>)
    return NumberTraits<N>::from_double(a);
  else if constexpr (std::is_same_v<N, double>)
    return a.template convert_to<double>();
  else
    return NumberTraits<N>::from_rational(a);
}

/// Smallest J >= 0 with 2^J a > 1/2, for 0 < a <= 1: so many steps away from a corner at the distance a, a point
/// is in the ring that the next step makes regular.
inline long steps_to_corner(double a) {
  int exponent;
  const double mantissa = std::frexp(a, &exponent);  // a = mantissa 2^exponent, mantissa in [1/2, 1)
  return std::max(0L, static_cast<long>(mantissa == 0.5 ? 1 - exponent : -exponent));
}
inline long steps_to_corner(const Rational& a) {
  long steps =
      std::max(0L, static_cast<long>(msb(denominator(a))) - static_cast<long>(msb(numerator(a))) - 2);
  while (numerator(a) << static_cast<unsigned long>(steps + 1) <= denominator(a)) ++steps;
  return steps;
}
/// a 2^e
inline double times_power_of_two(double a, long e) {
  return std::ldexp(a, static_cast<int>(e));
}
inline Rational times_power_of_two(const Rational& a, long e) {
  return NumberTraits<Rational>::scale(a, e);
}

}  // namespace limitcheck::reference
