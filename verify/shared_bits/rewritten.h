// SPDX-License-Identifier: MIT
// The same control mesh written down differently, and its faces paired at will.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "data/splitmix64.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"

namespace limitcheck::verify {

/// The positions as a float subject sees them.
data::ControlMesh rounded(data::ControlMesh mesh);

/// Vertices renumbered, faces reordered, their corners rotated, all at random.
struct Rewritten {
  data::ControlMesh mesh;
  std::vector<std::int32_t> face;  // of each face here, the original's
  std::vector<std::uint8_t> turn;  // corner k here is corner (k + turn) % 3 there

  /// Barycentric coordinates on a face here as those on the original's.
  std::array<int, 3> original(std::int32_t f, const std::array<int, 3>& at) const {
    const std::size_t t = turn[static_cast<std::size_t>(f)];
    std::array<int, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) out[(k + t) % 3] = at[k];
    return out;
  }
};

/// Seed 0: as it is.
Rewritten rewrite(const data::ControlMesh& mesh, std::uint64_t seed);

/// Every face in one pair, whose partner and whose corner A chance decides; one in `singles` stays without
/// partner though it has neighbours. All of one depth.
std::vector<fast::Grid> random_pairs(const fast::Adjacency& adjacency, int depth, std::uint64_t seed,
                                     std::uint64_t singles = 5);

/// A depth for each face, least .. most.
std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most, std::uint64_t seed);

}  // namespace limitcheck::verify
