// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options) {
  return prove_in<reference::Decimal50, reference::Decimal50, RecursionMap, StamMap>(neighbourhood, options);
}

}  // namespace limitcheck::verify::detail
