// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// The first row of a check; without one a failure, and an empty row.
inline const Result& row(const std::vector<Result>& results, const std::string& check) {
  static const Result none;
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const Result& r) { return r.check == check; });
  EXPECT_NE(found, results.end()) << check;
  return found == results.end() ? none : *found;
}

}  // namespace limitcheck::verify
