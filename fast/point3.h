// SPDX-License-Identifier: MIT
// Points and directions of the set-up stages (camera, depth), always in double.
#pragma once

#include <array>
#include <cmath>

namespace limitcheck::fast {

struct Point3 {
  double x = 0, y = 0, z = 0;

  constexpr Point3() = default;
  constexpr Point3(double px, double py, double pz) : x(px), y(py), z(pz) {}
  constexpr Point3(const std::array<double, 3>& p) : x(p[0]), y(p[1]), z(p[2]) {}  // NOLINT: meant to convert

  friend constexpr Point3 operator+(const Point3& a, const Point3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Point3 operator-(const Point3& a, const Point3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Point3 operator*(double s, const Point3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr bool operator==(const Point3&, const Point3&) = default;
};

constexpr double dot(const Point3& a, const Point3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Point3 cross(const Point3& a, const Point3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Point3& a) {
  return std::sqrt(dot(a, a));
}
inline bool is_finite(const Point3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace limitcheck::fast
