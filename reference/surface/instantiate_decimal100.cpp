// SPDX-License-Identifier: MIT
// Everything with 100 decimal digits.
#include "reference/loop/naive_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"
#include "reference/loop/subdivision_evaluator_impl.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Decimal100)
template RefinedMesh<Decimal100>::Limits RefinedMesh<Decimal100>::limits() const;
template class NaiveSubdivider<Decimal100>;
template class StamEvaluator<Decimal100>;
template class SubdivisionEvaluator<Decimal100>;

}  // namespace limitcheck::reference
