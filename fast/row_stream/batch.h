// SPDX-License-Identifier: MIT
// Gathers the control points of a batch of pairs into the lanes of a kernel's input.
#pragma once

#include <cstdint>
#include <span>

#include "fast/adjacency.h"
#include "fast/pairing.h"
#include "fast/row_stream/layout.h"
#include "fast/row_stream/rings.h"

namespace limitcheck::fast::row_stream {

/// Fills input_size(depth) * lanes numbers, aligned to 64 bytes, from 1 to `lanes` pairs; the lanes that
/// remain repeat the last pair. A singleton without neighbour gets ghosts for its dummy partner.
void gather(const Adjacency& adjacency, const Rings& rings, std::span<const Pair> pairs, int depth, int lanes,
            float* input);

/// The same for control edges, each from the origin to the target of a half-edge: edge_input_size(depth) *
/// lanes.
void gather_edges(const Adjacency& adjacency, const Rings& rings, std::span<const std::int32_t> half_edges,
                  int depth, int lanes, float* input);

}  // namespace limitcheck::fast::row_stream
