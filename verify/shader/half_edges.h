// SPDX-License-Identifier: MIT
// What a shader is given of a control mesh: numbers in one buffer, which the prelude (prelude.h) reads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Half-edge h begins at corner h of the mesh: 3 V coordinates, and of each half-edge its vertex, twin (-1 at the
/// boundary), edge, face and sharpness (10 at the boundary); then the first half-edge of each face and C; then the sharpness
/// of each vertex. Coordinates and sharpness are the bits of floats. The mesh is an oriented manifold.
struct HalfEdges {
  std::vector<std::int32_t> words;
  std::array<std::int64_t, 4> counts{};  // V F C E
  explicit HalfEdges(const lc_mesh& mesh);
};

}  // namespace limitcheck::verify
