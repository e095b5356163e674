// SPDX-License-Identifier: MIT
#include "data/untrusted_json.h"

#include <algorithm>
#include <set>
#include <vector>

namespace limitcheck::data {

std::size_t json_nesting(std::string_view json) {
  std::size_t depth = 0, deepest = 0;
  bool in_text = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_text) {
      if (c == '\\') ++k;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

nlohmann::json parse_untrusted(std::string_view text, std::size_t deepest) {
  using Json = nlohmann::json;
  if (const std::size_t depth = json_nesting(text); depth > deepest)
    throw ArgumentError(fmt::format("its JSON nests {} deep; {} are read", depth, deepest));
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
