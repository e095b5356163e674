// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// The report as JUnit XML: a suite for each subject, a case for each mesh and check. Findings are failures,
/// breakdowns errors; what is not supported, not run or waived is skipped; warnings pass and say so.
std::string to_junit(const Report& report);

/// Visible text (verify/row/visible_text.h) for XML 1.0; new lines and tabs are spaces.
std::string xml_text(const std::string& text);

}  // namespace limitcheck::verify
