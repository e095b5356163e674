// SPDX-License-Identifier: MIT
// Stam's evaluator in balls.
#include "reference/ball.h"
#include "reference/refine_impl.h"
#include "reference/stam_impl.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Ball)
template class StamEvaluator<Ball>;

}  // namespace limitcheck::reference
