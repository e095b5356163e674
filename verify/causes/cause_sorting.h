// SPDX-License-Identifier: MIT
// Puts the red rows of a report to causes.
#pragma once

#include <string>
#include <vector>

#include "verify/causes/causes.h"

namespace limitcheck::verify {

/// The causes with who, kind, rows, direct and places; see causes() for what belongs together.
std::vector<Cause> sorted_into_causes(const Report& report);

}  // namespace limitcheck::verify
