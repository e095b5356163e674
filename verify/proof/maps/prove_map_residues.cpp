// SPDX-License-Identifier: MIT
#include "reference/catmull_clark/recursion_impl.h"
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options,
                                        bool quads) {
  if (quads) {
    using Recursion = ReferenceMap<Residue, reference::catmull_clark::SubdivisionEvaluator<Residue>>;
    return prove_map<QuadRuns, Residue>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
  }
  using Recursion = SharedReferenceMap<Residue>;
  return prove_map<TriangleRuns, Residue>(neighbourhood, options, std::tuple<Recursion>(neighbourhood.mesh));
}

}  // namespace limitcheck::verify::detail
