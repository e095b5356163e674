// SPDX-License-Identifier: MIT
// Exact rationals (GMP) and 50 or 100 decimal digits (MPFR) as number types. Heavy: include from .cpp files.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <boost/multiprecision/mpfr.hpp>

#include "data/error.h"
#include "reference/number/number.h"

namespace limitcheck::reference {

/// A quotient of integers of any size.
using Rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
/// An integer of any size.
using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
/// So many decimal digits, correctly rounded.
template <unsigned Digits>
using Decimal = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<Digits>,
                                              boost::multiprecision::et_off>;
/// Fifty digits.
using Decimal50 = Decimal<50>;
/// A hundred digits.
using Decimal100 = Decimal<100>;

/// Exact, as long as no cosine is asked for that is not rational.
template <>
struct NumberTraits<Rational> {
  /// Only 0, +-1/2, +-1 are rational: throws data::ArgumentError otherwise.
  static Rational cos_pi(long p, long q) {
    p %= 2 * q;
    if (p < 0) p += 2 * q;
    if (p > q) p = 2 * q - p;
    if (p == 0) return Rational(1);
    if (p == q) return Rational(-1);
    if (2 * p == q) return Rational(0);
    if (3 * p == q) return Rational(1, 2);
    if (3 * p == 2 * q) return Rational(-1, 2);
    throw data::ArgumentError("cosine is not rational");
  }
  static constexpr int kRounding = 0;
  static Rational scale(const Rational& a, long e) {
    return e < 0 ? Rational(numerator(a), denominator(a) << static_cast<unsigned long>(-e))
                 : Rational(numerator(a) << static_cast<unsigned long>(e), denominator(a));
  }
  static Rational from_double(double a) { return Rational(a); }
  static double approximate(const Rational& a) { return a.convert_to<double>(); }
};

/// Rounded to so many decimals.
template <unsigned Digits>
struct NumberTraits<Decimal<Digits>> {
  using N = Decimal<Digits>;
  static N cos_pi(long p, long q) {
    p %= 2 * q;
    if (p < 0) p += 2 * q;
    if (p > q) p = 2 * q - p;
    if (2 * p > q) return -cos_pi(q - p, q);
    if (2 * p == q) return N(0);
    if (3 * p == q) return N(1) / 2;
    static const N pi = boost::multiprecision::acos(N(-1));
    return boost::multiprecision::cos(pi * p / q);
  }
  static N sqrt(const N& a) { return boost::multiprecision::sqrt(a); }
  static N cos(const N& a) { return boost::multiprecision::cos(a); }
  static N sin(const N& a) { return boost::multiprecision::sin(a); }
  static long exponent(const N& a) { return a == 0 ? kZeroExponent : boost::multiprecision::ilogb(a); }
  static constexpr double kNormalThreshold = Digits <= 50 ? 1e-40 : 1e-90;
  static constexpr double kRounding = Digits <= 50 ? 1e-50 : 1e-100;
  static N scale(const N& a, long e) { return boost::multiprecision::ldexp(a, static_cast<int>(e)); }
  static long precision() { return Digits; }
  static N from_double(double a) { return N(a); }
  static N from_rational(const Rational& a) { return N(numerator(a)) / N(denominator(a)); }
  static double approximate(const N& a) { return a.template convert_to<double>(); }
};

}  // namespace limitcheck::reference
