// SPDX-License-Identifier: MIT
// Whether output goes to memory through the caches or past them.
#pragma once

#include <cstddef>
#include <cstdint>
#if defined(__x86_64__)
#include <emmintrin.h>
#endif

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

}  // namespace limitcheck::fast
