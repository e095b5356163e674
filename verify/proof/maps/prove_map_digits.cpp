// SPDX-License-Identifier: MIT
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options,
                                      bool quads) {
  using C = reference::Decimal50;
  const data::ControlMesh& mesh = neighbourhood.mesh;
  if (quads) {
    using Recursion = ReferenceMap<C, reference::catmull_clark::SubdivisionEvaluator<C>>;
    using Stam = ReferenceMap<C, reference::catmull_clark::StamEvaluator<C>>;
    return prove_map<QuadRuns, C>(neighbourhood, options, std::tuple<Recursion, Stam>(mesh, mesh));
  }
  using Recursion = ReferenceMap<C, reference::SubdivisionEvaluator<C>>;
  using Stam = ReferenceMap<C, reference::StamEvaluator<C>>;
  return prove_map<TriangleRuns, C>(neighbourhood, options, std::tuple<Recursion, Stam>(mesh, mesh));
}

}  // namespace limitcheck::verify::detail
