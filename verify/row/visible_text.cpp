// SPDX-License-Identifier: MIT
#include "verify/row/visible_text.h"

#include <boost/locale/utf.hpp>
#include <cstdint>

namespace limitcheck::verify {
namespace {

using Utf8 = boost::locale::utf::utf_traits<char>;

bool is_shown(std::uint32_t code) {
  if (!boost::locale::utf::is_valid_codepoint(code)) return false;  // no UTF-8
  const bool noncharacter = (code & 0xfffeU) == 0xfffeU || (code >= 0xfdd0 && code <= 0xfdef);
  return !noncharacter && !(code >= 0x80 && code < 0xa0);
}

}  // namespace

std::string visible_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (auto at = text.begin(); at != text.end();) {
    auto next = at;
    const std::uint32_t code = Utf8::decode(next, text.end());
    if (!is_shown(code))
      out += "\xef\xbf\xbd";
    else if (code == 0x7f)
      out += "\xe2\x90\xa1";
    else if (code < 0x20 && code != '\n' && code != '\t')
      out += {'\xe2', '\x90', static_cast<char>(0x80 + code)};
    else
      out.append(at, next);
    at = boost::locale::utf::is_valid_codepoint(code) ? next : at + 1;
  }
  return out;
}

}  // namespace limitcheck::verify
