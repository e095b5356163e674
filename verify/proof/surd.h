// SPDX-License-Identifier: MIT
// a + b sqrt(3), a and b rational: what the weights of valences 3, 4 and 6 are made of. Heavy: for .cpp
// files.
#pragma once

#include "reference/number_exact.h"

namespace limitcheck::verify {

struct Surd {
  reference::Rational a, b;

  Surd() = default;
  Surd(int value) : a(value) {}  // NOLINT: integers are surds
  explicit Surd(reference::Rational rational, reference::Rational root = 0)
      : a(std::move(rational)), b(std::move(root)) {}
  /// cos, sin (2 pi p / q); throws std::domain_error if it is neither rational nor a multiple of sqrt(3).
  static Surd cosine(std::int64_t p, std::int64_t q) {
    using T = reference::NumberTraits<reference::Rational>;
    const std::int64_t twelfth = 12 * p % q == 0 ? 12 * p / q % 12 : 0;
    if (twelfth % 12 == 1 || twelfth % 12 == 11 || twelfth == -1 || twelfth == -11)
      return Surd(0, reference::Rational(1, 2));
    if (twelfth == 5 || twelfth == 7 || twelfth == -5 || twelfth == -7)
      return Surd(0, reference::Rational(-1, 2));
    return Surd(T::cos_pi(2 * p, q));
  }
  static Surd sine(std::int64_t p, std::int64_t q) { return cosine(4 * p - q, 4 * q); }

  double approximation() const {
    return a.convert_to<double>() + b.convert_to<double>() * 1.7320508075688772;
  }
  bool is_zero() const { return a == 0 && b == 0; }

  Surd& operator+=(const Surd& o) {
    a += o.a;
    if (o.b != 0) b += o.b;
    return *this;
  }
  Surd& operator-=(const Surd& o) {
    a -= o.a;
    if (o.b != 0) b -= o.b;
    return *this;
  }
  Surd& operator*=(const Surd& o) {
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
    if (norm == 0) throw std::domain_error("division by zero");
    return *this *= Surd(o.a / norm, -o.b / norm);
  }
  friend Surd operator+(Surd x, const Surd& y) { return x += y; }
  friend Surd operator-(Surd x, const Surd& y) { return x -= y; }
  friend Surd operator*(Surd x, const Surd& y) { return x *= y; }
  friend Surd operator/(Surd x, const Surd& y) { return x /= y; }
  friend Surd operator-(const Surd& x) { return Surd(-x.a, -x.b); }
  friend bool operator==(const Surd&, const Surd&) = default;
  friend bool operator<(const Surd& x, const Surd& y) { return x.approximation() < y.approximation(); }
  friend bool operator>(const Surd& x, const Surd& y) { return y < x; }
};

}  // namespace limitcheck::verify
