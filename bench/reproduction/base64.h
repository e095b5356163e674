// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <string>
#include <vector>

namespace limitcheck::bench {

/// Numbers in the byte order of every machine that draws them, as base 64.
template <class Number>
std::string base64(const std::vector<Number>& numbers) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes(sizeof(Number) * numbers.size(), '\0'), text;
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    unsigned group = 0;
    for (std::size_t b = k; b < k + 3; ++b)
      group = group << 8 | (b < bytes.size() ? static_cast<unsigned char>(bytes[b]) : 0u);
    for (int digit = 3; digit >= 0; --digit)
      text += k + static_cast<std::size_t>(3 - digit) > bytes.size() ? '=' : kDigits[group >> 6 * digit & 63];
  }
  return text;
}

}  // namespace limitcheck::bench
