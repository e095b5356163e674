// SPDX-License-Identifier: MIT
// JSON that somebody else wrote, or that may have been damaged since we wrote it.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/error.h"

namespace limitcheck::data {

/// How deep brackets nest in a JSON text, so that a caller can refuse a hostile text before a recursive
/// parser sees it. For a text that is no JSON the number means nothing.
std::size_t json_nesting(std::string_view json);

/// No file or answer of ours needs more; a recursive parser ends the process at some 100 000.
inline constexpr std::size_t kDeepestJson = 32;

/// Discarded (nlohmann's word) if the text is no JSON. Throws ArgumentError: it nests deeper than `deepest`, or
/// names a key twice in one object, of which a parser would silently keep one.
nlohmann::json parse_untrusted(std::string_view text, std::size_t deepest = kDeepestJson);

/// json -> value, as nlohmann's get_to does; a whole number is one, and fits: of 1e76 or 1.5 there would be something
/// else left. Throws ArgumentError; nlohmann's exceptions.
template <class T>
void read_value(const nlohmann::json& json, T& value) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    const bool fits = json.is_number_unsigned()
                          ? std::in_range<T>(json.get<std::uint64_t>())
                          : json.is_number_integer() && std::in_range<T>(json.get<std::int64_t>());
    if (!fits) throw ArgumentError(fmt::format("{} is no whole number that fits its place", json.dump()));
  }
  json.get_to(value);
}

template <class T>
T value_of(const nlohmann::json& json) {
  T value{};
  read_value(json, value);
  return value;
}

/// Hands each of the "cases" of a file to `read`. Throws InputError: FILE_CANNOT_OPEN; FILE_SYNTAX, also if `read` throws.
template <class Read>
void for_each_case(const std::filesystem::path& file, Read&& read) {
  std::ifstream stream(file);
  if (!stream) throw InputError("FILE_CANNOT_OPEN", file.string(), 0, "cannot be opened for reading");
  try {
    const auto json = parse_untrusted(std::string(std::istreambuf_iterator<char>(stream), {}));
    for (const auto& one : json.at("cases")) read(one);
  } catch (const std::exception& error) {
    throw InputError("FILE_SYNTAX", file.string(), 0, error.what());
  }
}

}  // namespace limitcheck::data
