// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_exactly(const Neighbourhood& neighbourhood, const MapOptions& options) {
  return by_scheme(neighbourhood.mesh, [&]<class Scheme>(Scheme) {
    using C = std::conditional_t<Scheme::kQuads, reference::Rational, Surd>;
    using Maps = std::tuple<QuickMap<C, Scheme::kQuads>>;
    return prove_map<Scheme, C>(neighbourhood, options, Maps(neighbourhood.mesh));
  });
}

}  // namespace limitcheck::verify::detail
