// SPDX-License-Identifier: MIT
// Catmull-Clark with 100 decimal digits.
#include "reference/catmull_clark/naive_impl.h"
#include "reference/catmull_clark/refined_mesh_impl.h"
#include "reference/catmull_clark/stam_impl.h"
#include "reference/catmull_clark/subdivision_evaluator_impl.h"

namespace limitcheck::reference::catmull_clark {

template class NaiveSubdivider<Decimal100>;
template class RefinedMesh<Decimal100>;
template class StamEvaluator<Decimal100>;
template class SubdivisionEvaluator<Decimal100>;

}  // namespace limitcheck::reference::catmull_clark
