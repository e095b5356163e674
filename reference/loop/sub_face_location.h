// SPDX-License-Identifier: MIT
// Which of the four sub-faces of a control face a point lies in, and after how many steps it is away from the
// corner.
#pragma once

#include <cmath>

#include "data/error.h"
#include "reference/loop/patch.h"
#include "reference/number/number.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference::detail {

/// Where a point lies after one step, decided on the parameters alone (P is double or Rational).
template <class P>
struct SubFaceLocation {
  int subface;                   ///< 0..2 at a corner, 3 the middle
  P u, v;                        ///< coordinates in the sub-face: towards its second and third corner
  ParameterGradients gradients;  ///< of u and v
};

template <class P>
SubFaceLocation<P> locate(P l1, P l2) {
  if (!(l1 >= 0) || !(l2 >= 0) || !(l1 + l2 <= 1))
    throw data::ArgumentError("l1, l2 must be >= 0 and l1 + l2 <= 1");
  if (l2 > 1 - l1) (l1 > l2 ? l2 : l1) = 1 - (l1 > l2 ? l1 : l2);  // the sum was rounded to 1
  const P half = P(1) / P(2);
  // Differences from 1 are exact in double where it matters: next to the corner they are measured from.
  if (l1 >= half) return {1, 2 * l2, 2 * ((1 - l1) - l2), {0, 1, -1, -1, 1}};
  if (l2 >= half) return {2, 2 * ((1 - l2) - l1), 2 * l1, {-1, -1, 1, 0, 1}};
  if (l1 + l2 <= half) return {0, 2 * l1, 2 * l2, {1, 0, 0, 1, 1}};
  return {3, 2 * (l1 + l2) - 1, 1 - 2 * l1, {1, 1, -1, 0, 1}};
}

/// Smallest J >= 0 with 2^J (u + v) > 1/2, for 0 < u + v <= 1: the point is in the ring of sub-triangles that
/// step J + 1 of the corner's sector adds.
inline long steps_to_corner(double u, double v) {
  const double sum = u + v;
  int exponent;
  const double mantissa = std::frexp(sum, &exponent);  // sum = mantissa 2^exponent, mantissa in [1/2, 1)
  return std::max(0L, static_cast<long>(mantissa == 0.5 ? 1 - exponent : -exponent));
}
inline long steps_to_corner(const Rational& u, const Rational& v) {
  const Rational sum = u + v;
  long steps = static_cast<long>(msb(denominator(sum))) - static_cast<long>(msb(numerator(sum))) - 2;
  if (steps < 0) steps = 0;
  while (numerator(sum) << static_cast<unsigned long>(steps + 1) <= denominator(sum)) ++steps;
  return steps;
}
inline double scaled(double a, long e) {
  return std::ldexp(a, static_cast<int>(e));
}
inline Rational scaled(const Rational& a, long e) {
  return Rational(numerator(a) << static_cast<unsigned long>(e), denominator(a));
}

template <class N>
N number_from(double a) {
  return NumberTraits<N>::from_double(a);
}
template <class N>
N number_from(const Rational& a) {
  if constexpr (std::is_same_v<N, double>)
    return a.convert_to<double>();
  else
    return NumberTraits<N>::from_rational(a);
}

}  // namespace limitcheck::reference::detail
