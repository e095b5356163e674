// SPDX-License-Identifier: MIT
// How the quads of a face's lattice are cut into triangles.
#pragma once

#include <array>

namespace limitcheck::verify {

/// A quad of a face's lattice, its corners from the one at which its diagonal begins: the one nearest to a corner of
/// the face.
struct QuadCell {
  std::array<std::array<int, 2>, 4> corner;
};

/// Of the i-th column and the j-th row of n.
QuadCell cell(int i, int j, int n);

/// The corners of its two triangles.
inline constexpr std::array<std::array<int, 3>, 2> kHalves{{{0, 1, 2}, {0, 2, 3}}};

}  // namespace limitcheck::verify
