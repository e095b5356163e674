// SPDX-License-Identifier: MIT
#include "reference/catmull_clark/subdivision_evaluator_impl.h"
#include "verify/proof/maps/prove_map_instances.h"
#include "verify/proof/maps/prove_quad_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_quads_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options) {
  using C = Residue;
  using Recursion = QuadReferenceMap<C, reference::catmull_clark::SubdivisionEvaluator<C>>;
  return prove_quad_map<C>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
