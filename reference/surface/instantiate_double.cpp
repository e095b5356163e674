// SPDX-License-Identifier: MIT
// Everything in double.
#include "reference/loop/naive_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"
#include "reference/loop/subdivision_evaluator_impl.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(double)
template RefinedMesh<double>::Limits RefinedMesh<double>::limits() const;
template class NaiveSubdivider<double>;
template class StamEvaluator<double>;
template class SubdivisionEvaluator<double>;

}  // namespace limitcheck::reference
