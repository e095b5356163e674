// SPDX-License-Identifier: MIT
// Irregular meshes without end, for fuzzing.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// How large and how irregular.
struct RandomMeshOptions {
  int faces = 200;       // about so many, 1 .. 1 million
  int max_valence = 50;  // neighbours of a vertex at most, >= 12
};

/// A valid mesh (data/validate.h) that the seed alone decides: closed, open or of several components, any
/// genus that the stock shapes have, boundaries of any shape, interior valences 3 .. max_valence, boundary
/// vertices of 1 face or more. A stock shape goes through random splits, flips, collapses, holes and ears; a
/// few of its vertices collect neighbours. The geometry is smoothed once, then shaken: bumpy, with slivers
/// and folds here and there.
///   result   coordinates exact in float. Bit for bit the same with every compiler (only + - * /).
///   throws   InputError NAME_BAD_PARAMETER
ControlMesh random_mesh(std::uint64_t seed, const RandomMeshOptions& options = {});

}  // namespace limitcheck::data
