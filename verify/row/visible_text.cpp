// SPDX-License-Identifier: MIT
#include "verify/row/visible_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace limitcheck::verify {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  // 0: the text begins with no character that UTF-8 has
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k]));
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf8 ? 0 : lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc0 ? 2 : 0;
  if (bytes == 0 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xc0U) != 0x80U) return {};
    code = code << 6 | (byte(k) & 0x3fU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter ones are written in fewer bytes
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code < kLeast[bytes] || code > 0x10ffff || surrogate ? Character{} : Character{code, bytes};
}

bool is_shown(std::uint32_t code) {
  const bool noncharacter = (code & 0xfffeU) == 0xfffeU || (code >= 0xfdd0 && code <= 0xfdef);
  return !noncharacter && !(code >= 0x80 && code < 0xa0);
}

}  // namespace

std::string visible_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto [code, bytes] = first_of(text);
    if (bytes == 0 || !is_shown(code))
      out += "\xef\xbf\xbd";
    else if (code == 0x7f)
      out += "\xe2\x90\xa1";
    else if (code < 0x20 && code != '\n' && code != '\t')
      out += {'\xe2', '\x90', static_cast<char>(0x80 + code)};
    else
      out += text.substr(0, bytes);
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return out;
}

}  // namespace limitcheck::verify
