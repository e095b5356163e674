// SPDX-License-Identifier: MIT
// prove_map of either scheme in each arithmetic: one .cpp file each.
#pragma once

#include <vector>

#include "verify/proof/maps/prove_map.h"

namespace limitcheck::verify::detail {

std::vector<ProofRow> prove_exactly(const Neighbourhood& neighbourhood, const MapOptions& options);
std::vector<ProofRow> prove_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options);
std::vector<ProofRow> prove_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options);

std::vector<ProofRow> prove_quads_exactly(const Neighbourhood& neighbourhood, const MapOptions& options);
std::vector<ProofRow> prove_quads_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options);
std::vector<ProofRow> prove_quads_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options);

}  // namespace limitcheck::verify::detail
