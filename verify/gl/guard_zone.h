// SPDX-License-Identifier: MIT
// A zone behind a buffer of a device in which a pattern shows what is written there.
#pragma once

#include <cstddef>
#include <vector>

namespace limitcheck::verify {

inline constexpr std::size_t kDeviceGuard = 1 << 16;  // bytes

inline std::byte guard_byte(std::size_t k) {
  return static_cast<std::byte>(0x81 + (k * 0x9E3779B97F4A7C15ULL >> 58) % 62);
}
inline void add_guard(std::vector<std::byte>& content) {
  for (std::size_t k = 0; k < kDeviceGuard; ++k) content.push_back(guard_byte(k));
}
/// Leaves `size` bytes, and those of the guard zone behind them up to the last one that is not as it was.
inline void cut_guard(std::vector<std::byte>& content, std::size_t size) {
  std::size_t behind = content.size() - size;
  while (behind > 0 && content[size + behind - 1] == guard_byte(behind - 1)) --behind;
  content.resize(size + behind);
}

}  // namespace limitcheck::verify
