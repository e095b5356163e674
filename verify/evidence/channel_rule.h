// SPDX-License-Identifier: MIT
// By which rule the values of a channel were made, where they are not those of the rule that was asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>

#include "data/channel.h"

namespace limitcheck::verify {

/// A sentence that names the rules by each of which all but a hundredth of the values are right; empty if there is none.
///   good   how many of `count` values are right by a rule; nothing where it cannot be said
template <class Good>
std::string other_rules(data::ChannelRule asked, std::size_t count, Good&& good) {
  std::string fit;
  bool several = false;
  for (std::size_t k = 0; k < std::size(data::kChannelRules); ++k) {
    const auto rule = static_cast<data::ChannelRule>(k);
    const std::optional<std::int64_t> right = rule == asked ? std::nullopt : good(rule);
    if (!right || *right * 100 < static_cast<std::int64_t>(count) * 99) continue;
    several = !fit.empty();
    fit += (several ? ", " : "") + std::string(data::kChannelRules[k]);
  }
  if (fit.empty()) return "";
  return "the values are those of " + std::string(several ? "each of the rules " : "the rule ") + fit +
         ", where " + std::string(data::kChannelRules[static_cast<std::size_t>(asked)]) + " was asked for";
}

}  // namespace limitcheck::verify
