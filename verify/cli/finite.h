// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace limitcheck::cli {

/// For options that are real numbers: "nan" is a number to the parser, and within every range.
inline const CLI::Validator kFinite(
    [](std::string& text) {
      double value = 0;
      return CLI::detail::lexical_cast(text, value) && !std::isfinite(value) ? text + " is no finite number"
                                                                             : std::string();
    },
    "");

}  // namespace limitcheck::cli
