// SPDX-License-Identifier: MIT
// Catmull-Clark in balls.
#include "reference/catmull_clark/stam_impl.h"
#include "reference/number/ball.h"

namespace limitcheck::reference::catmull_clark {

template class StamEvaluator<Ball>;

}  // namespace limitcheck::reference::catmull_clark
