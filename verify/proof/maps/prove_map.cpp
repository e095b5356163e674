// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map.h"

namespace limitcheck::verify {

std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options) {
  struct Way {
    std::vector<ProofRow> (*prove)(const Neighbourhood&, const MapOptions&);
    const char* name;
  };
  constexpr Way kWays[]{{detail::prove_exactly, "exact"},
                        {detail::prove_in_residues, "residues"},
                        {detail::prove_in_digits, "digits"}};  // in the order of Arithmetic
  const auto& [prove, name] = kWays[static_cast<std::size_t>(options.arithmetic)];
  std::vector<ProofRow> rows = prove(neighbourhood, options);
  for (ProofRow& row : rows) row.map.arithmetic = name;
  return rows;
}

}  // namespace limitcheck::verify
