// SPDX-License-Identifier: MIT
// Row streaming in all its forms, its shared points put into the table.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "fast/stream/kernel/targets.h"
#include "verify/shared_bits/rewritten.h"
#include "verify/shared_bits/shared_bits.h"

namespace limitcheck::verify {

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
