// SPDX-License-Identifier: MIT
// A cause in plain words.
#pragma once

#include "verify/causes/causes.h"

namespace limitcheck::verify {

/// Fills in title, look and size of a cause whose rows are known.
void put_in_words(const Report& report, Cause& cause);

}  // namespace limitcheck::verify
