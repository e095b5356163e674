// SPDX-License-Identifier: MIT
// a + b sqrt(3), a and b rational: what the weights of valences 3, 4 and 6 are made of. Heavy: for .cpp
// files.
#pragma once

#include "data/error.h"
#include "reference/number/number_exact.h"

namespace limitcheck::verify {

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

}  // namespace limitcheck::verify
