// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_exactly(const Neighbourhood& neighbourhood, const MapOptions& options) {
  return prove_in<Surd, reference::Rational, QuickMap>(neighbourhood, options);
}

}  // namespace limitcheck::verify::detail
