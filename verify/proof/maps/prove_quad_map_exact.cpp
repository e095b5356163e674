// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_instances.h"
#include "verify/proof/maps/prove_quad_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_quads_exactly(const Neighbourhood& neighbourhood, const MapOptions& options) {
  using C = reference::Rational;
  using Recursion = QuadReferenceMap<C, reference::catmull_clark::SubdivisionEvaluator<C>>;
  return prove_quad_map<C>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
