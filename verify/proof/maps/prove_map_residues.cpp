// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"
#include "verify/proof/maps/prove_map_instances.h"
#include "verify/proof/maps/shared_reference_map.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options) {
  using Recursion = SharedReferenceMap<Residue>;
  return prove_map<Residue>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
