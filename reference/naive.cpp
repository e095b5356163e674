// SPDX-License-Identifier: MIT
#include "reference/naive_impl.h"

namespace limitcheck::reference {
template class NaiveSubdivider<double>;
}  // namespace limitcheck::reference
