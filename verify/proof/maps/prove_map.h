// SPDX-License-Identifier: MIT
// The linear map of the shipped kernels, extracted and compared with the reference's, one topology at a time.
// Neighbourhoods of triangles are Loop's, of quads Catmull-Clark's.
#pragma once

#include <string>
#include <vector>

#include "verify/proof/topologies/neighbourhood.h"
#include "verify/proof/topologies/proof_row.h"

namespace limitcheck::verify {

enum class Arithmetic : std::uint8_t {
  /// a + b sqrt(3), a and b rational: valences 3, 4, 6, boundary vertices of 1, 2, 3 faces. Quads: rationals,
  /// all positions but those of darts, and all tangents but those of irregular control vertices.
  kExact,
  kResidues,  ///< modulo two primes (coefficient.h): any valence that divides Residue::kOrder; quads: as kExact
  kDigits     ///< 50 decimal digits, equal to 45: any valence; the reference both by recursion and by Stam
};

struct MapOptions {
  Arithmetic arithmetic = Arithmetic::kResidues;
  int first_depth = 0, last_depth = 6;
  bool sliding_window = true;  ///< with the crack fans' edges and centres
  bool row_stream = true;      ///< of quads: where nothing is semi-sharp
};

/// Runs the kernels on stencils and compares every limit point of the depths. One row per kernel; a row that
/// is not equal names the first weight that is wrong.
///   throws   data::ArgumentError: kResidues, a valence that they do not have
std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options = {});

namespace detail {

/// In one arithmetic, of a .cpp file each.
std::vector<ProofRow> prove_exactly(const Neighbourhood& neighbourhood, const MapOptions& options);
std::vector<ProofRow> prove_in_residues(const Neighbourhood& neighbourhood, const MapOptions& options);
std::vector<ProofRow> prove_in_digits(const Neighbourhood& neighbourhood, const MapOptions& options);

}  // namespace detail
}  // namespace limitcheck::verify
