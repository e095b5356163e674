// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"
#include "verify/proof/maps/prove_map_instances.h"
#include "verify/proof/maps/shared_reference_map.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_exactly(const Neighbourhood& neighbourhood, const MapOptions& options) {
  using Recursion = SharedReferenceMap<Surd>;
  return prove_map<Surd>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
