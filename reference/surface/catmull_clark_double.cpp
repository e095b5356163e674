// SPDX-License-Identifier: MIT
// Catmull-Clark in double.
#include "reference/catmull_clark/naive_impl.h"
#include "reference/catmull_clark/refined_mesh_impl.h"
#include "reference/catmull_clark/stam_impl.h"
#include "reference/catmull_clark/subdivision_evaluator_impl.h"

namespace limitcheck::reference::catmull_clark {

template class NaiveSubdivider<double>;
template class RefinedMesh<double>;
template class StamEvaluator<double>;
template class SubdivisionEvaluator<double>;

}  // namespace limitcheck::reference::catmull_clark
