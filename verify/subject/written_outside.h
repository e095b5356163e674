// SPDX-License-Identifier: MIT
// For subjects that compute on a device. What was written there behind an array, or in front of it, is shown in the
// guard zone of the host's array (lc_request::allocate), where the host looks: as many bytes as were written, at most
// as many as every zone has.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace limitcheck::verify {

/// Bytes of the host's guard zones, at least.
inline constexpr std::size_t kLeastGuardZone = 1024;

inline void show_written_behind(void* end, std::size_t bytes) {
  std::memset(end, 0, std::min(bytes, kLeastGuardZone));
}
inline void show_written_before(void* begin, std::size_t bytes) {
  const std::size_t few = std::min(bytes, kLeastGuardZone);
  std::memset(static_cast<std::byte*>(begin) - few, 0, few);
}

}  // namespace limitcheck::verify
