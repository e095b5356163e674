// SPDX-License-Identifier: MIT
#include "verify/subject/options.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <charconv>

#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

Options::Options(const char* text) {
  std::string_view left = text != nullptr ? text : "";
  while (!left.empty()) {
    const auto item = left.substr(0, left.find(','));
    left.remove_prefix(std::min(left.size(), item.size() + 1));
    const auto equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      throw SubjectError(LC_INVALID_INPUT, fmt::format("option '{}': write key=value", item));
    }
    if (!values_.emplace(item.substr(0, equals), item.substr(equals + 1)).second) {
      throw SubjectError(LC_INVALID_INPUT, fmt::format("option '{}' is given twice", item.substr(0, equals)));
    }
  }
}

const std::string* Options::find(const std::string& key) {
  read_.insert(key);
  const auto found = values_.find(key);
  return found == values_.end() ? nullptr : &found->second;
}

int Options::integer(const std::string& key, int fallback, int least, int most) {
  const std::string* given = find(key);
  if (given == nullptr) return fallback;
  int number = 0;
  const auto [end, error] = std::from_chars(given->data(), given->data() + given->size(), number);
  if (error != std::errc{} || end != given->data() + given->size() || number < least || number > most) {
    throw SubjectError(LC_INVALID_INPUT,
                       fmt::format("option {}={}: an integer from {} to {}", key, *given, least, most));
  }
  return number;
}

int Options::choice(const std::string& key, const std::vector<std::string_view>& choices) {
  const std::string* given = find(key);
  if (given == nullptr) return 0;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    if (*given == choices[k]) return static_cast<int>(k);
  }
  throw SubjectError(LC_INVALID_INPUT,
                     fmt::format("option {}={}: one of {}", key, *given, fmt::join(choices, ", ")));
}

std::string Options::value(const std::string& key, const std::string& fallback) {
  const std::string* given = find(key);
  return given == nullptr ? fallback : *given;
}

std::string Options::rest() {
  rest_read_ = true;
  std::string joined;
  for (const auto& [key, text] : values_) {
    if (read_.contains(key)) continue;
    if (!joined.empty()) joined += ',';
    joined.append(key).append("=").append(text);
  }
  return joined;
}

void Options::finish() const {
  for (const auto& [key, text] : values_) {
    if (!rest_read_ && !read_.contains(key))
      throw SubjectError(LC_INVALID_INPUT, fmt::format("there is no option '{}'", key));
  }
}

}  // namespace limitcheck::verify
