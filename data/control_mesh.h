// SPDX-License-Identifier: MIT
// The control mesh: the one thing that reference/ and fast/ share.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace limitcheck::data {

/// A triangle mesh: the input of subdivision, and nothing computed from it.
///   positions   one (x, y, z) per vertex, finite
///   triangles   vertex indices 0..positions.size()-1, counter-clockwise seen from outside
/// The container does not check any of this; `validate` (data/validate.h) does.
struct ControlMesh {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

}  // namespace limitcheck::data
