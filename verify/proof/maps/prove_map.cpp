// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map.h"

#include "verify/proof/maps/prove_map_instances.h"

namespace limitcheck::verify {

std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options) {
  std::vector<ProofRow> rows;
  const char* name = "";
  const bool quads = !neighbourhood.mesh.faces.are_triangles();
  switch (options.arithmetic) {
    case Arithmetic::kExact:
      rows = (quads ? detail::prove_quads_exactly : detail::prove_exactly)(neighbourhood, options);
      name = "exact";
      break;
    case Arithmetic::kResidues:
      rows = (quads ? detail::prove_quads_in_residues : detail::prove_in_residues)(neighbourhood, options);
      name = "residues";
      break;
    case Arithmetic::kDigits:
      rows = (quads ? detail::prove_quads_in_digits : detail::prove_in_digits)(neighbourhood, options);
      name = "digits";
      break;
  }
  for (ProofRow& row : rows) row.map.arithmetic = name;
  return rows;
}

}  // namespace limitcheck::verify
