// SPDX-License-Identifier: MIT
// Vectors over any number type, points in double, their bounding box, and where coordinates are placed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>

namespace limitcheck::fast {

/// Three coordinates. N needs + and -, and multiplication by a scalar S from the left; cross and dot need N *
/// N.
template <class N>
struct Vec3 {
  N x{}, y{}, z{};

  constexpr N& operator[](std::integral auto c) { return c == 0 ? x : c == 1 ? y : z; }
  constexpr const N& operator[](std::integral auto c) const { return c == 0 ? x : c == 1 ? y : z; }

  friend constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  template <class S>
  friend constexpr Vec3 operator*(const S& s, const Vec3& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// a . b
template <class N>
constexpr N dot(const Vec3<N>& a, const Vec3<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// a x b
template <class N>
constexpr Vec3<N> cross(const Vec3<N>& a, const Vec3<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// What cameras and heuristics compute with.
using Point3 = Vec3<double>;

/// A control point as a vector.
constexpr Point3 to_point(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}
/// Euclidean.
inline double length(const Point3& a) {
  return std::sqrt(dot(a, a));
}
/// Whether no component is NaN or infinite.
inline bool is_finite(const Point3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Of one point or more.
struct Box {
  explicit Box(std::span<const std::array<double, 3>> positions) : low(positions.front()), high(low) {
    for (const auto& p : positions) {
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    }
  }
  double middle(std::size_t axis) const { return low[axis] / 2 + high[axis] / 2; }
  /// The longest side.
  double size() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }

  std::array<double, 3> low, high;
};

/// position = centre + unit * x, the unit a power of two: a mesh about the origin and of size about 1, so
/// that squares neither vanish nor overflow and no digits are lost to a common offset.
template <class T>
struct Placement {
  T centre[3]{};
  T unit = T(1);

  bool is_identity() const {
    return unit == T(1) && centre[0] == T(0) && centre[1] == T(0) && centre[2] == T(0);
  }
  Vec3<T> operator()(const Vec3<T>& x) const { return unit * x + Vec3<T>{centre[0], centre[1], centre[2]}; }
};

}  // namespace limitcheck::fast
