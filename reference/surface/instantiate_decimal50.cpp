// SPDX-License-Identifier: MIT
// Everything with 50 decimal digits.
#include "reference/loop/naive_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"
#include "reference/loop/subdivision_evaluator_impl.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Decimal50)
template RefinedMesh<Decimal50>::Limits RefinedMesh<Decimal50>::limits() const;
template class NaiveSubdivider<Decimal50>;
template class StamEvaluator<Decimal50>;
template class SubdivisionEvaluator<Decimal50>;

}  // namespace limitcheck::reference
