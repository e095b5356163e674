// SPDX-License-Identifier: MIT
#include "reference/refine_impl.h"

namespace limitcheck::reference {
LIMITCHECK_INSTANTIATE_REFINE(double)
}  // namespace limitcheck::reference
