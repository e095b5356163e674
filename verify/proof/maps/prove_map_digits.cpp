// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options) {
  using C = reference::Decimal50;
  const data::ControlMesh& mesh = neighbourhood.mesh;
  return by_scheme(neighbourhood.mesh, [&]<class Scheme>(Scheme) {
    using Maps = std::tuple<RecursionMap<C, Scheme::kQuads>, StamMap<C, Scheme::kQuads>>;
    return prove_map<Scheme, C>(neighbourhood, options, Maps(mesh, mesh));
  });
}

}  // namespace limitcheck::verify::detail
