// SPDX-License-Identifier: MIT
// Row streaming in all its forms, of a control mesh written differently at random whose faces are paired at random; its
// shared points put into the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "fast/stream/kernel/targets.h"
#include "verify/evidence/face_depths.h"
#include "verify/relations/variants.h"
#include "verify/shared_bits/test_support/shared_bits.h"

namespace limitcheck::verify {

/// The positions as a float subject sees them.
data::ControlMesh rounded(data::ControlMesh mesh);

/// Vertices renumbered, faces reordered, their corners rotated, all at random. Seed 0: as it is.
Rewriting rewrite(const data::ControlMesh& mesh, std::uint64_t seed);

/// Every face is in one pair; its partner and its corner A are drawn at random. One face in `singles` stays
/// without a partner though it has neighbours. All have one depth.
std::vector<fast::Grid> random_pairs(const fast::Adjacency& adjacency, int depth, std::uint64_t seed,
                                     std::uint64_t singles = 5);

enum class Form { kRows, kWhole };

/// Every pair at one depth, paired at random.
void add_pairs(const Rewriting& mesh, int depth, const fast::row_stream::Kernel& kernel, Form form,
               std::uint64_t seed, SharedBits& bits);

/// Every half-edge by itself, in a random order, hence both ways.
void add_edges(const Rewriting& mesh, int depth, const fast::row_stream::Kernel& kernel, std::uint64_t seed,
               SharedBits& bits);

/// A frame of the subject row-stream with these options, a depth for each of the original's faces.
/// Points of edges go into the table of the edge's depth.
void add_frame(const Rewriting& mesh, std::span<const std::int32_t> depth, const std::string& options,
               int threads, SharedBits& bits);

}  // namespace limitcheck::verify
