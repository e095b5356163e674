// SPDX-License-Identifier: MIT
// The channels that some faces of a mesh have (cut_out.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "data/channel.h"
#include "data/faces.h"

namespace limitcheck::data {

/// What channels of a whole mesh some of its faces have: their corners, and the values that these name.
///   faces   of the whole, in the order of the part
std::vector<Channel> channels_of(const std::vector<Channel>& whole, const Faces& whole_faces,
                                 std::span<const std::int32_t> faces);

}  // namespace limitcheck::data
