// SPDX-License-Identifier: MIT
// From an array per lane to one vector per number.
#pragma once

#include <type_traits>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace limitcheck::fast::row_stream {

/// out[k * lanes + lane] = from[lane][k] - origin[lane][k], k < count, lane < group; origin may be null. At
/// least four numbers must be readable behind each pointer; with group = 4, out is aligned to 16 bytes.
template <int group, class T>
void to_lanes(const T* const* from, const T* const* origin, int count, int lanes, T* out) {
#if defined(__SSE2__)
  if constexpr (group == 4 && std::is_same_v<T, float>) {
    for (int k = 0; k < count; k += 4) {
      const int first = k + 4 > count && count > 4 ? count - 4 : k;  // the last four may overlap
      __m128 v[4];
      for (int i = 0; i < 4; ++i) {
        v[i] = _mm_loadu_ps(from[i] + first);
        if (origin) v[i] = _mm_sub_ps(v[i], _mm_loadu_ps(origin[i] + first));
      }
      _MM_TRANSPOSE4_PS(v[0], v[1], v[2], v[3]);
      for (int i = 0; i < 4 && first + i < count; ++i) _mm_store_ps(out + (first + i) * lanes, v[i]);
    }
    return;
  }
#endif
  for (int lane = 0; lane < group; ++lane) {
    for (int k = 0; k < count; ++k)
      out[k * lanes + lane] = origin ? from[lane][k] - origin[lane][k] : from[lane][k];
  }
}

}  // namespace limitcheck::fast::row_stream
