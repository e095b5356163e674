// SPDX-License-Identifier: MIT
// JSON that somebody else wrote, or that may have been damaged since we wrote it.
#pragma once

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "data/error.h"
#include "data/json_nesting.h"

namespace limitcheck::data {

/// No file or answer of ours needs more; a recursive parser ends the process at some 100 000.
inline constexpr std::size_t kDeepestJson = 32;

/// Discarded (nlohmann's word) if the text is no JSON. Throws ArgumentError: it nests deeper than kDeepestJson, or
/// names a key twice in one object, of which a parser would silently keep one.
inline nlohmann::json parse_untrusted(std::string_view text) {
  using Json = nlohmann::json;
  if (const std::size_t depth = json_nesting(text); depth > kDeepestJson)
    throw ArgumentError(fmt::format("its JSON nests {} deep; {} are read", depth, kDeepestJson));
  std::vector<std::set<std::string>> keys;
  const auto look = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get_ref<const std::string&>()).second)
      throw ArgumentError(
          fmt::format("\"{}\" stands twice in one object", value.get_ref<const std::string&>()));
    return true;
  };
  return Json::parse(text, look, /*allow_exceptions=*/false);
}

}  // namespace limitcheck::data
