// SPDX-License-Identifier: MIT
// Catmull-Clark in exact rationals: complete but for normals.
#include "reference/catmull_clark/subdivision_evaluator_impl.h"

namespace limitcheck::reference::catmull_clark {

template class SubdivisionEvaluator<Rational>;

}  // namespace limitcheck::reference::catmull_clark
