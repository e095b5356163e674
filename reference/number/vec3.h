// SPDX-License-Identifier: MIT
// A point or vector of three numbers, of any number type.
#pragma once

#include <algorithm>
#include <array>

namespace limitcheck::reference {

/// A point or vector.
template <class N>
struct Vec3 {
  N x{}, y{}, z{};

  Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  Vec3& operator*=(const N& s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  friend Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend Vec3 operator*(Vec3 a, const N& s) { return a *= s; }
  friend Vec3 operator*(const N& s, Vec3 a) { return a *= s; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// a . b
template <class N>
N dot(const Vec3<N>& a, const Vec3<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// a x b
template <class N>
Vec3<N> cross(const Vec3<N>& a, const Vec3<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// |a|
template <class N>
N magnitude(const N& a) {
  return a < N(0) ? N(0) - a : a;
}
/// The largest |coordinate|.
template <class N>
inline N magnitude(const Vec3<N>& a) {
  return std::max({magnitude(a.x), magnitude(a.y), magnitude(a.z)});
}

/// The coordinates as a vector of another number type; `convert` maps one number.
template <class M, class N, class Convert>
Vec3<M> transform(const Vec3<N>& a, Convert&& convert) {
  return {convert(a.x), convert(a.y), convert(a.z)};
}

}  // namespace limitcheck::reference
