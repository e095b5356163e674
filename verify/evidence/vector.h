// SPDX-License-Identifier: MIT
// The few operations on points in double that the checks need.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "data/numeral.h"

namespace limitcheck::verify {

using Vector = std::array<double, 3>;

/// Of the engines' and the reference's vectors.
template <class V>
Vector vector_of(const V& v) {
  return {v.x, v.y, v.z};
}
/// Of three certified numbers (reference/surface/certified.h), rounded.
template <class Enclosure>
Vector vector_of(const std::array<Enclosure, 3>& v) {
  return {data::parse<double>(v[0].value), data::parse<double>(v[1].value), data::parse<double>(v[2].value)};
}

inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator*(double factor, const Vector& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Vector& a) {
  return std::sqrt(dot(a, a));
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool is_finite(const Vector& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}
inline double largest(const Vector& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// The sum of a triangle's sides.
inline double perimeter(const Vector& a, const Vector& b, const Vector& c) {
  return norm(b - a) + norm(c - b) + norm(a - c);
}

/// The angle between two vectors in degrees, accurate to a few ulps near 0 and 180 too (Kahan: the arccosine
/// of a scalar product cannot tell angles below 1e-8 apart). Infinite if one is zero or not finite.
inline double angle_degrees(const Vector& a, const Vector& b) {
  const double length_a = norm(a), length_b = norm(b);
  if (!(length_a > 0 && length_b > 0) || !is_finite(a) || !is_finite(b))
    return std::numeric_limits<double>::infinity();
  const Vector p{a[0] * length_b, a[1] * length_b, a[2] * length_b};
  const Vector q{b[0] * length_a, b[1] * length_a, b[2] * length_a};
  return 2 * std::atan2(norm(p - q), norm(p + q)) * 57.295779513082320877;
}

}  // namespace limitcheck::verify
