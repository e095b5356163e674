// SPDX-License-Identifier: MIT
#include "reference/catmull_clark/recursion_impl.h"
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options) {
  return prove_in<Residue, Residue, QuickMap>(neighbourhood, options);
}

}  // namespace limitcheck::verify::detail
