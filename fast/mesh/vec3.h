// SPDX-License-Identifier: MIT
// A vector over any number type.
#pragma once

namespace limitcheck::fast {

/// Three coordinates. N needs + and -, and multiplication by a scalar S from the left; cross and dot need N *
/// N.
template <class N>
struct Vec3 {
  N x{}, y{}, z{};

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

}  // namespace limitcheck::fast
