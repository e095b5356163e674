// SPDX-License-Identifier: MIT
// Refinement in exact rationals: for meshes whose a(n) are rational, n = 3, 4, 6, and any boundary.
#include "reference/loop/refine_impl.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Rational)

}  // namespace limitcheck::reference
