// SPDX-License-Identifier: MIT
// Stam's evaluator in balls.
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"
#include "reference/number/ball.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Ball)
template class StamEvaluator<Ball>;

}  // namespace limitcheck::reference
