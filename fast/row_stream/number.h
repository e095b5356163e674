// SPDX-License-Identifier: MIT
// What the kernel asks of a number type, and the plain scalar ones: one lane, fma spelled out.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace limitcheck::fast::row_stream {

/// Minus half the bits of a float: 1.26 times its inverse square root, to 3 %.
inline constexpr std::int32_t kInverseRootMagic = 0x5f5f2000;

/// `Scalar` is what memory holds, `V` what the rules compute with: `lanes` scalars.
template <class T>
struct ScalarNumber {
  using Scalar = T;
  using V = T;
  static constexpr int lanes = 1;
  static V load(const T* p) { return *p; }
  static void store(V v, T* p) { *p = v; }
  static V splat(double x) { return static_cast<T>(x); }
  static V fma(V a, V b, V c) { return std::fma(a, b, c); }
  static V fms(V a, V b, V c) { return std::fma(a, b, -c); }
  static V fnma(V a, V b, V c) { return std::fma(-a, b, c); }

  static constexpr bool kHasSeed = std::is_same_v<T, float>;
  static V inverse_root(V x) { return T(1) / std::sqrt(x); }
  static V inverse_root_seed(V x) {
    return std::bit_cast<float>(kInverseRootMagic - (std::bit_cast<std::int32_t>(x) >> 1));
  }

  /// Position and normal of a vertex to aos[lane * lane_stride + 0 .. 5] of each lane; two to 0 .. 11.
  template <class Vertex>
  static void scatter_vertex(const Vertex& a, T* aos, std::ptrdiff_t /*lane_stride*/) {
    for (int c = 0; c < 3; ++c) aos[c] = a.position[c], aos[3 + c] = a.normal[c];
  }
  template <class Vertex>
  static void scatter_couple(const Vertex& a, const Vertex& b, T* aos, std::ptrdiff_t lane_stride) {
    scatter_vertex(a, aos, lane_stride);
    scatter_vertex(b, aos + 6, lane_stride);
  }
};

}  // namespace limitcheck::fast::row_stream
