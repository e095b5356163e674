// SPDX-License-Identifier: MIT
// How vertices are written to their place in a frame: through the caches or past them, from registers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// How output is written: by ordinary stores, or past the caches. The latter pays for output that is larger
/// than they are, if all of it that lies together is written so.
enum class Stores : std::uint8_t { kOrdinary, kPastCaches };

/// Of so many bytes that lie together.
inline Stores stores_for(std::size_t bytes) {
  constexpr std::size_t kMuch = std::size_t{4} << 20;  // more than the caches near a core keep
  return bytes > kMuch ? Stores::kPastCaches : Stores::kOrdinary;
}

/// Makes what this thread wrote past the caches visible before anything that it writes afterwards.
inline void fence(Stores stores) {
#if defined(__x86_64__)
  if (stores == Stores::kPastCaches) _mm_sfence();
#else
  (void)stores;
#endif
}

#if defined(__x86_64__)

namespace detail {

// 16 bytes to a multiple of 8: aligned or not is known by the caller.
template <Stores stores, bool aligned>
inline void put16(float* to, __m128 v) {
  if constexpr (stores == Stores::kOrdinary) {
    _mm_storeu_ps(to, v);
  } else if constexpr (aligned) {
    _mm_stream_ps(to, v);
  } else {
    const __m128i bits = _mm_castps_si128(v);
    _mm_stream_si64(reinterpret_cast<long long*>(to), _mm_cvtsi128_si64(bits));
    _mm_stream_si64(reinterpret_cast<long long*>(to + 2), _mm_cvtsi128_si64(_mm_unpackhi_epi64(bits, bits)));
  }
}

template <Stores stores>
inline void put8(float* to, __m128 v) {
  if constexpr (stores == Stores::kOrdinary)
    _mm_storel_pi(reinterpret_cast<__m64*>(to), v);
  else
    _mm_stream_si64(reinterpret_cast<long long*>(to), _mm_cvtsi128_si64(_mm_castps_si128(v)));
}

inline __m128 load8(const float* from) {
  return _mm_loadl_pi(_mm_setzero_ps(), reinterpret_cast<const __m64*>(from));
}

template <Stores stores, bool aligned>
inline void copy_vertices(const float* from, std::size_t count, float* to) {
  std::size_t k = 0;
  for (; k + 2 <= count; k += 2, from += 12, to += 12)
    for (int t = 0; t < 12; t += 4) put16<stores, aligned>(to + t, _mm_loadu_ps(from + t));
  if (k < count) put16<stores, false>(to, _mm_loadu_ps(from)), put8<stores>(to + 4, load8(from + 4));
}

// x y z n of a, then n n of a and x y of b, then the rest of b.
template <Stores stores, bool aligned>
inline void interleave(const float* a, const float* b, std::size_t count, float* to) {
  const auto end = -6 * static_cast<std::ptrdiff_t>(count);
  for (std::ptrdiff_t k = 0; k != end; k -= 6, to += 12) {
    const __m128 a0 = _mm_loadu_ps(a + k), a1 = load8(a + k + 4);
    const __m128 b0 = _mm_loadu_ps(b + k), b1 = load8(b + k + 4);
    put16<stores, aligned>(to, a0);
    put16<stores, aligned>(to + 4, _mm_movelh_ps(a1, b0));
    put16<stores, aligned>(to + 8, _mm_shuffle_ps(b0, b1, _MM_SHUFFLE(1, 0, 3, 2)));
  }
}

inline bool aligned16(const void* p) {
  return reinterpret_cast<std::uintptr_t>(p) % 16 == 0;
}

}  // namespace detail

#endif

/// `count` vertices, one after the other.
template <class Real>
void copy_vertices(const SurfaceVertex<Real>* from, std::size_t count, SurfaceVertex<Real>* to,
                   Stores stores) {
#if defined(__x86_64__)
  if constexpr (std::is_same_v<Real, float>) {
    const auto* in = reinterpret_cast<const float*>(from);
    auto* out = reinterpret_cast<float*>(to);
    if (stores == Stores::kOrdinary) return detail::copy_vertices<Stores::kOrdinary, true>(in, count, out);
    if (detail::aligned16(to)) return detail::copy_vertices<Stores::kPastCaches, true>(in, count, out);
    return detail::copy_vertices<Stores::kPastCaches, false>(in, count, out);
  }
#endif
  std::copy_n(from, count, to);
}

/// The strip of two rows as they come from the kernel of row streaming: point q is one of `above` if q is
/// even, of `below` if it is odd; both point to that of column 0, from where columns run in steps of 1 or -1.
template <class Real>
struct RowPair {
  const SurfaceVertex<Real>*above, *below;
  int step;

  const SurfaceVertex<Real>& operator()(int q) const {
    return *((q % 2 == 0 ? above : below) + static_cast<std::ptrdiff_t>(q / 2) * step);
  }
  /// The same strip, seen half a turn on; `columns` is the number of the last one.
  RowPair turned(int columns) const {
    const auto last = static_cast<std::ptrdiff_t>(columns) * step;
    return {below + last, above + last, -step};
  }
};

/// The strip between two rows that run the other way: a[0], b[0], a[-1], b[-1], .. a[1 - count], b[1 - count].
template <class Real>
void interleave_backwards(const SurfaceVertex<Real>* a, const SurfaceVertex<Real>* b, std::size_t count,
                          SurfaceVertex<Real>* to, Stores stores) {
#if defined(__x86_64__)
  if constexpr (std::is_same_v<Real, float>) {
    const auto *x = reinterpret_cast<const float*>(a), *y = reinterpret_cast<const float*>(b);
    auto* out = reinterpret_cast<float*>(to);
    if (stores == Stores::kOrdinary) return detail::interleave<Stores::kOrdinary, true>(x, y, count, out);
    if (detail::aligned16(to)) return detail::interleave<Stores::kPastCaches, true>(x, y, count, out);
    return detail::interleave<Stores::kPastCaches, false>(x, y, count, out);
  }
#endif
  for (std::size_t k = 0; k < count; ++k) *to++ = *(a - k), *to++ = *(b - k);
}

}  // namespace limitcheck::fast
