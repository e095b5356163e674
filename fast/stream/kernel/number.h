// SPDX-License-Identifier: MIT
// What the kernel asks of a number type, and number types of one lane.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace limitcheck::fast::row_stream {

/// Minus half the bits of a float: 1.26 times its inverse square root, to 3 %.
inline constexpr std::int32_t kInverseRootMagic = 0x5f5f2000;

/// Any T with + - *, made from int and double (exactly: the rules' constants are 3, 5, .5 and powers of two),
/// 0 by default; for normals also / and sqrt. The fma of a T that is no floating-point type is a * b + c.
/// `Scalar` is what memory holds, `V` what the rules compute with: `lanes` scalars.
template <class T>
struct ScalarNumber {
  using Scalar = T;
  using V = T;
  static constexpr int lanes = 1;
  static V load(const T* p) { return *p; }
  static void store(V v, T* p) { *p = v; }
  template <class X>
  static V splat(const X& x) {
    return static_cast<T>(x);
  }
  static V fma(const V& a, const V& b, const V& c) {
    if constexpr (std::is_floating_point_v<T>)
      return std::fma(a, b, c);
    else
      return a * b + c;
  }
  static V fms(const V& a, const V& b, const V& c) { return fma(a, b, -c); }
  static V fnma(const V& a, const V& b, const V& c) { return fma(-a, b, c); }

  /// Whether a point keeps a linear image of its tangents in place of its unit normal, see LinearNumber.
  static constexpr bool kLinear = false;

  /// Whether what is short is worth code of its own, in which no number leaves the registers.
  static constexpr bool kInRegisters = false;

  static constexpr bool kHasSeed = std::is_same_v<T, float>;
  static V inverse_root(const V& x) {
    using std::sqrt;
    return T(1) / sqrt(x);
  }
  static V inverse_root_seed(V x) {
    return std::bit_cast<float>(kInverseRootMagic - (std::bit_cast<std::int32_t>(x) >> 1));
  }

  /// 1 where a = b, else 0; and the choice by such numbers.
  static V equal(const V& a, const V& b) { return T(a == b ? 1 : 0); }
  static V select(const V& chosen, const V& a, const V& b) { return chosen == T(0) ? b : a; }

  /// Position and normal of a vertex to the numbers 0 .. 5 at to(r, b) of each lane 4 b + r; two to 0 .. 11.
  template <class Vertex, class Place>
  static void scatter_vertex(const Vertex& a, const Place& to) {
    T* const at = to(0, 0);
    for (int c = 0; c < 3; ++c) at[c] = a.position[c], at[3 + c] = a.normal[c];
  }
  template <class Vertex, class Place>
  static void scatter_couple(const Vertex& a, const Vertex& b, const Place& to) {
    scatter_vertex(a, to);
    scatter_vertex(b, [&](int, int) { return to(0, 0) + 6; });
  }
  /// A word ahead that they will be written.
  template <class Place>
  static void expect(const Place& /*to*/) {}
};

/// For numbers that know linear maps alone: every point has one of its two limit tangents where others have
/// the unit normal, so that all six numbers of a point are linear in the control points.
///   tangent_number   0: the kernel's slant, at control vertices du; 1: the kernel's across, there dv
template <class T, int tangent_number>
struct LinearNumber : ScalarNumber<T> {
  static constexpr bool kLinear = true;
  static constexpr bool kHasSeed = false;  // no length is known, and none asked for
  // X: T, or the number a ring is summed in.
  template <class X>
  static const X& tangent(const X& first, const X& second) {
    if constexpr (tangent_number == 0)
      return first;
    else
      return second;
  }
};

}  // namespace limitcheck::fast::row_stream
