// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_exactly(const Neighbourhood& neighbourhood, const MapOptions& options,
                                    bool quads) {
  if (quads) {
    using C = reference::Rational;
    using Recursion = ReferenceMap<C, reference::catmull_clark::SubdivisionEvaluator<C>>;
    return prove_map<QuadRuns, C>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
  }
  using Recursion = SharedReferenceMap<Surd>;
  return prove_map<TriangleRuns, Surd>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
