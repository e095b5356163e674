// SPDX-License-Identifier: MIT
// The number types of weights, with the functions that kernels and reference need of them. For .cpp files.
#pragma once

#include "reference/number/number_exact.h"
#include "verify/proof/numbers/residue.h"
#include "verify/proof/numbers/surd.h"

namespace limitcheck::verify {

/// Constructs weights from ratios, cosines and sines, and compares them.
template <class C>
struct Coefficient {
  static C ratio(int p, int q) { return C(p) / C(q); }
  static C cosine(std::int64_t p, std::int64_t q) { return C::cosine(p, q); }
  static C sine(std::int64_t p, std::int64_t q) { return C::sine(p, q); }
  static double approximate(const C& c) { return c.approximation(); }
  static bool is_zero(const C& c) { return c.is_zero(); }
  static bool equal(const C& a, const C& b) { return a == b; }
};

/// 50 decimal digits; numbers that differ by less than kTolerance are equal.
template <>
struct Coefficient<reference::Decimal50> {
  using C = reference::Decimal50;
  using T = reference::NumberTraits<C>;
  static constexpr double kTolerance = 1e-45;
  static C ratio(int p, int q) { return C(p) / C(q); }
  static C cosine(std::int64_t p, std::int64_t q) { return T::cos_pi(2 * p, q); }
  static C sine(std::int64_t p, std::int64_t q) { return T::cos_pi(4 * p - q, 2 * q); }
  static double approximate(const C& c) { return T::approximate(c); }
  static bool is_zero(const C& c) { return c == 0; }
  static bool equal(const C& a, const C& b) { return abs(a - b) < kTolerance; }
};

}  // namespace limitcheck::verify

namespace limitcheck::reference {

/// The reference compares sizes only where it makes unit normals, and a linear map has no normals: the
/// functions for them return anything.
template <class C>
struct ProofNumberTraits {
  static C cos_pi(long p, long q) { return C::cosine(p, 2 * q); }
  static C sqrt(const C&) { return C(1); }
  static long exponent(const C& a) { return a.is_zero() ? kZeroExponent : 0; }
  static long precision() { return 0; }
  static constexpr int kNormalThreshold = 0;
  static constexpr int kRounding = 0;
  static double approximate(const C& a) { return a.approximation(); }
};

template <>
struct NumberTraits<verify::Residue> : ProofNumberTraits<verify::Residue> {
  using N = verify::Residue;
  static N scale(const N& a, long e) { return a * N::power_of_two(e); }
  /// Of small numerator and denominator: lattice points.
  static N from_rational(const Rational& a) {
    return N(numerator(a).convert_to<int>()) / N(denominator(a).convert_to<int>());
  }
};

template <>
struct NumberTraits<verify::Surd> : ProofNumberTraits<verify::Surd> {
  using N = verify::Surd;
  static N scale(const N& a, long e) {
    N power(1);
    for (long k = 0; k < (e < 0 ? -e : e); ++k) power *= N(2);
    return e < 0 ? a / power : a * power;
  }
  static N from_rational(const Rational& a) { return N(a); }
};

}  // namespace limitcheck::reference
