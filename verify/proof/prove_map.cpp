// SPDX-License-Identifier: MIT
#include "verify/proof/prove_map.h"

#include "verify/proof/prove_map_instances.h"

namespace limitcheck::verify {

std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options) {
  std::vector<ProofRow> rows;
  const char* name = "";
  switch (options.arithmetic) {
    case Arithmetic::kExact:
      rows = detail::prove_exactly(neighbourhood, options), name = "exact";
      break;
    case Arithmetic::kResidues:
      rows = detail::prove_in_residues(neighbourhood, options), name = "residues";
      break;
    case Arithmetic::kDigits:
      rows = detail::prove_in_digits(neighbourhood, options), name = "digits";
      break;
  }
  for (ProofRow& row : rows) row.map.arithmetic = name;
  return rows;
}

}  // namespace limitcheck::verify
