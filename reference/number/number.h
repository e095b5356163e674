// SPDX-License-Identifier: MIT
// The functions that a number type must have, besides + - * / and construction from int and double.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

namespace limitcheck::reference {

/// The exponent of zero: below that of every other number.
inline constexpr long kZeroExponent = -(1L << 40);

/// Specialised per number type (double here; the others in number_exact.h and ball.h).
template <class N>
struct NumberTraits;

/// Rounded to 53 bits.
template <>
struct NumberTraits<double> {
  /// cos(pi p / q) to within 1 ulp, exact where it is rational: the argument is reduced in integers first.
  static double cos_pi(long p, long q) {
    p %= 2 * q;
    if (p < 0) p += 2 * q;
    if (p > q) p = 2 * q - p;  // cos is even about pi
    if (2 * p > q) return -cos_pi(q - p, q);
    if (2 * p == q) return 0.0;
    if (3 * p == q) return 0.5;
    if (4 * p > q)
      return std::sin(std::numbers::pi * static_cast<double>(q - 2 * p) / static_cast<double>(2 * q));
    return std::cos(std::numbers::pi * static_cast<double>(p) / static_cast<double>(q));
  }
  static double sqrt(double a) { return std::sqrt(a); }
  static double cos(double a) { return std::cos(a); }
  static double sin(double a) { return std::sin(a); }
  /// Binary exponent of a, so that scale(a, -exponent(a)) is in [1, 2); very negative for zero.
  static long exponent(double a) { return a == 0 ? kZeroExponent : std::ilogb(a); }
  /// The cross product of two tangents is not trusted where the sine of their angle is below this. [D12]
  static constexpr double kNormalThreshold = 1e-12;
  /// The relative error of one operation; 0 for numbers that are exact or know their own error.
  static constexpr double kRounding = 0x1p-53;
  /// a * 2^e
  static double scale(double a, long e) { return std::ldexp(a, static_cast<int>(e)); }
  static long precision() { return 53; }
  static double from_double(double a) { return a; }
  static double approximate(double a) { return a; }
};

/// Whether the number type rounds and does not say by how much.
template <class N>
inline constexpr bool kRounds = NumberTraits<N>::kRounding != 0;

/// sin(pi p / q)
template <class N>
N sin_pi(long p, long q) {
  return NumberTraits<N>::cos_pi(2 * p - q, 2 * q);
}

/// a / b as a number
template <class N>
N ratio(long a, long b) {
  return N(static_cast<int>(a)) / N(static_cast<int>(b));
}

/// a^e, e >= 0
template <class N>
N power(N a, long e) {
  N result(1);
  for (; e > 0; e >>= 1) {
    if ((e & 1) != 0) result = result * a;
    if (e > 1) a = a * a;
  }
  return result;
}

/// The cosines and sines of the masks, computed once per thread and m; again when the number type's
/// `precision()` has changed.
template <class N>
struct CircleTable {
  std::vector<N> cosine, sine;  ///< of pi i / m, i = 0..2m-1
};
/// The table of m, made at its first use by a thread.
template <class N>
const CircleTable<N>& circle_table(long m) {
  thread_local std::vector<std::unique_ptr<CircleTable<N>>> tables;
  thread_local long precision = 0;
  if (precision != NumberTraits<N>::precision()) {
    tables.clear();
    precision = NumberTraits<N>::precision();
  }
  const std::size_t index = m;
  if (tables.size() <= index) tables.resize(index + 1);
  if (!tables[index]) {
    auto table = std::make_unique<CircleTable<N>>();
    for (long i = 0; i < 2 * m; ++i) {
      table->cosine.push_back(NumberTraits<N>::cos_pi(i, m));
      table->sine.push_back(sin_pi<N>(i, m));
    }
    tables[index] = std::move(table);
  }
  return *tables[index];
}

}  // namespace limitcheck::reference
