// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

namespace limitcheck::verify {

/// What a row of the audit means, what it allows, and where that comes from.
struct Explanation {
  std::string_view check, meaning, bound, source;
};

/// One for each row, in the order of the table.
const std::vector<Explanation>& explanations();

/// nullptr if there is no such check.
const Explanation* explain(std::string_view check);

}  // namespace limitcheck::verify
