// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "verify/audit/result.h"

namespace limitcheck::verify {

/// The report as JUnit XML: a suite for each subject, a case for each mesh and check. Findings are failures,
/// breakdowns errors; what is not supported, not run or waived is skipped; warnings pass and say so.
std::string to_junit(const Report& report);

}  // namespace limitcheck::verify
