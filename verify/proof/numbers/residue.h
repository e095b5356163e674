// SPDX-License-Identifier: MIT
// Algebraic numbers as fast as machine words: exact modulo two primes.
#pragma once

#include <flint/nmod_vec.h>

#include <array>
#include <cstdint>

namespace limitcheck::verify {

/// Loop's weights are quotients of integer polynomials in cosines and sines of 2 pi p / q. Modulo a prime
/// that is 1 modulo 4 q those are ordinary residues, sums and products of roots of unity, and the map from
/// the number field to the residues respects + - * /. So equal numbers have equal residues; different ones
/// agree modulo both primes (each near 2^60) with a chance of about 2^-120. `approximation` is the number
/// itself in double: it tells signs, and how large a difference is, nothing else.
class Residue {
 public:
  Residue() = default;
  Residue(int value);  // NOLINT: integers are residues
  /// cos, sin (2 pi p / q); throws data::ArgumentError unless q, for the sine 4 q, divides kOrder.
  static Residue cosine(std::int64_t p, std::int64_t q);
  static Residue sine(std::int64_t p, std::int64_t q);
  static Residue power_of_two(long exponent);

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

  friend Residue operator+(Residue a, const Residue& b) { return a += b; }
  friend Residue operator-(Residue a, const Residue& b) { return a -= b; }
  friend Residue operator*(Residue a, const Residue& b) { return a *= b; }
  friend Residue operator/(Residue a, const Residue& b) { return a /= b; }
  friend Residue operator-(const Residue& a) { return Residue() - a; }
  friend bool operator==(const Residue& a, const Residue& b) { return a.residue_ == b.residue_; }
  friend bool operator<(const Residue& a, const Residue& b) { return a.approximation_ < b.approximation_; }
  friend bool operator>(const Residue& a, const Residue& b) { return b < a; }

 private:
  friend struct ResidueTables;
  using Pair = std::array<std::uint64_t, 2>;
  Residue inverse() const;
  static const nmod_t moduli_[2];

  Pair residue_{};
  double approximation_ = 0;
};

}  // namespace limitcheck::verify
