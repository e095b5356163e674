// SPDX-License-Identifier: MIT
#include "reference/stam_impl.h"

namespace limitcheck::reference {
template class StamEvaluator<double>;
}  // namespace limitcheck::reference
