// SPDX-License-Identifier: MIT
// What a shader is given of a control mesh: numbers in one buffer, which the prelude (prelude.h) reads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// 3 V coordinates. Of each half-edge (h begins at corner h): vertex, twin (-1 at the boundary), edge, face, sharpness
/// (10 at the boundary). The first half-edge of each face, and C. The sharpness of each vertex. Coordinates and
/// sharpness are bits of floats. The mesh is an oriented manifold.
struct HalfEdges {
  std::vector<std::int32_t> words;
  std::array<std::int64_t, 4> counts{};  // V F C E
  explicit HalfEdges(const lc_mesh& mesh);
};

}  // namespace limitcheck::verify
