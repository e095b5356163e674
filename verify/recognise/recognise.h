// SPDX-License-Identifier: MIT
// Recognises what a subject delivered in place of the surface that it should have delivered.
#pragma once

#include <vector>

#include "verify/evidence/evidence.h"

namespace limitcheck::verify {

/// Adds a sentence, and of positions `recognised`, to the findings among `results`, the rows of this evidence,
/// that it can explain:
///   positions, refined-positions   the points are those of another scheme at the same lattice points, or of
///                                  Loop's without or with the limit mask (schemes.h), by majority
///                                  (likeness.h); all visible faces have one depth
///   normals                        origin_of_normals()
/// Then the row `recognised` is added: the points that are not those of what was recognised, by the bound of
/// the positions. Does nothing without such a finding, or if there are more than kRecognised lattice points.
void recognise(const Evidence& e, std::vector<Result>& results);

inline constexpr Lattice::Id kRecognised = 300000;

}  // namespace limitcheck::verify
