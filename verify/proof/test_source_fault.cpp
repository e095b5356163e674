// SPDX-License-Identifier: MIT
// Asks the proof whether the kernels it was built with are right; says what is wrong first. For
// source_faults.sh.
#include <fmt/core.h>

#include <exception>

#include "verify/proof/maps/prove_map.h"

int main() {
  using namespace limitcheck::verify;
  std::vector<Neighbourhood> pairs{*interior_pair({5, 7, 4, 8}), *interior_pair({6, 6, 6, 6}), face_alone()};
  for (Neighbourhood& pair : boundary_pairs({6, 5, 6, 7})) pairs.push_back(std::move(pair));
  try {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      for (const ProofRow& row : prove_map(pairs[k], {Arithmetic::kResidues, 0, k < 3 ? 4 : 2})) {
        if (!row.map.witness) continue;
        const MapWitness& w = *row.map.witness;
        fmt::print("{} on {}, {}: {} of control point {} is {}, not {}\n", row.kernel, row.topology, w.point,
                   w.quantity, w.control_point, w.found, w.expected);
        return 1;
      }
    }
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 1;
  }
}
