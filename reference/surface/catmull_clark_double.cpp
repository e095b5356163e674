// SPDX-License-Identifier: MIT
// Catmull-Clark in double.
#include "reference/catmull_clark/stam_impl.h"
#include "reference/catmull_clark/subdivision_evaluator_impl.h"

namespace limitcheck::reference::catmull_clark {

template class StamEvaluator<double>;
template class SubdivisionEvaluator<double>;

}  // namespace limitcheck::reference::catmull_clark
