// SPDX-License-Identifier: MIT
// Stam's evaluators in balls.
#include "reference/number/ball.h"
#include "reference/surface/instantiate.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Ball)
template class StamEvaluator<Ball>;
template class catmull_clark::StamEvaluator<Ball>;

}  // namespace limitcheck::reference
