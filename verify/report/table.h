// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// The report for a terminal: for each subject a line per check over all meshes (the worst mesh is shown),
/// then the findings, each with its witness and the command that recomputes the expected value.
///   colour  whether to use ANSI colours
///   all     a line for each mesh instead of the worst one only
std::string to_table(const Report& report, bool colour, bool all = false);

/// The part of it that is about one subject, without the checks that nothing was looked at for.
std::string check_lines(const Report& report, const std::string& subject, bool colour);

}  // namespace limitcheck::verify
