// SPDX-License-Identifier: MIT
// The exact value behind a Parameter. Heavy: include from .cpp files.
#pragma once

#include "reference/number/number_exact.h"
#include "reference/point/parameter.h"

namespace limitcheck::reference {

struct RationalParameter {
  Rational value;
};

inline Rational exact_value(const Parameter& p) {
  return p.exact() ? p.exact()->value : Rational(p.as_double());
}

}  // namespace limitcheck::reference
