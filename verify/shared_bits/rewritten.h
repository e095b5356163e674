// SPDX-License-Identifier: MIT
// A control mesh written differently at random, and its faces paired at random.
#pragma once

#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "verify/evidence/face_depths.h"
#include "verify/relations/rewriting.h"

namespace limitcheck::verify {

/// The positions as a float subject sees them.
data::ControlMesh rounded(data::ControlMesh mesh);

/// Vertices renumbered, faces reordered, their corners rotated, all at random. Seed 0: as it is.
Rewriting rewrite(const data::ControlMesh& mesh, std::uint64_t seed);

/// Every face is in one pair; its partner and its corner A are drawn at random. One face in `singles` stays
/// without a partner though it has neighbours. All have one depth.
std::vector<fast::Grid> random_pairs(const fast::Adjacency& adjacency, int depth, std::uint64_t seed,
                                     std::uint64_t singles = 5);

}  // namespace limitcheck::verify
