// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"
#include "verify/proof/maps/prove_map_instances.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options) {
  using C = reference::Decimal50;
  using Recursion = ReferenceMap<C, reference::SubdivisionEvaluator<C>>;
  using Stam = ReferenceMap<C, reference::StamEvaluator<C>>;
  return prove_map<C>(neighbourhood, options,
                      std::tuple<Recursion, Stam>(neighbourhood.mesh, neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
