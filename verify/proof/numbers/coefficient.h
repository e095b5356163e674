// SPDX-License-Identifier: MIT
// The number types of weights, with the functions that kernels and reference need of them. For .cpp files.
#pragma once

#include "data/error.h"
#include "reference/number/number_exact.h"
#include "verify/proof/numbers/residue.h"

namespace limitcheck::verify {

/// a + b sqrt(3), a and b rational: what the weights of valences 3, 4 and 6 are made of.
struct Surd {
  reference::Rational a, b;
  bool known = true;  ///< false: depends on another irrational number, and equals nothing

  Surd() = default;
  Surd(int value) : a(value) {}  // NOLINT: integers are surds
  explicit Surd(reference::Rational rational, reference::Rational root = 0)
      : a(std::move(rational)), b(std::move(root)) {}
  /// cos, sin (2 pi p / q); unknown if it is neither rational nor a multiple of sqrt(3).
  static Surd cosine(std::int64_t p, std::int64_t q) {
    using T = reference::NumberTraits<reference::Rational>;
    Surd result;
    if (12 * p % q != 0) {
      result.known = false;
      return result;
    }
    const std::int64_t twelfths = (12 * p / q % 12 + 12) % 12;
    if (twelfths % 2 == 0 || twelfths % 3 == 0) {
      result.a = T::cos_pi(2 * p, q);
    } else {
      result.b = reference::Rational(twelfths == 1 || twelfths == 11 ? 1 : -1, 2);
    }
    return result;
  }
  static Surd sine(std::int64_t p, std::int64_t q) { return cosine(4 * p - q, 4 * q); }

  double approximation() const {
    return a.convert_to<double>() + b.convert_to<double>() * 1.7320508075688772;
  }
  bool is_zero() const { return known && a == 0 && b == 0; }

  Surd& operator+=(const Surd& o) {
    known = known && o.known;
    a += o.a;
    if (o.b != 0) b += o.b;
    return *this;
  }
  Surd& operator-=(const Surd& o) {
    known = known && o.known;
    a -= o.a;
    if (o.b != 0) b -= o.b;
    return *this;
  }
  Surd& operator*=(const Surd& o) {
    known = known && o.known;
    if (b == 0 && o.b == 0) {
      a *= o.a;
      return *this;
    }
    const reference::Rational rational = a * o.a + 3 * b * o.b;
    b = a * o.b + b * o.a;
    a = rational;
    return *this;
  }
  Surd& operator/=(const Surd& o) {
    const reference::Rational norm = o.a * o.a - 3 * o.b * o.b;
    known = known && o.known;
    if (norm == 0) {
      if (!known) return *this;
      throw data::ArgumentError("division by zero");
    }
    return *this *= Surd(o.a / norm, -o.b / norm);
  }
  friend Surd operator+(Surd x, const Surd& y) { return x += y; }
  friend Surd operator-(Surd x, const Surd& y) { return x -= y; }
  friend Surd operator*(Surd x, const Surd& y) { return x *= y; }
  friend Surd operator/(Surd x, const Surd& y) { return x /= y; }
  friend Surd operator-(const Surd& x) { return Surd() - x; }
  friend bool operator==(const Surd& x, const Surd& y) {
    return x.known && y.known && x.a == y.a && x.b == y.b;
  }
  friend bool operator<(const Surd& x, const Surd& y) { return x.approximation() < y.approximation(); }
  friend bool operator>(const Surd& x, const Surd& y) { return y < x; }
};

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
