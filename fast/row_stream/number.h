// SPDX-License-Identifier: MIT
// What the kernel asks of a number type, and the plain scalar ones: one lane, fma spelled out.
#pragma once

#include <cmath>

namespace limitcheck::fast::row_stream {

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
  static V inverse_root(V x) { return T(1) / std::sqrt(x); }

  /// `count` numbers of each lane, found at soa[k * lanes + lane], to aos[lane * lane_stride + k].
  static void scatter(const T* soa, int count, T* aos, std::ptrdiff_t /*lane_stride*/) {
    for (int k = 0; k < count; ++k) aos[k] = soa[k];
  }
};

}  // namespace limitcheck::fast::row_stream
