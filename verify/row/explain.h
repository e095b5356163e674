// SPDX-License-Identifier: MIT
// The rows of the audit in words.
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

/// What the words and signs of the tables mean, some lines.
std::string_view words_of_tables();

/// The row that now says what this one did: waivers, journals and command lines may name rows of earlier
/// versions. Any other name stays as it is.
std::string_view current_name(std::string_view check);

}  // namespace limitcheck::verify
