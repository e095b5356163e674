// SPDX-License-Identifier: MIT
// The number types of weights, with the functions that kernels and reference need of them. For .cpp files.
#pragma once

#include <flint/nmod_vec.h>

#include <algorithm>
#include <array>
#include <boost/operators.hpp>
#include <concepts>
#include <cstdint>
#include <cstdlib>

#include "data/error.h"
#include "reference/number/number_exact.h"

namespace limitcheck::verify {

/// Loop's weights are quotients of integer polynomials in cosines and sines of 2 pi p / q. Modulo a prime
/// that is 1 modulo 4 q those are ordinary residues, sums and products of roots of unity, and the map from
/// the number field to the residues respects + - * /. So equal numbers have equal residues; different ones
/// agree modulo both primes (each near 2^60) with a chance of about 2^-120. `approximation` is the number
/// itself in double: it tells signs, and how large a difference is, nothing else.
class Residue : boost::ordered_field_operators<Residue> {
 public:
  Residue() = default;
  Residue(int value);  // NOLINT: integers are residues
  /// cos(2 pi p / q); throws data::ArgumentError unless q divides kOrder.
  static Residue cosine(std::int64_t p, std::int64_t q);

  /// 16 * 9 * 25 * 7 * 11 * 13 * 17 * 19 * 4: with every n up to 20, with 50 and 100, 4 n divides it.
  static constexpr std::int64_t kOrder = 4655851200;

  double approximation() const { return approximation_; }
  bool is_zero() const { return residue_ == Pair{}; }

  Residue& operator+=(const Residue& b) {
    for (std::size_t k = 0; k < 2; ++k) residue_[k] = nmod_add(residue_[k], b.residue_[k], moduli_[k]);
    approximation_ += b.approximation_;
    return *this;
  }
  Residue& operator-=(const Residue& b) {
    for (std::size_t k = 0; k < 2; ++k) residue_[k] = nmod_sub(residue_[k], b.residue_[k], moduli_[k]);
    approximation_ -= b.approximation_;
    return *this;
  }
  Residue& operator*=(const Residue& b) {
    for (std::size_t k = 0; k < 2; ++k) residue_[k] = nmod_mul(residue_[k], b.residue_[k], moduli_[k]);
    approximation_ *= b.approximation_;
    return *this;
  }
  /// Throws data::ArgumentError: by zero.
  Residue& operator/=(const Residue& b) { return *this *= b.inverse(); }

  friend Residue operator-(const Residue& a) { return Residue() - a; }
  friend bool operator==(const Residue& a, const Residue& b) { return a.residue_ == b.residue_; }
  friend bool operator<(const Residue& a, const Residue& b) { return a.approximation_ < b.approximation_; }

 private:
  friend struct ResidueTables;
  using Pair = std::array<std::uint64_t, 2>;
  Residue inverse() const;
  static const nmod_t moduli_[2];

  Pair residue_{};
  double approximation_ = 0;
};

/// a + b sqrt(3), a and b rational: what the weights of valences 3, 4 and 6 are made of.
struct Surd : boost::ordered_field_operators<Surd> {
  reference::Rational a, b;
  bool known = true;  ///< false: depends on another irrational number, and equals nothing

  Surd() = default;
  Surd(int value) : a(value) {}  // NOLINT: integers are surds
  explicit Surd(reference::Rational rational, reference::Rational root = 0)
      : a(std::move(rational)), b(std::move(root)) {}
  /// cos(2 pi p / q); unknown if it is neither rational nor a multiple of sqrt(3).
  static Surd cosine(std::int64_t p, std::int64_t q) {
    static const reference::Rational none, half(1, 2);
    static const std::array<Surd, 4> twelfths{Surd(1), Surd(none, half), Surd(half), Surd(0)};
    Surd unknown;
    unknown.known = false;
    if (12 * p % q != 0) return unknown;
    const auto turn = static_cast<std::size_t>((12 * p / q % 12 + 12) % 12), t = std::min(turn, 12 - turn);
    return t <= 3 ? twelfths[t] : -twelfths[6 - t];
  }

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
  friend Surd operator-(const Surd& x) { return Surd() - x; }
  friend bool operator==(const Surd& x, const Surd& y) {
    return x.known && y.known && x.a == y.a && x.b == y.b;
  }
  friend bool operator<(const Surd& x, const Surd& y) { return x.approximation() < y.approximation(); }
};

template <class C>
concept Weight = std::same_as<C, Residue> || std::same_as<C, Surd> || std::same_as<C, reference::Rational> ||
    std::same_as<C, reference::Decimal50>;

/// Constructs weights from ratios, cosines and sines, and compares them.
template <class C>
struct Coefficient {
  using T = reference::NumberTraits<C>;
  static constexpr double kTolerance = 1e-45;  ///< decimals that differ by less are equal
  static C ratio(int p, int q) { return C(p) / C(q); }
  static C cosine(std::int64_t p, std::int64_t q) { return T::cos_pi(2 * p, q); }
  static C sine(std::int64_t p, std::int64_t q) { return T::cos_pi(4 * p - q, 2 * q); }
  static double approximate(const C& c) { return T::approximate(c); }
  static bool is_zero(const C& c) { return c.is_zero(); }
  static bool equal(const C& a, const C& b) {
    if constexpr (std::same_as<C, reference::Decimal50>) return abs(a - b) < kTolerance;
    return a == b;
  }
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
  static C scale(const C& a, long e) {
    const C factor = power(C(2), std::abs(e));
    return e < 0 ? a / factor : a * factor;
  }
};

template <>
struct NumberTraits<verify::Residue> : ProofNumberTraits<verify::Residue> {
  using N = verify::Residue;
  /// Of small numerator and denominator: lattice points.
  static N from_rational(const Rational& a) {
    return N(numerator(a).convert_to<int>()) / N(denominator(a).convert_to<int>());
  }
};

template <>
struct NumberTraits<verify::Surd> : ProofNumberTraits<verify::Surd> {
  static verify::Surd from_rational(const Rational& a) { return verify::Surd(a); }
};

}  // namespace limitcheck::reference
