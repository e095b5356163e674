// SPDX-License-Identifier: MIT
#include "reference/catmull_clark/recursion_impl.h"
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options) {
  return by_scheme(neighbourhood.mesh, [&]<class Scheme>(Scheme) {
    using Maps = std::tuple<QuickMap<Residue, Scheme::kQuads>>;
    return prove_map<Scheme, Residue>(neighbourhood, options, Maps(neighbourhood.mesh));
  });
}

}  // namespace limitcheck::verify::detail
